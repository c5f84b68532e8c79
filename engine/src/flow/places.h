#pragma once
// Which places of the network a boundary takes.

#include <algorithm>

#include "talus/flow_data.h"

namespace talus::flow {

constexpr double kLooks = 0.5 - 1e-9;  // cosine of the 60 degrees within which a rock face looks a way
constexpr double kNear = 1e-6;         // of the median patch: a node that far outside a box is in it

inline bool takesJoint(const FlowBoundary& boundary, std::int32_t joint) {
    const auto& joints = boundary.joints;
    return joints.empty() || std::find(joints.begin(), joints.end(), joint) != joints.end();
}

/// Whether ends of joints on a rock face of this outward normal belong to the boundary.
inline bool takesFace(const FlowBoundary& boundary, const Vec3& outward) {
    return boundary.face && outward.dot(*boundary.face) >= kLooks;
}

/// \param near  a place that far outside counts as inside [m]
inline bool isInBox(const Vec3& x, const Vec3& low, const Vec3& high, double near) {
    return (x.array() >= low.array() - near).all() && (x.array() <= high.array() + near).all();
}

/// The part of a line between two points that is in a box, as shares of the way; from > to if there is none.
struct Stretch {
    double from = 0, to = 1;
};

inline Stretch stretchInBox(const Vec3& begin, const Vec3& end, const Vec3& low, const Vec3& high) {
    Stretch stretch;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = end[axis] - begin[axis];
        if (along == 0) {
            if (begin[axis] < low[axis] || begin[axis] > high[axis]) return {1, 0};
            continue;
        }
        const auto [enter, leave] =
            std::minmax({(low[axis] - begin[axis]) / along, (high[axis] - begin[axis]) / along});
        stretch.from = std::max(stretch.from, enter), stretch.to = std::min(stretch.to, leave);
    }
    return stretch;
}

}  // namespace talus::flow
