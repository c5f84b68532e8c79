#include "report/numbers.h"

#include <cmath>

#include "cli/command.h"

namespace talus::tools {

std::string shown(std::optional<double> value, int decimals) { return value ? text(*value, decimals) : "-"; }

std::string shownSigned(std::optional<double> value, int decimals) {
    if (!value) return "-";
    const double unit = std::pow(10.0, -decimals);
    if (std::abs(*value) < unit / 2) return text(0.0, decimals);
    return (*value > 0 ? "+" : "") + text(*value, decimals);
}

}  // namespace talus::tools
