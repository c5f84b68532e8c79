#include "replay/terminal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace talus::tools {

namespace {

constexpr std::size_t kCurveWidth = 48;
constexpr double kDecades = 8;  // shown of a logarithmic curve
constexpr std::array<const char*, 8> kBlocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::array<const char*, 8> kLetters{"_", ".", "-", "=", "+", "*", "%", "#"};

/// A line of the summary: which column, how it is called, its unit, how its curve is drawn.
struct Quantity {
    const char *column, *name, *unit;
    bool logarithmic;
};
constexpr std::array<Quantity, 6> kQuantities{{{"largest_displacement_m", "largest displacement", "m", false},
                                               {"largest_velocity_m_s", "largest velocity", "m/s", false},
                                               {"kinetic_energy_j", "kinetic energy", "J", false},
                                               {"elastic_energy_j", "elastic energy", "J", false},
                                               {"gravity_energy_j", "gravity energy", "J", false},
                                               {"out_of_balance", "unbalanced / weight, log", "", true}}};

std::size_t columnOf(const Table& table, const std::string& name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
}

std::vector<double> valuesOf(const Table& table, const std::string& name) {
    const std::size_t column = columnOf(table, name);
    std::vector<double> values;
    for (const auto& row : table.rows)
        values.push_back(row[column].is_number() ? row[column].get<double>() : 0.0);
    return values;
}

/// Largest value of each of `width` equal stretches.
std::vector<double> binned(const std::vector<double>& values, std::size_t width) {
    if (values.size() <= width) return values;
    std::vector<double> bins;
    for (std::size_t k = 0; k < width; ++k) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k * values.size() / width);
        const auto end = values.begin() + static_cast<std::ptrdiff_t>((k + 1) * values.size() / width);
        bins.push_back(*std::max_element(begin, end));
    }
    return bins;
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string shortNumber(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

std::string summaryLine(const Table& course, const Quantity& quantity, bool unicode) {
    const std::vector<double> values = valuesOf(course, quantity.column);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const std::string unit = *quantity.unit != '\0' ? std::string(" ") + quantity.unit : "";
    return padded(quantity.name, 26) + sparkline(values, kCurveWidth, quantity.logarithmic, unicode) + "  " +
           shortNumber(*least) + " to " + shortNumber(*most) + unit + ", at the end " +
           shortNumber(values.back()) + unit + "\n";
}

}  // namespace

std::string sparkline(const std::vector<double>& values, std::size_t width, bool logarithmic, bool unicode) {
    std::vector<double> shown = binned(values, width);
    if (shown.empty()) return "";
    if (logarithmic) {
        const double floor =
            std::max(*std::max_element(shown.begin(), shown.end()), 1e-300) * std::pow(10.0, -kDecades);
        for (double& value : shown) value = std::log10(std::max(value, floor));
    }
    const auto [least, most] = std::minmax_element(shown.begin(), shown.end());
    const double low = *least, span = *most - low;
    std::string line;
    for (const double value : shown) {
        const double height = span > 0 ? (value - low) / span : 0;
        const auto level = static_cast<std::size_t>(std::min(7.0, std::floor(height * 8)));
        line += (unicode ? kBlocks : kLetters)[level];
    }
    return line;
}

bool terminalSpeaksUnicode() {
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        const char* value = std::getenv(name);
        if (value == nullptr || *value == '\0') continue;
        std::string locale = value;
        std::transform(locale.begin(), locale.end(), locale.begin(),
                       [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
        return locale.find("utf-8") != std::string::npos || locale.find("utf8") != std::string::npos;
    }
    return false;
}

std::string courseText(const Table& course, std::size_t rows, bool unicode) {
    if (course.rows.empty()) return "no frames\n";
    std::string lines;
    for (const Quantity& quantity : kQuantities) lines += summaryLine(course, quantity, unicode);
    Table shown;
    std::vector<std::size_t> columns;
    for (const char* name :
         {"frame", "time_s", "tilt_deg", "kinetic_energy_j", "gravity_energy_j", "out_of_balance",
          "largest_displacement_m", "largest_velocity_m_s", "state_hash"}) {
        columns.push_back(columnOf(course, name));
        shown.columns.emplace_back(name);
    }
    const std::size_t last = course.rows.size() - 1, count = std::clamp<std::size_t>(rows, 2, last + 1);
    for (std::size_t k = 0; k < count; ++k) {
        const auto& row = course.rows[count > 1 ? k * last / (count - 1) : 0];
        shown.rows.emplace_back();
        for (const std::size_t column : columns) shown.rows.back().push_back(row[column]);
    }
    return lines + "\n" + shown.text();
}

}  // namespace talus::tools
