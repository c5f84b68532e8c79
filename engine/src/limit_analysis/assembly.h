#pragma once
// A slope for limit analysis: rigid bodies and their contact points at the start.

#include <cstdint>
#include <vector>

#include "forces/wrench.h"
#include "talus/polyhedron.h"

namespace talus::limit {

inline constexpr std::int32_t kFixed = -1;   ///< the body of fixed blocks
inline constexpr std::int32_t kAbsent = -2;  ///< of blocks that are left out

/// One free block, or several joined by bonds that no load here can break.
struct Body {
    Vec3 centroid = Vec3::Zero();  ///< [m]
    double radius = 0;             ///< its farthest corner [m]
    double weight = 0;             ///< [N]
};

/// Where forces pass from body a to body b.
struct ContactPoint {
    std::int32_t body_a = kFixed, body_b = kFixed;
    Vec3 place = Vec3::Zero();  ///< [m]
    Mat3 axes = Mat3::
        Identity();   ///< columns: the tangent in the vertical plane of x, the other one, the normal to b
    double area = 0;  ///< A_s [m^2]
    std::int32_t joint = 0;
};

/// A tie between two bodies (a bolt): its pull is any value up to its strength.
struct Tendon {
    std::int32_t body_a = kFixed, body_b = kFixed;
    Vec3 place = Vec3::Zero();   ///< [m]
    Vec3 along = Vec3::UnitZ();  ///< from a to b
    double strength = 0;         ///< [N]
};

struct Assembly {
    std::vector<Body> bodies;
    std::vector<std::int32_t> body_of_block;  ///< kFixed for blocks that are not free, kAbsent
    std::vector<ContactPoint> points;
    std::vector<Tendon> tendons;
    /// Solved in a plane y = constant (section.h): y, and turning about x and z, are left out.
    bool plane_section = false;

    int rowsPerBody() const { return plane_section ? 3 : 6; }
};

/// On each body, about its centroid.
using Loads = std::vector<Wrench>;

}  // namespace talus::limit
