#pragma once
// A block on a plane whose lower part is wet, in closed form.

#include <cmath>

#include "support/models.h"

namespace talus::test {

inline constexpr double kWaterWeight = 1000 * 9.81;  // [N/m^3]

/// A block of 1 x 1 x 0.5 m on a plane whose lower part is wet.
struct WetSlab {
    double tilt_deg = 20, friction_deg = 35, cohesion = 4e3, wet_strength = 0.6;
    double share = 0.4;  ///< of the base that is wet

    double beta() const { return radians(tilt_deg); }
    double level() const { return share * std::sin(beta()); }  ///< along gravity above the lower edge [m]
    double strength() const { return 1 - share * (1 - wet_strength); }  ///< over the dry one

    Model dry() const {
        Model made = floorModel(friction_deg);
        made.joints[0].cohesion = made.joints[0].residual_cohesion = cohesion;
        made.joints[0].wet_strength_factor = wet_strength;
        addBox(made, "block", {0, 0, 0}, {1, 1, 0.5});
        made.gravity.tilt = beta();
        return made;
    }
    /// Water between block and plane.
    Model model() const {
        Model made = dry();
        Water water;
        water.kind = Water::Level::elevation;
        water.level = {{0, level()}};
        water.pair = {{0, 1}};
        water.field = "water[0]";
        made.waters = {water};
        return made;
    }
    /// The same water, by its depth up the plane: as wet at every tilt.
    Model byDepth() const {
        Model made = model();
        made.waters[0].kind = Water::Level::depth;
        made.waters[0].level = {{0, share}};
        return made;
    }
    /// A level water table, which also stands in front of the block.
    Model belowTable() const {
        Model made = dry();
        PhreaticSurface table;
        for (const double x : {-4.0, 19.0})
            table.line.push_back({x, (level() - x * std::sin(beta())) / std::cos(beta())});
        table.field = "water[0]";
        made.phreatic = table;
        return made;
    }
    double factor(double in_front = 0) const {
        const double weight = 0.5 * 2700 * 9.81, uplift = 0.5 * kWaterWeight * share * level();
        return strength() *
               (cohesion + (weight * std::cos(beta()) - uplift) * std::tan(radians(friction_deg))) /
               (weight * std::sin(beta()) - in_front);
    }
    double inFront() const { return 0.5 * kWaterWeight * level() * level() / std::cos(beta()); }
};

}  // namespace talus::test
