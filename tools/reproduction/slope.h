#pragma once
// The slope from its side: at the tilt at which it fails, and where a kept failing run ends.

#include "report/figures.h"
#include "reproduction/results.h"

namespace talus::tools {

/// One slice of the case's stack, tilted by its critical angle (by the theory's where there is no answer).
/// Moving blocks are shifted the way they moved, enlarged so that the farthest moves kDrawnMotion.
Drawing drawSlope(const PaperRun& run);

inline constexpr double kDrawnMotion = 0.06;  ///< [m]

/// The end of a kept run: blocks coloured by role, water in its fissures.
Drawing drawEnd(const KeptRun& kept, const std::vector<int>& fissures, const std::string& title);

/// What the colours mean: [{role, text}], in the order of a legend.
Json slopeColours();

/// Model coordinates (x uphill, z normal to the floor) onto the drawing's: x to the right, gravity downwards.
struct SideView {
    double cos_tilt = 1, sin_tilt = 0;

    Spot at(double x, double z) const { return {x * cos_tilt - z * sin_tilt, x * sin_tilt + z * cos_tilt}; }
    std::vector<Spot> box(double x0, double z0, double x1, double z1) const {
        return {at(x0, z0), at(x1, z0), at(x1, z1), at(x0, z1)};
    }
};

/// The usual mark of a water level: a triangle on its point.
void addLevelMark(Drawing& drawing, Spot at);

}  // namespace talus::tools
