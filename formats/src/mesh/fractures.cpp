#include "talus/formats/fractures.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "files/csv_line.h"
#include "files/number.h"
#include "talus/formats/csv.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using toml::numberText;

constexpr double kDeg = std::numbers::pi / 180;

/// A column, its unit, and what it may hold.
struct Column {
    std::string_view name, unit;
    double least, most;
};
constexpr std::array<Column, 6> kColumns{{{"x", "_m", -1e6, 1e6},
                                          {"y", "_m", -1e6, 1e6},
                                          {"z", "_m", -1e6, 1e6},
                                          {"dip", "_deg", 0, 90},
                                          {"dip_direction", "_deg", -360, 360},
                                          {"radius", "_m", 0, 1e6}}};

class FractureReader {
 public:
    FractureReader(const std::string& path, std::string_view text) : path_(path), lines_(text) {}

    Result<std::vector<Fracture>> read() {
        if (!lines_.next()) return fault("found no header, allowed: " + allColumns());
        if (auto error = readHeader()) return *error;
        while (lines_.next())
            if (auto error = readRow()) return *error;
        return std::move(fractures_);
    }

 private:
    Error fault(std::string message) const { return {"", std::move(message), path_, lines_.number(), 0}; }

    static std::string allColumns() {
        std::string all;
        for (const Column& column : kColumns)
            all += (all.empty() ? "" : ", ") + std::string(column.name) + std::string(column.unit);
        return all;
    }

    std::optional<Error> readHeader() {
        separator_ = separatorOf(lines_.line());
        for (const CsvCell& cell : cellsOf(lines_.line(), separator_)) {
            const auto known = std::find_if(kColumns.begin(), kColumns.end(), [&](const Column& column) {
                return cell.text == column.name ||
                       cell.text == std::string(column.name) + std::string(column.unit);
            });
            columns_.push_back(static_cast<std::size_t>(known - kColumns.begin()));
        }
        for (std::size_t k = 0; k < kColumns.size(); ++k)
            if (std::count(columns_.begin(), columns_.end(), k) != 1)
                return fault("found columns " + toml::quoted(withoutBlanks(lines_.line())) +
                             ", allowed: " + allColumns() + ", each once, and others");
        return std::nullopt;
    }

    std::optional<Error> readRow() {
        const auto cells = cellsOf(lines_.line(), separator_);
        if (std::string wrong = rowFault(cells, columns_.size(), separator_); !wrong.empty())
            return fault(std::move(wrong));
        std::array<double, 6> value{};
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (columns_[k] >= kColumns.size()) continue;
            const Column& column = kColumns[columns_[k]];
            const auto number = numberOf(cells[k].text);
            const bool radius = column.name == "radius";
            if (!number || !(*number >= column.least && *number <= column.most) || (radius && *number == 0))
                return fault("found " + std::string(column.name) + " " + toml::quoted(cells[k].text) +
                             ", allowed: a number " +
                             (radius ? "greater than 0" : "of at least " + numberText(column.least)) +
                             " and at most " + numberText(column.most));
            value[columns_[k]] = *number;
        }
        fractures_.push_back({{value[0], value[1], value[2]}, value[3] * kDeg, value[4] * kDeg, value[5]});
        return std::nullopt;
    }

    const std::string& path_;
    CsvLines lines_;
    char separator_ = ',';
    std::vector<std::size_t> columns_{};  ///< of each cell, by its place in kColumns; beyond: passed over
    std::vector<Fracture> fractures_{};
};

}  // namespace

std::string fracturesCsv(const std::vector<std::pair<std::string, Fracture>>& fractures) {
    std::string text = "x_m,y_m,z_m,dip_deg,dip_direction_deg,radius_m,set\n";
    for (const auto& [set, f] : fractures) {
        for (const double value :
             {f.centre.x(), f.centre.y(), f.centre.z(), f.dip / kDeg, f.dip_direction / kDeg, f.radius})
            text += numberText(value) + ",";
        text += csvField(set) + "\n";
    }
    return text;
}

Result<std::vector<Fracture>> readFractures(const std::string& path) {
    const auto text = toml::readFileText(path);
    if (!text) return text.errors();
    return parseFractures(*text, path);
}

Result<std::vector<Fracture>> parseFractures(const std::string& text, const std::string& path) {
    return FractureReader(path, text).read();
}

}  // namespace talus::formats
