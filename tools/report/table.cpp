#include "report/table.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "report/csv.h"

namespace talus::tools {

namespace {

std::string sixDigits(double value) {
    std::array<char, 40> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6).ptr};
}

std::string shown(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return sixDigits(value.get<double>() + 0.0);  // -0 is 0
    return jsonText(value);
}

std::string csvCell(const Json& value) {
    if (value.is_null()) return "";
    return value.is_string() ? csvField(value.get<std::string>()) : jsonText(value);
}

}  // namespace

std::string Table::text() const {
    std::vector<std::vector<std::string>> lines = {columns};
    for (const auto& row : rows) {
        lines.emplace_back();
        for (const Json& value : row) lines.back().push_back(shown(value));
    }
    std::string out;
    std::vector<std::size_t> width(columns.size(), 0);
    for (const auto& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k) width[k] = std::max(width[k], line[k].size());
    for (std::size_t l = 0; l < lines.size(); ++l) {
        std::string printed;
        for (std::size_t k = 0; k < lines[l].size(); ++k) {
            const std::string pad(width[k] - lines[l][k].size(), ' ');
            const bool left = !rows.empty() && rows.front()[k].is_string();
            printed += (k > 0 ? "  " : "") + (left ? lines[l][k] + pad : pad + lines[l][k]);
        }
        printed.erase(printed.find_last_not_of(' ') + 1);
        out += printed + "\n";
    }
    return out;
}

std::string Table::csv() const {
    std::string out;
    for (std::size_t k = 0; k < columns.size(); ++k) out += (k > 0 ? "," : "") + csvField(columns[k]);
    out += "\n";
    for (const auto& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) out += (k > 0 ? "," : "") + csvCell(row[k]);
        out += "\n";
    }
    return out;
}

Json Table::json() const {
    Json list = Json::array();
    for (const auto& row : rows) {
        Json item = Json::object();
        for (std::size_t k = 0; k < columns.size(); ++k) item[columns[k]] = row[k];
        list.push_back(std::move(item));
    }
    return list;
}

}  // namespace talus::tools
