// How much of a disc lies inside a closed surface. The disc's plane cuts the surface in closed lines with the
// inside on their left. The circle's area within them is a signed sum over their pieces p q: its common area
// with the triangle (centre, p, q). So the lines need not be assembled.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/face_frame.h"
#include "rock_mass/circle.h"
#include "rock_mass/surface_faults.h"
#include "talus/fractures.h"
#include "talus/rock_mass.h"

namespace talus {

namespace {

using namespace rock_mass;

constexpr double kSectorRounding =
    1e-10;  // of the radius squared: sectors that add up to nothing, but for this

}  // namespace

std::pair<double, double> dipOf(const Vec3& normal) {
    const Vec3 up = normal.z() < 0 ? Vec3(-normal) : normal;
    const double direction = std::atan2(up.x(), up.y());
    return {std::atan2(up.head<2>().norm(), up.z()),
            direction < 0 ? direction + 2 * std::numbers::pi : direction};
}

double areaInside(const Fracture& disc, const TriangleSurface& region) {
    const Vec3 normal = upwardNormal(disc.dip, disc.dip_direction);
    const Vec3 e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
    double sum = 0, enclosed = 0;  // enclosed: by the lines alone, about a point on them
    bool whole = true;             // no line leaves the circle
    std::optional<Vec2> origin;
    for (std::size_t t = 0; t < region.triangles.size(); ++t) {
        std::array<double, 3> height;
        for (std::size_t i = 0; i < 3; ++i) height[i] = normal.dot(cornerOf(region, t, i) - disc.centre);
        const bool above = height[0] >= 0;
        if ((height[1] >= 0) == above && (height[2] >= 0) == above) continue;
        Vec2 up = Vec2::Zero(), down = Vec2::Zero();  // where its outline goes through the plane
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if ((height[i] >= 0) == (height[j] >= 0)) continue;
            const Vec3 &p = cornerOf(region, t, i), &q = cornerOf(region, t, j);
            const Vec3 x = p + height[i] / (height[i] - height[j]) * (q - p) - disc.centre;
            (height[j] >= 0 ? up : down) = Vec2(e1.dot(x), e2.dot(x)) / disc.radius;
        }
        sum += commonArea(down, up);
        if (!origin) origin = down;
        enclosed += 0.5 * cross(down - *origin, up - *origin);
        whole = whole && down.squaredNorm() <= 1 && up.squaredNorm() <= 1;
    }
    // For a disc far larger than the region the sectors are all rounding.
    if (whole) return std::max(enclosed, 0.0) * disc.radius * disc.radius;
    return sum > kSectorRounding ? sum * disc.radius * disc.radius : 0;
}

double fractureIntensity(const std::vector<Fracture>& discs, const TriangleSurface& region) {
    double area = 0;
    for (const Fracture& disc : discs) area += areaInside(disc, region);
    return area / surfaceVolume(region);
}

}  // namespace talus
