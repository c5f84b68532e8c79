#pragma once
// Figures as people read them, and loads as they call them.

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

/// What an analysis varies, by its name on the command line ("tilt"); nullptr when there is none of this
/// name.
const VariedQuantity* variedNamed(std::string_view name);

/// A search's load (SI) in its unit: "19.512".
std::string loadFigure(const LoadSearch& search, double load, int decimals);

/// With the words that go with it: "tilt 19.512 deg", "strengths divided by 1.0133".
std::string loadText(const LoadSearch& search, double load, int decimals);

}  // namespace talus::tools
