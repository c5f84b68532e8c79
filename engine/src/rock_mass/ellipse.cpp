// Ellipses of fracture networks: their axes and outlines.

#include <cmath>
#include <numbers>

#include "talus/fractures.h"
#include "talus/rock_mass.h"

namespace talus {

Vec3 majorAxis(const Fracture& ellipse) {
    const double strike = ellipse.dip_direction - 0.5 * std::numbers::pi;
    const Vec3 along(std::sin(strike), std::cos(strike), 0);
    const Vec3 down(std::cos(ellipse.dip) * std::sin(ellipse.dip_direction),
                    std::cos(ellipse.dip) * std::cos(ellipse.dip_direction), -std::sin(ellipse.dip));
    return std::cos(ellipse.rake) * along + std::sin(ellipse.rake) * down;
}

std::vector<Vec3> outlineOf(const Fracture& ellipse) {
    constexpr int kCorners = 64;  // as of discs
    constexpr double kAngle = 2 * std::numbers::pi / kCorners;
    const Vec3 normal = upwardNormal(ellipse.dip, ellipse.dip_direction);
    const Vec3 major = majorAxis(ellipse), minor = normal.cross(major);
    // Of the polygon: kCorners triangles of a b sin(angle) / 2.
    const double larger = std::sqrt(kAngle / std::sin(kAngle));
    std::vector<Vec3> corners;
    corners.reserve(kCorners);
    for (int k = 0; k < kCorners; ++k)
        corners.push_back(ellipse.centre + larger * (ellipse.radius * std::cos(k * kAngle) * major +
                                                     ellipse.semi_minor * std::sin(k * kAngle) * minor));
    return corners;
}

}  // namespace talus
