#include "rock_mass/joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "rock_mass/circle.h"
#include "rock_mass/random.h"

namespace talus {

Vec3 upwardNormal(double dip, double dip_direction) {
    Vec3 normal(std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction),
                std::cos(dip));
    // Right angles given in degrees are exact to some 1e-16 only.
    for (double& component : normal)
        if (std::abs(component) < 1e-15) component = 0;
    return normal.normalized();
}

namespace rock_mass {

namespace {

constexpr std::int64_t kMostPlanes = 1'000'000;  // of all sets
constexpr double kEvenness = 1e-3;               // of its size: how far corners may lie off a polygon's plane

/// Distance of a convex outline in the frame's plane from the frame's origin; 0 inside.
double distanceFromOrigin(const Polygon& outline) {
    double nearest = kInfinity;
    bool inside = true;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 a = outline[i], edge = outline.next(i) - a;
        inside = inside && edge.x() * -a.y() - edge.y() * -a.x() >= 0;
        const double along = std::clamp(-a.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (a + along * edge).norm());
    }
    return inside ? 0 : nearest;
}

Vec3 polygonNormal(const std::vector<Vec3>& corners) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    return 0.5 * sum;
}

double sizeOf(const std::vector<Vec3>& corners) {
    double size = 0;
    for (const Vec3& corner : corners) size = std::max(size, (corner - corners[0]).norm());
    return size;
}

std::optional<Error> polygonFault(const SingleJoint& joint) {
    const auto& corners = joint.polygon;
    const std::string field = joint.field + ".polygon";
    if (corners.size() < 3)
        return Error{field, "found " + std::to_string(corners.size()) + " corners, allowed: at least three"};
    const Vec3 area = polygonNormal(corners);
    const double size = sizeOf(corners);
    if (!(area.norm() > 1e-9 * size * size))
        return Error{field, "found corners on one line, allowed: corners that span a plane"};
    const Vec3 normal = area.normalized();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()],
                   &c = corners[(i + 2) % corners.size()];
        const std::string corner = field + "[" + std::to_string((i + 1) % corners.size()) + "]";
        if (std::abs(normal.dot(a - corners[0])) > kEvenness * size)
            return Error{field + "[" + std::to_string(i) + "]",
                         "found a corner off the plane of the others, allowed: corners in one plane"};
        if (normal.dot((b - a).cross(c - b)) <= 0)
            return Error{corner,
                         "found a polygon that is not convex here, allowed: a convex one, corners in order"};
    }
    return std::nullopt;
}

Plane planeThrough(const Vec3& point, const Vec3& normal, std::size_t source, std::int64_t number) {
    return {normal, normal.dot(point), static_cast<std::int32_t>(source), static_cast<std::int32_t>(number)};
}

/// From plane `number` to the next along the normal [m].
double gapBehind(const JointSet& set, std::size_t index, std::int64_t number, std::uint64_t seed) {
    if (set.law == SpacingLaw::constant) return set.spacing;
    const double u = Random(seed, 2 * index, number).uniform();
    if (set.law == SpacingLaw::uniform) return set.spacing * (1 + set.spread * (2 * u - 1));
    return -set.spacing * std::log(1 - u);
}

struct Station {
    double along = 0;  ///< the normal, from the model's origin [m]
    std::int64_t number = 0;
};

/// Places of the planes between `low` and `high` [m] along the normal; nothing if there are too many.
std::vector<Station> stations(const JointSet& set, std::size_t index, double low, double high,
                              std::uint64_t seed) {
    const double start = upwardNormal(set.dip, set.dip_direction).dot(set.origin) + set.offset;
    std::vector<Station> found;
    if (set.law == SpacingLaw::constant) {
        const double first = std::ceil((low - start) / set.spacing),
                     last = std::floor((high - start) / set.spacing);
        if (last - first > kMostPlanes || std::abs(first) > 1e9 || std::abs(last) > 1e9) return {};
        for (auto k = static_cast<std::int64_t>(first); k <= static_cast<std::int64_t>(last); ++k)
            found.push_back({start + static_cast<double>(k) * set.spacing, k});
        return found;
    }
    std::int64_t steps = 0;
    double along = start;
    for (std::int64_t k = 0; along <= high && ++steps < 4 * kMostPlanes; ++k) {
        if (along >= low) found.push_back({along, k});
        along += gapBehind(set, index, k, seed);
    }
    along = start;
    for (std::int64_t k = -1; ++steps < 4 * kMostPlanes; --k) {
        along -= gapBehind(set, index, k, seed);
        if (along < low) break;
        if (along <= high) found.push_back({along, k});
    }
    std::sort(found.begin(), found.end(),
              [](const Station& a, const Station& b) { return a.number < b.number; });
    if (steps >= 4 * kMostPlanes || found.size() > static_cast<std::size_t>(kMostPlanes)) return {};
    return found;
}

