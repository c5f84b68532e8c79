#pragma once
// Barton and Bandis' law: tau = sigma_n tan(phi_r + JRC log10(JCS / sigma_n)), Barton and Choubey (1977),
// Rock Mechanics 10, 1-54. JRC counts degrees. The angle is at most max_friction, since log10 grows without
// end towards small stresses, and at least phi_r: above JCS the roughness is sheared off.

#include <algorithm>
#include <cmath>
#include <vector>

#include "talus/angles.h"
#include "talus/joint_values.h"

namespace talus::contact {

struct BartonBandis {
    static constexpr bool kStraight = false;

    static double strength(const Joint& joint, double normal_stress) {
        if (!(normal_stress > 0)) return 0;
        const double roughness = joint.jrc * kDegree * std::log10(joint.jcs / normal_stress);
        const double angle = joint.residual_friction + std::max(roughness, 0.0);
        return normal_stress * std::tan(std::min(angle, joint.max_friction));
    }

    /// Where the angle leaves its greatest value, and where it reaches its least.
    static std::vector<double> kinks(const Joint& joint) {
        if (!(joint.jrc > 0)) return {};
        const double decades = (joint.max_friction - joint.residual_friction) / (joint.jrc * kDegree);
        return {joint.jcs * std::pow(10.0, -std::max(decades, 0.0)), joint.jcs};
    }
};

}  // namespace talus::contact
