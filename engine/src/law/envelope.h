#pragma once
// A tabulated envelope: straight from point to point, the last slope goes on.

#include <algorithm>
#include <vector>

#include "talus/joint_values.h"

namespace talus::contact {

struct Envelope {
    static constexpr bool kStraight = true;

    /// \pre two points or more, their normal stresses growing from zero
    static double strength(const Joint& joint, double normal_stress) {
        const std::vector<EnvelopePoint>& points = joint.shear_strength;
        const auto beyond =
            std::upper_bound(points.begin() + 1, points.end() - 1, normal_stress,
                             [](double s, const EnvelopePoint& p) { return s < p.normal_stress; });
        const EnvelopePoint &from = *(beyond - 1), &to = *beyond;
        const double slope =
            (to.shear_strength - from.shear_strength) / (to.normal_stress - from.normal_stress);
        return from.shear_strength + slope * (std::max(normal_stress, 0.0) - from.normal_stress);
    }

    static std::vector<double> kinks(const Joint& joint) {
        std::vector<double> kinks;
        for (const EnvelopePoint& point : joint.shear_strength) kinks.push_back(point.normal_stress);
        return kinks;
    }
};

}  // namespace talus::contact