/// The middle one first, then the middles of the halves: so that the tree of cuts stays shallow.
void appendHalving(const std::vector<JointPlane>& ordered, std::size_t begin, std::size_t end,
                   std::vector<JointPlane>& planes) {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    planes.push_back(ordered[middle]);
    appendHalving(ordered, begin, middle, planes);
    appendHalving(ordered, middle + 1, end, planes);
}

std::optional<Error> appendSet(const RockMass& description, std::size_t index,
                               const std::vector<Vec3>& corners, std::vector<JointPlane>& planes) {
    const JointSet& set = description.sets[index];
    const Vec3 normal = upwardNormal(set.dip, set.dip_direction);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : corners) middle += corner / static_cast<double>(corners.size());
    double low = kInfinity, high = -kInfinity, radius = 0;
    for (const Vec3& corner : corners) {
        low = std::min(low, normal.dot(corner));
        high = std::max(high, normal.dot(corner));
        radius = std::max(radius, (corner - middle).norm());
    }
    if (set.fisher) {  // planes from farther away may lean into the region
        low = normal.dot(middle) - 1.5 * radius;
        high = normal.dot(middle) + 1.5 * radius;
    }
    const auto places = stations(set, index, low, high, description.seed);
    if (places.empty() && high - low > static_cast<double>(kMostPlanes) * 0.5 * set.spacing)
        return Error{set.field + ".spacing",
                     "found more than " + std::to_string(kMostPlanes) +
                         " planes through the region, allowed: a wider spacing, or an origin "
                         "nearer to the region"};
    std::vector<JointPlane> ordered;
    for (const Station& place : places) {
        const Vec3 point = middle + (place.along - normal.dot(middle)) * normal;
        Random random(description.seed, 2 * index + 1, place.number);
        Plane plane = set.fisher
                          ? planeThrough(point, scattered(normal, *set.fisher, random), index, place.number)
                          : Plane{normal, place.along, static_cast<std::int32_t>(index),
                                  static_cast<std::int32_t>(place.number)};
        ordered.push_back({plane, std::nullopt, index});
    }
    if (planes.size() + ordered.size() > static_cast<std::size_t>(kMostPlanes))
        return Error{set.field + ".spacing", "found more than " + std::to_string(kMostPlanes) +
                                                 " planes of all joint sets so far, allowed: wider spacings"};
    appendHalving(ordered, 0, ordered.size(), planes);
    return std::nullopt;
}

