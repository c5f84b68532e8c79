#include "talus/formats/fractures.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "mesh/builder.h"
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

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\"");
    if (first == std::string_view::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> cellsOf(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const auto comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

class CsvReader {
 public:
    CsvReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

    Result<std::vector<Fracture>> read() {
        while (next()) {
            auto error = columns_.empty() ? readHeader() : readRow();
            if (error) return *error;
        }
        if (columns_.empty()) return fault("found no header, allowed: " + allColumns());
        return std::move(fractures_);
    }

 private:
    Error fault(std::string message) const { return {"", std::move(message), path_, line_, 0}; }

    static std::string allColumns() {
        std::string all;
        for (const Column& column : kColumns)
            all += (all.empty() ? "" : ", ") + std::string(column.name) + std::string(column.unit);
        return all;
    }

    bool next() {
        while (!text_.empty()) {
            const auto end = text_.find('\n');
            row_ = trimmed(text_.substr(0, end));
            text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
            ++line_;
            if (!row_.empty() && row_.front() != '#') return true;
        }
        return false;
    }

    std::optional<Error> readHeader() {
        for (const std::string_view cell : cellsOf(row_)) {
            const auto known = std::find_if(kColumns.begin(), kColumns.end(), [&](const Column& column) {
                return cell == column.name ||
                       (cell.starts_with(column.name) && cell.substr(column.name.size()) == column.unit);
            });
            columns_.push_back(static_cast<std::size_t>(known - kColumns.begin()));
        }
        for (std::size_t k = 0; k < kColumns.size(); ++k)
            if (std::count(columns_.begin(), columns_.end(), k) != 1)
                return fault("found columns " + toml::quoted(row_) + ", allowed: " + allColumns() +
                             ", each once, and others");
        return std::nullopt;
    }

    std::optional<Error> readRow() {
        const auto cells = cellsOf(row_);
        if (cells.size() != columns_.size())
            return fault("found " + std::to_string(cells.size()) +
                         " values, allowed: " + std::to_string(columns_.size()) + ", one for each column");
        std::array<double, 6> value{};
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (columns_[k] >= kColumns.size()) continue;
            const Column& column = kColumns[columns_[k]];
            const auto number = mesh::numberOf(cells[k]);
            if (!number || !(*number >= column.least && *number <= column.most) ||
                (column.name == "radius" && *number == 0))
                return fault(
                    "found " + std::string(column.name) + " " + toml::quoted(cells[k]) +
                    ", allowed: a number " +
                    (column.name == "radius" ? "greater than 0" : "of at least " + numberText(column.least)) +
                    " and at most " + numberText(column.most));
            value[columns_[k]] = *number;
        }
        fractures_.push_back({{value[0], value[1], value[2]}, value[3] * kDeg, value[4] * kDeg, value[5]});
        return std::nullopt;
    }

    const std::string& path_;
    std::string_view text_, row_{};
    int line_ = 0;
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
        std::string name = set;
        std::replace(name.begin(), name.end(), ',', ' ');
        text += name + "\n";
    }
    return text;
}

Result<std::vector<Fracture>> readFractures(const std::string& path) {
    const auto text = toml::readFileText(path);
    if (!text) return text.errors();
    return CsvReader(path, *text).read();
}

}  // namespace talus::formats
