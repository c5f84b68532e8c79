// ESRI ASCII grid: a header (ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize,
// NODATA_value), then the heights. They come row by row from north to south, each at the middle of its cell.
// (ARC/INFO's ASCIIGRID; GDAL writes dx and dy for cells that are not square.)

#include <algorithm>
#include <map>

#include "mesh/builder.h"
#include "mesh/grid.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using mesh::SurfaceBuilder;
using mesh::Words;

constexpr double kMostCells = 1e8;

class AscReader {
 public:
    AscReader(const std::string& text, SurfaceBuilder& builder) : words_(text), builder_(builder) {}

    Result<FileSurface> read() {
        if (auto fault = readHeader()) return *fault;
        if (auto fault = readHeights()) return *fault;
        mesh::addSquares({columns_, rows_, vertices_, heights_, line_}, builder_);
        return builder_.finish();
    }

 private:
    Error fault(std::string message) const { return builder_.fault(words_.line(), std::move(message)); }

    /// Words of the header stand in any order and in capitals or not; the first line that begins with a
    /// number ends it.
    std::optional<Error> readHeader() {
        static const std::vector<std::string> kKnown{"ncols",     "nrows",       "xllcorner", "xllcenter",
                                                     "yllcorner", "yllcenter",   "cellsize",  "dx",
                                                     "dy",        "nodata_value"};
        while (words_.nextLine()) {
            word_ = words_.next();
            if (word_.empty()) continue;
            if (numberOf(word_)) return checkHeader();
            std::string name(word_);
            for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end())
                return fault("found " + toml::quoted(name) + toml::suggestion(name, kKnown));
            const std::string_view text = words_.next();
            const auto value = numberOf(text);
            if (!value)
                return fault("found " + toml::quoted(text) + " behind " + name +
                             ", allowed: a finite number");
            header_[name] = *value;
        }
        return fault(
            "found no heights, allowed: a header and then a row of heights for each row of the grid");
    }

    std::optional<Error> checkHeader() {
        const auto has = [&](const char* name) { return header_.count(name) > 0; };
        if (has("cellsize")) {
            header_.try_emplace("dx", header_["cellsize"]);
            header_.try_emplace("dy", header_["cellsize"]);
        }
        for (const char* name : {"ncols", "nrows", "dx", "dy"})
            if (!has(name))
                return fault(std::string("found no ") + (name[0] == 'd' ? "cellsize" : name) +
                             " before the heights, allowed: ncols, nrows, xllcorner, yllcorner, cellsize");
        for (const char* name : {"dx", "dy"})
            if (!(header_[name] > 0)) return fault("found a cell without a size, allowed: greater than 0");
        const double columns = header_["ncols"], rows = header_["nrows"];
        if (!(columns >= 2 && rows >= 2 && columns * rows <= kMostCells && columns == std::floor(columns) &&
              rows == std::floor(rows)))
            return fault("found " + toml::numberText(columns) + " columns and " + toml::numberText(rows) +
                         " rows, allowed: whole numbers of at least 2, and at most 1e8 heights");
        for (const std::string axis : {"x", "y"})
            if (!has((axis + "llcorner").c_str()) && !has((axis + "llcenter").c_str()))
                return fault("found no " + axis + "llcorner before the heights, allowed: " + axis +
                             "llcorner or " + axis + "llcenter");
        columns_ = static_cast<std::size_t>(columns);
        rows_ = static_cast<std::size_t>(rows);
        return std::nullopt;
    }

    /// Of the middle of the south-western cell.
    double corner(const std::string& axis, double size) {
        const auto centre = header_.find(axis + "llcenter");
        return centre != header_.end() ? centre->second : header_[axis + "llcorner"] + 0.5 * size;
    }

    std::optional<Error> readHeights() {
        const double dx = header_["dx"], dy = header_["dy"], x = corner("x", dx), y = corner("y", dy);
        const auto nodata = header_.find("nodata_value");
        // Grows with what is read: a header alone may speak of 1e8 heights.
        const std::size_t wanted = rows_ * columns_;
        for (bool more = true; more; more = words_.nextLine(), word_ = more ? words_.next() : "") {
            for (; !word_.empty(); word_ = words_.next()) {
                const std::size_t count = vertices_.size(), row = count / columns_, column = count % columns_;
                if (count == wanted)
                    return fault("found more heights than ncols times nrows, allowed: " +
                                 std::to_string(wanted));
                const auto z = numberOf(word_);
                if (!z) return fault("found " + toml::quoted(word_) + ", allowed: finite heights");
                if (column == 0) line_.push_back(words_.line());
                if (nodata != header_.end() && *z == nodata->second) {
                    vertices_.push_back(-1);
                    continue;
                }
                vertices_.push_back(builder_.vertex({x + static_cast<double>(column) * dx,
                                                     y + static_cast<double>(rows_ - 1 - row) * dy, *z}));
                heights_.push_back(*z);
            }
        }
        if (vertices_.size() == wanted) return std::nullopt;
        return fault("found " + std::to_string(vertices_.size()) + " heights, allowed: ncols times nrows, " +
                     std::to_string(wanted));
    }

    Words words_;
    SurfaceBuilder& builder_;
    std::string_view word_;
    std::map<std::string, double> header_;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<std::int32_t> vertices_;  ///< of each cell, row by row from the north; -1 without a height
    std::vector<double> heights_;         ///< of each vertex
    std::vector<int> line_;               ///< of each row
};

}  // namespace

Result<FileSurface> mesh::readAsc(const std::string& text, SurfaceBuilder builder) {
    return AscReader(text, builder).read();
}

}  // namespace talus::formats
