#pragma once
// Figures as people read them.

#include <optional>
#include <string>

namespace talus::tools {

/// Fixed notation, "-" for nothing.
std::string shown(std::optional<double> value, int decimals);
std::string shownSigned(std::optional<double> value, int decimals);  ///< "+0.01"; a rounded zero has no sign

}  // namespace talus::tools
