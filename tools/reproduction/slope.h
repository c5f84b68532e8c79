#pragma once
// The slope drawn at the tilt at which it fails: blocks coloured by how they move, water in its fissures.

#include <array>
#include <utility>

#include "report/svg.h"
#include "reproduction/results.h"

namespace talus::tools {

/// One slice of the case's stack, tilted by its critical angle (by the theory's where there is no answer).
/// Moving blocks are shifted the way they moved, enlarged so that the farthest moves kDrawnMotion.
Svg drawSlope(const PaperRun& run);

inline constexpr double kDrawnMotion = 0.06;  ///< [m] at the drawing's scale

/// What the colours mean: words and the class of the drawing, in the order of a legend.
inline constexpr std::array<std::pair<const char*, const char*>, 6> kSlopeColours{
    {{"stays", "stable"},
     {"slides", "sliding"},
     {"slides and turns", "mixed"},
     {"topples", "toppling"},
     {"floor, fixed", "fixed"},
     {"water", "water"}}};

}  // namespace talus::tools
