#pragma once
// Figures in text, and loads with their usual names.

#include <optional>
#include <string>
#include <string_view>

#include "talus/searches.h"

namespace talus::tools {

/// Fixed notation, "-" for nothing.
std::string shown(std::optional<double> value, int decimals);
std::string shownSigned(std::optional<double> value, int decimals);  ///< "+0.01"; a rounded zero has no sign

/// A number with a true minus sign.
std::string typeset(std::string number);

/// A varied quantity by its name on the command line ("tilt"); nullptr when there is none of this name.
const VariedQuantity* variedNamed(std::string_view name);

/// A search's load (SI) in its unit: "19.512".
std::string loadFigure(const LoadSearch& search, double load, int decimals);

/// With its words: "tilt 19.512 deg", "strengths divided by 1.0133".
std::string loadText(const LoadSearch& search, double load, int decimals);

}  // namespace talus::tools
