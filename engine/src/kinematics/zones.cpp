// The tests of one plane and of one line.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/gravity.h"
#include "talus/kinematics.h"
#include "talus/rock_mass.h"

namespace talus::kinematics {

namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

double horizontal(const Vec3& v) { return std::hypot(v.x(), v.y()); }

/// Of a vector from a plane of this upward normal, positive above it [rad].
double angleAbove(const Vec3& line, double dip, double dip_direction) {
    return std::asin(std::clamp(line.dot(upwardNormal(dip, dip_direction)), -1.0, 1.0));
}

/// Between the horizontal part of a vector and a direction, 0..pi [rad]; 0 of a vertical one.
double azimuthFrom(const Vec3& v, double direction) {
    if (horizontal(v) < kSameAngle) return 0;
    const double sine = std::sin(direction), cosine = std::cos(direction);
    return std::abs(std::atan2(v.x() * cosine - v.y() * sine, v.x() * sine + v.y() * cosine));
}

/// How far within the lateral limits, these included.
double withinLateral(double azimuth, double lateral) { return lateral - azimuth + 2 * kSameAngle; }

double steepness(const Vec3& line) { return std::atan2(-line.z(), horizontal(line)); }

}  // namespace

Vec3 normalUnderGravity(const Vec3& normal, const Gravity& gravity) {
    const Vec3 turned = compass(gravity, gravity.tilt).transpose() * normal;
    return turned.z() < 0 ? Vec3(-turned) : turned;
}

double dipOfPlane(const Vec3& normal) { return std::atan2(horizontal(normal), normal.z()); }

double plungeOf(const Vec3& line) { return steepness(line); }

double trendOf(const Vec3& line) {
    if (horizontal(line) < kSameAngle) return 0;
    const double trend = std::atan2(line.x(), line.y());
    return trend < 0 ? trend + 2 * std::numbers::pi : trend;
}

std::optional<Vec3> dipVector(const Vec3& normal) {
    const double across = horizontal(normal);
    if (across < kSameAngle) return std::nullopt;
    return Vec3(normal.z() * normal.x() / across, normal.z() * normal.y() / across, -across);
}

std::optional<Vec3> intersection(const Vec3& normal_a, const Vec3& normal_b) {
    const Vec3 along = normal_a.cross(normal_b);
    const double sine = along.norm();
    if (sine < kParallel) return std::nullopt;
    return Vec3((along.z() > 0 ? -1 / sine : 1 / sine) * along);
}

double daylight(const Vec3& line, const Face& face) { return angleAbove(line, face.dip, face.dip_direction); }

double planarMargin(const Vec3& normal, const Face& face, const Limits& limits) {
    const auto steepest = dipVector(normal);
    if (!steepest) return -limits.friction;  // a horizontal plane never slides
    return std::min({dipOfPlane(normal) - limits.friction, daylight(*steepest, face),
                     withinLateral(azimuthFrom(*steepest, face.dip_direction), limits.lateral)});
}

double wedgeMargin(const Vec3& line, const Face& face, double friction) {
    return std::min(daylight(line, face), steepness(line) - friction);
}

double secondaryWedgeMargin(const Vec3& line, const Face& face, double friction) {
    return std::min({daylight(line, face), -angleAbove(line, friction, face.dip_direction),
                     friction - steepness(line) + 2 * kSameAngle});
}

SlidesOn slidesOn(const Vec3& normal_a, const Vec3& normal_b) {
    const auto leaves = [](const Vec3& from, const Vec3& plane) {
        const auto steepest = dipVector(from);
        if (!steepest) return false;
        const double away = steepest->dot(plane);
        // Of a vertical plane the normal's sign is a choice, and both sides are possible.
        return plane.z() < kSameAngle ? std::abs(away) > kSameAngle : away > kSameAngle;
    };
    if (leaves(normal_a, normal_b)) return SlidesOn::first;
    return leaves(normal_b, normal_a) ? SlidesOn::second : SlidesOn::both;
}

double directTopplingMargin(const Vec3& line, const Face& face, const Limits& limits) {
    return std::min(steepness(line) - (kRightAngle - face.dip),
                    withinLateral(azimuthFrom(line, face.dip_direction + std::numbers::pi), limits.lateral));
}

double obliqueTopplingMargin(const Vec3& line, const Face& face, const Limits& limits) {
    const double off = azimuthFrom(line, face.dip_direction + std::numbers::pi);
    const double plunge = steepness(line);
    return std::min({off - limits.lateral, kRightAngle - off, plunge - (kRightAngle - limits.friction),
                     plunge - (kRightAngle - face.dip)});
}

double flexuralTopplingMargin(const Vec3& pole, const Face& face, const Limits& limits) {
    const double slip_limit = face.dip - limits.friction;
    if (slip_limit <= 0) return slip_limit;
    return std::min(angleAbove(pole, slip_limit, face.dip_direction),
                    withinLateral(azimuthFrom(pole, face.dip_direction), limits.lateral));
}

bool planarSliding(const Vec3& normal, const Face& face, const Limits& limits) {
    return planarMargin(normal, face, limits) > kSameAngle;
}

bool flexuralToppling(const Vec3& normal, const Face& face, const Limits& limits) {
    double margin = flexuralTopplingMargin(-normal, face, limits);
    // A vertical plane plots at both ends of a diameter.
    if (normal.z() < kSameAngle) margin = std::max(margin, flexuralTopplingMargin(normal, face, limits));
    return margin > kSameAngle;
}

WedgeZone wedgeZone(const Vec3& line, const Face& face, double friction) {
    if (wedgeMargin(line, face, friction) > kSameAngle) return WedgeZone::primary;
    return secondaryWedgeMargin(line, face, friction) > kSameAngle ? WedgeZone::secondary : WedgeZone::none;
}

TopplingZone topplingZone(const Vec3& line, const Face& face, const Limits& limits) {
    if (directTopplingMargin(line, face, limits) > kSameAngle) return TopplingZone::direct;
    return obliqueTopplingMargin(line, face, limits) > kSameAngle ? TopplingZone::oblique
                                                                  : TopplingZone::none;
}

}  // namespace talus::kinematics
