#pragma once
// The power law: tau = a sigma_n^b, b <= 1.

#include <cmath>
#include <vector>

#include "talus/joint_values.h"

namespace talus::contact {

struct PowerLaw {
    static constexpr bool kStraight = false;

    static double strength(const Joint& joint, double normal_stress) {
        return normal_stress > 0 ? joint.a * std::pow(normal_stress, joint.b) : 0.0;
    }

    static std::vector<double> kinks(const Joint&) { return {}; }
};

}  // namespace talus::contact
