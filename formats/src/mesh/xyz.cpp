// Points as text, one a line: x, y and z in the first three columns, or by a header. Separators are blanks,
// tabs, commas or semicolons; with semicolons, decimal commas are allowed. They are thinned to a height grid.

#include <algorithm>
#include <array>
#include <utility>

#include "files/csv_line.h"
#include "mesh/builder.h"
#include "mesh/grid.h"
#include "mesh/plane_notation.h"
#include "mesh/point_grid.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using mesh::SurfaceBuilder;

constexpr std::array<std::string_view, 3> kTitles{" x easting east e ", " y northing north n ",
                                                  " z elevation height altitude h "};
constexpr std::string_view kAllowed = "x, y and z of a point, finite numbers";

struct Cell {
    std::string_view text;
    int column = 1;  ///< of its first character, from 1
};

class XyzReader {
 public:
    XyzReader(const std::string& text, const mesh::Thinning& thinning, SurfaceBuilder& builder)
        : lines_(text), thinning_(thinning), builder_(builder) {}

    Result<FileSurface> read() {
        if (auto fault = readPoints()) return *fault;
        const double cells = mesh::cellsOver(points_, thinning_.cell);
        if (!(cells <= mesh::mostCells(points_.size()))) {
            return builder_.fault(0, "found " + std::to_string(points_.size()) + " points over " +
                                         toml::numberText(cells) + " cells, allowed: at most " +
                                         toml::numberText(mesh::mostCells(points_.size())) +
                                         "; a larger cell, or no points far from the others");
        }
        mesh::PointGrid grid = mesh::thinned(points_, thinning_);
        addSurface(grid);
        if (builder_.empty())
            return builder_.fault(0, "found no four neighbouring cells with points, allowed: a larger cell");
        for (std::string& note : grid.notes) builder_.note(std::move(note));
        return builder_.finish();
    }

 private:
    std::optional<Error> readPoints() {
        bool is_first = true;
        while (lines_.next()) {
            if (lines_.line().starts_with("//")) continue;
            if (std::exchange(is_first, false)) {
                separator_ = separatorIn(lines_.line());
                if (isHeader()) {
                    if (auto fault = readHeader()) return fault;
                    continue;
                }
            }
            if (auto fault = readPoint()) return fault;
        }
        if (!points_.empty()) return std::nullopt;
        return builder_.fault(0, "found no points, allowed: lines with " + std::string(kAllowed));
    }

    /// ' ' stands for blanks and tabs.
    static char separatorIn(std::string_view line) {
        for (const char separator : {';', ','})
            if (line.find(separator) != std::string_view::npos) return separator;
        return ' ';
    }

    std::vector<Cell> cells() const {
        const std::string_view line = lines_.line();
        std::vector<Cell> all;
        for (std::size_t at = 0; at < line.size();) {
            if (separator_ == ' ' && (line[at] == ' ' || line[at] == '\t' || line[at] == '\r')) {
                ++at;
                continue;
            }
            const std::size_t end = std::min(
                separator_ == ' ' ? line.find_first_of(" \t\r", at) : line.find(separator_, at), line.size());
            const std::string_view whole = line.substr(at, end - at), own = withoutBlanks(whole);
            all.push_back({own, static_cast<int>(at + (own.empty() ? 0 : whole.find(own))) + 1});
            at = end + 1;
        }
        return all;
    }

    std::optional<double> numberIn(std::string_view cell) const {
        if (separator_ != ';') return numberOf(cell);
        std::string text(cell);
        std::replace(text.begin(), text.end(), ',', '.');
        return numberOf(text);
    }

    bool isHeader() const {
        const auto row = cells();
        return std::none_of(row.begin(), row.end(),
                            [&](const Cell& cell) { return numberIn(cell.text).has_value(); });
    }

    std::optional<Error> readHeader() {
        const auto row = cells();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto named = std::find_if(row.begin(), row.end(), [&](const Cell& cell) {
                const std::string word = titleWord(cell.text);
                return !word.empty() && kTitles[axis].find(" " + word + " ") != std::string_view::npos;
            });
            if (named == row.end()) {
                return builder_.fault(lines_.number(), "found columns " +
                                                           toml::quoted(withoutBlanks(lines_.line())) +
                                                           ", allowed: x, y and z, and others");
            }
            cell_of_[axis] = static_cast<std::size_t>(named - row.begin());
        }
        return std::nullopt;
    }

    std::optional<Error> readPoint() {
        const auto row = cells();
        Vec3 point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t cell = cell_of_[axis];
            const auto value = cell < row.size() ? numberIn(row[cell].text) : std::nullopt;
            if (value) {
                point[static_cast<Eigen::Index>(axis)] = *value;
                continue;
            }
            Error fault = builder_.fault(
                lines_.number(), cell < row.size() ? "found " + toml::quoted(row[cell].text) + " for " +
                                                         "xyz"[axis] + ", allowed: " + std::string(kAllowed)
                                                   : "found " + std::to_string(row.size()) +
                                                         " columns, allowed: " + std::string(kAllowed));
            if (cell < row.size()) fault.column = row[cell].column;
            return fault;
        }
        points_.push_back(point);
        return std::nullopt;
    }

    void addSurface(const mesh::PointGrid& grid) {
        std::vector<std::int32_t> vertices(grid.filled.size(), -1);
        std::vector<double> heights;
        for (std::size_t cell = 0; cell < vertices.size(); ++cell) {
            if (!grid.filled[cell]) continue;
            const auto column = static_cast<double>(cell % grid.columns);
            const std::size_t from_north = cell / grid.columns;
            const auto row = static_cast<double>(grid.rows - 1 - from_north);
            vertices[cell] =
                builder_.vertex({grid.south_west.x() + column * thinning_.cell,
                                 grid.south_west.y() + row * thinning_.cell, grid.heights[cell]});
            heights.push_back(grid.heights[cell]);
        }
        mesh::addSquares({grid.columns, grid.rows, vertices, heights, {}}, builder_);
    }

    CsvLines lines_;
    const mesh::Thinning& thinning_;
    SurfaceBuilder& builder_;
    char separator_ = ' ';
    std::array<std::size_t, 3> cell_of_{0, 1, 2};
    std::vector<Vec3> points_;
};

}  // namespace

Result<FileSurface> mesh::readXyz(const std::string& text, const Thinning& thinning, SurfaceBuilder builder) {
    return XyzReader(text, thinning, builder).read();
}

}  // namespace talus::formats
