#include "report/numbers.h"

#include <cmath>

#include "cli/text.h"

namespace talus::tools {

std::string shown(std::optional<double> value, int decimals) { return value ? text(*value, decimals) : "-"; }

std::string shownSigned(std::optional<double> value, int decimals) {
    if (!value) return "-";
    const double unit = std::pow(10.0, -decimals);
    if (std::abs(*value) < unit / 2) return text(0.0, decimals);
    return (*value > 0 ? "+" : "") + text(*value, decimals);
}

std::string typeset(std::string number) {
    if (number.starts_with('-')) number.replace(0, 1, "\u2212");
    return number;
}

const VariedQuantity* variedNamed(std::string_view name) {
    for (const VariedQuantity& quantity : variedQuantities())
        if (name == quantity.name) return &quantity;
    return nullptr;
}

std::string loadFigure(const LoadSearch& search, double load, int decimals) {
    return text(load / search.load->scale, decimals);
}

std::string loadText(const LoadSearch& search, double load, int decimals) {
    const std::string unit = search.load->unit;
    return search.load->text + (" " + loadFigure(search, load, decimals)) + (unit.empty() ? "" : " " + unit);
}

}  // namespace talus::tools
