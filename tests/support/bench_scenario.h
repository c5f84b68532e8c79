#pragma once
// A block on one joint of a rock mass, as a scenario.

#include <cmath>
#include <string>

#include "support/models.h"

namespace talus::test {

/// A bench 10 m long and high, two deep, and a joint that dips out of its face from 1 m above the toe, as far
/// as `end` [m] from the face. Joint and rock keep their cohesion once they slip.
inline std::string bench(double dip_deg, double end, double joint_cohesion, double rock_cohesion,
                         const std::string& more = "") {
    const auto number = [](double value) { return std::to_string(value); };
    const auto strength = [&](const char* name, double friction_deg, double cohesion) {
        return "[joint." + std::string(name) +
               "]\nnormal_stiffness = 1e11\nshear_stiffness = 1e10\nfriction_deg = " + number(friction_deg) +
               "\ncohesion = " + number(cohesion) + "\nresidual_cohesion = " + number(cohesion) + "\n";
    };
    const double top = 1 + end * std::tan(radians(dip_deg));
    const auto corner = [&](double x, double y, double z) {
        return "[" + number(x) + ", " + number(y) + ", " + number(z) + "]";
    };
    return "[material.rock]\ndensity = 2600.0\n" + strength("default", 30, joint_cohesion) +
           strength("intact", 45, rock_cohesion) +
           "[rock_mass]\nregion = { profile = [[0, 0], [10, 0], [10, 10], [0, 10]], y = [0, 2] }\n"
           "fixed = [{ boundary = \"-z\" }]\n" +
           more + "[[single_joint]]\nname = \"J\"\npolygon = [" + corner(0, 0, 1) + ", " +
           corner(end, 0, top) + ", " + corner(end, 2, top) + ", " + corner(0, 2, 1) + "]\n";
}

}  // namespace talus::test
