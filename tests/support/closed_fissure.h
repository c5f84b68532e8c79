#pragma once
// A block in front of a fissure with a closed volume of water, and what it does in closed form.

#include <cmath>
#include <functional>

#include "support/models.h"

namespace talus::test {

/// Columns of length x and height h in front of a fissure of one opening, on a floor of one friction.
struct ClosedFissure {
    double length = 0.6, height = 0.5, width = 0.1;  ///< [m]
    double filled = 0.35, opening = 0.002;           ///< H0, b [m]
    double friction_deg = 19.5, tilt_deg = 16.5626;  ///< one degree beyond the limit
    double density = 2700, water_density = 1000, g = 9.81;

    double tilt() const { return radians(tilt_deg); }
    double volume() const { return filled * opening * width; }  ///< [m^3]
    double mass() const { return density * length * height * width; }

    /// H along the wall of the block after it has moved by d: from b H + d H + d^2 tan(beta) / 2 = V / w at
    /// the fissure's fixed wall, and the level table beyond it.
    double depthAtBlock(double d, double volume_per_width) const {
        const double at_wall = (volume_per_width - 0.5 * d * d * std::tan(tilt())) / (opening + d);
        return at_wall + d * std::tan(tilt());
    }
    double depthAtBlock(double d) const { return depthAtBlock(d, filled * opening); }

    /// What pushes the block downhill beyond its friction, over its mass [m/s^2].
    double excess(double d) const {
        const double h = depthAtBlock(d);
        const double water = water_density * h * h / (2 * density * length * height);
        return g * std::cos(tilt()) * (std::tan(tilt()) - std::tan(radians(friction_deg)) + water);
    }

    /// Where it stops when it is moved slowly: excess = 0 [m].
    double slowStop() const {
        return root([&](double d) { return excess(d); });
    }

    /// The critical drag of the water's spring where it stops, as Damping::mass [1/s].
    double criticalDrag() const {
        const double d = slowStop(), step = 1e-3 * d;
        return 2 * std::sqrt((excess(d - step) - excess(d + step)) / (2 * step));
    }

    /// Where it stops without damping: the integral of the excess is used up [m].
    double freeStop() const {
        const auto work = [&](double d) {  // Simpson's rule
            constexpr int kParts = 2000;
            double sum = excess(0) + excess(d);
            for (int k = 1; k < kParts; ++k) sum += (k % 2 == 0 ? 2 : 4) * excess(d * k / kParts);
            return sum * d / (3 * kParts);
        };
        return root([&](double d) { return work(d) / d; });
    }

    /// The block in front of a fixed one on a fixed floor.
    Model model(double stiffness = 1e11) const {
        Model made = floorModel(friction_deg, stiffness);
        addBox(made, "slide", {0, 0, 0}, {length, width, height}, density);
        addBox(made, "wall", {length, 0, 0}, {0.4, width, height}, density);
        made.blocks.back().motion = Motion::fixed;
        made.gravity.tilt = tilt();
        made.gravity.magnitude = g;
        Water water = fissureAt(made, length, filled);
        water.density = water_density;
        water.closed = true;
        water.opening = opening;
        made.waters = {water};
        return made;
    }

 private:
    static double root(const std::function<double(double)>& falls) {
        double low = 1e-9, high = 1.0;
        for (int k = 0; k < 200; ++k) (falls(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
        return low;
    }
};

}  // namespace talus::test
