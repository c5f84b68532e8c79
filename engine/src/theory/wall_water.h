#pragma once
// Water on upright faces, in closed form.

#include <optional>
#include <vector>

#include "talus/model.h"

namespace talus::theory {

/// Water on one face that looks along +x or -x: a pressure rho_w g cos(tilt) (top - z) between two heights.
struct WallWater {
    std::int32_t block = 0;
    bool on_back = false;      ///< the face looks towards +x, so the water pushes towards -x
    double unit_weight = 0;    ///< rho_w g times the width of the face [N/m^2]
    double low = 0, high = 0;  ///< wet part of the face [m]
    double top = 0;            ///< water table [m]

    double thrust() const;               ///< per cos(tilt) [N]
    double momentAbout(double z) const;  ///< per cos(tilt) [N m]
};

/// All walls of all waters on free blocks; nothing when one of them is beyond the formulas. These are a level
/// that changes with time or with the tilt (elevation), a fissure that drains, a face that is not an upright
/// rectangle across x, and a `pair` (which the caller may remove first).
std::optional<std::vector<WallWater>> wallWaters(const Model& model, const std::vector<Water>& waters);

}  // namespace talus::theory