Reach discReach(const SingleJoint& joint, const Vec3& normal) {
    Reach reach{{joint.point, normal.unitOrthogonal(), Vec3::Zero(), normal}, *joint.radius};
    reach.frame.e2 = normal.cross(reach.frame.e1);
    // Of a disc of radius r: r sqrt(1 - n_i^2) along axis i.
    const Vec3 half = *joint.radius * (Vec3::Ones() - normal.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    reach.min = joint.point - half;
    reach.max = joint.point + half;
    return reach;
}

Reach polygonReach(const SingleJoint& joint, const Vec3& normal) {
    Reach reach{faceFrame(joint.polygon[0], joint.polygon[1], normal)};
    reach.min = reach.max = joint.polygon[0];
    for (const Vec3& corner : joint.polygon) {
        reach.polygon.push(reach.frame.toPlane(corner));
        reach.min = reach.min.cwiseMin(corner);
        reach.max = reach.max.cwiseMax(corner);
    }
    return reach;
}

std::vector<Vec3> cornersOfDisc(const Reach& disc) {
    constexpr int kCorners = 64;
    constexpr double kAngle = 2 * std::numbers::pi / kCorners;
    // Of the polygon: corners r^2 sin(angle) / 2 each.
    const double radius = disc.radius * std::sqrt(kAngle / std::sin(kAngle));
    std::vector<Vec3> corners;
    corners.reserve(kCorners);
    for (int k = 0; k < kCorners; ++k)
        corners.push_back(disc.frame.toWorld({radius * std::cos(k * kAngle), radius * std::sin(k * kAngle)}));
    return corners;
}

JointPlane singlePlane(const SingleJoint& joint, std::size_t source) {
    if (joint.polygon.empty()) {
        const Vec3 normal = upwardNormal(joint.dip, joint.dip_direction);
        JointPlane plane{planeThrough(joint.point, normal, source, 0), std::nullopt, source};
        if (joint.radius) plane.reach = discReach(joint, normal);
        return plane;
    }
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : joint.polygon) middle += corner / static_cast<double>(joint.polygon.size());
    Vec3 normal = polygonNormal(joint.polygon).normalized();
    for (double& component : normal)
        if (std::abs(component) < 1e-15) component = 0;
    // The plane's normal looks up; the polygon stays counter-clockwise about its own.
    const Vec3 upward = normal.z() < 0 ? Vec3(-normal) : normal;
    return {planeThrough(middle, upward, source, 0), polygonReach(joint, normal), source};
}

}  // namespace

Polygon Reach::flat(const std::vector<Vec3>& outline) const {
    Polygon flat;
    for (const Vec3& corner : outline) flat.push(frame.toPlane(corner));
    double doubled = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) doubled += cross(flat[i], flat.next(i));
    if (doubled >= 0) return flat;
    Polygon turned;
    for (std::size_t i = flat.size(); i-- > 0;) turned.push(flat[i]);
    return turned;
}

double Reach::coveredArea(const Polygon& outline) const {
    if (radius > 0) return areaInCircle(outline, radius);
    const Polygon common = intersect(outline, polygon);
    return common.empty() ? 0 : area(common);
}

bool Reach::covers(const std::vector<Vec3>& outline, double weld) const {
    const Polygon flat = this->flat(outline);
    if (radius > 0) return distanceFromOrigin(flat) < radius - weld;
    const Polygon common = intersect(flat, polygon);
    return !common.empty() && area(common) > weld * extent(common);
}

std::vector<Error> checkJoints(const RockMass& description) {
    std::vector<Error> errors;
    for (const JointSet& set : description.sets) {
        if (!(set.spacing > 0) || !std::isfinite(set.spacing))
            errors.push_back(
                {set.field + ".spacing", "found a spacing that is not positive, allowed: greater than 0"});
        if (!(set.spread >= 0 && set.spread < 1))
            errors.push_back(
                {set.field + ".spread", "found a spread outside 0..1, allowed: at least 0 and less than 1"});
        if (set.fisher && !(*set.fisher > 0))
            errors.push_back({set.field + ".fisher",
                              "found a Fisher constant that is not positive, allowed: greater than 0"});
    }
    for (const SingleJoint& joint : description.singles) {
        if (joint.radius && !(*joint.radius > 0))
            errors.push_back(
                {joint.field + ".radius", "found a radius that is not positive, allowed: greater than 0"});
        if (!joint.polygon.empty())
            if (auto fault = polygonFault(joint)) errors.push_back(std::move(*fault));
    }
    return errors;
}

Result<std::vector<JointPlane>> jointPlanes(const RockMass& description, const std::vector<Vec3>& corners) {
    std::vector<JointPlane> planes, finite;
    for (std::size_t i = 0; i < description.sets.size(); ++i)
        if (auto fault = appendSet(description, i, corners, planes)) return *fault;
    for (std::size_t i = 0; i < description.singles.size(); ++i) {
        JointPlane plane = singlePlane(description.singles[i], description.sets.size() + i);
        (plane.reach ? finite : planes).push_back(std::move(plane));
    }
    planes.insert(planes.end(), finite.begin(), finite.end());
    return planes;
}

}  // namespace rock_mass

std::vector<Vec3> outlineOf(const SingleJoint& joint) {
    if (!joint.polygon.empty() || !joint.radius) return joint.polygon;
    return rock_mass::cornersOfDisc(
        rock_mass::discReach(joint, upwardNormal(joint.dip, joint.dip_direction)));
}

}  // namespace talus
