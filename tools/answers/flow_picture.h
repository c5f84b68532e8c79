#pragma once
// Water in the joints of a section: joints coloured by their pressure, seen along y.

#include <string>
#include <string_view>

#include "talus/flow.h"

namespace talus::tools {

/// An SVG file. Joints are drawn from the lowest to the highest pressure; dry ones are grey.
std::string flowSvg(const SteadyFlow& flow, std::string_view title);

}  // namespace talus::tools
