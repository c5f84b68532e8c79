// The tests of one plane and one line against the conditions of the field.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "rock_mass/random.h"
#include "talus/kinematics.h"
#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::kinematics;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Vec3 plane(double dip, double dip_direction) { return upwardNormal(dip * kDeg, dip_direction * kDeg); }
Vec3 line(double plunge, double trend) {
    return {std::cos(plunge * kDeg) * std::sin(trend * kDeg),
            std::cos(plunge * kDeg) * std::cos(trend * kDeg), -std::sin(plunge * kDeg)};
}
Face face(double dip, double dip_direction) { return {dip * kDeg, dip_direction * kDeg}; }
Limits limits(double friction, double lateral = 20) { return {friction * kDeg, lateral * kDeg}; }

bool slides(const Vec3& normal, double friction = 30, double lateral = 20) {
    return planarSliding(normal, face(70, 180), limits(friction, lateral));
}

bool topples(const Vec3& normal, double friction = 30) {
    return flexuralToppling(normal, face(70, 180), limits(friction));
}

/// The smaller angle between two azimuths [deg].
double between(double a, double b) {
    const double d = std::fmod(std::abs(a - b), 360);
    return std::min(d, 360 - d);
}

}  // namespace

TEST_CASE("lines: dip vector, plunge and trend, intersection") {
    CHECK((*dipVector(plane(40, 120)) - line(40, 120)).norm() < 1e-15);
    CHECK_FALSE(dipVector(plane(0, 120)));
    CHECK(dipOfPlane(plane(89.999999, 7)) == doctest::Approx(89.999999 * kDeg).epsilon(1e-14));
    CHECK(plungeOf(line(89.999999, 7)) == doctest::Approx(89.999999 * kDeg).epsilon(1e-14));
    CHECK(trendOf(line(20, 355)) == doctest::Approx(355 * kDeg).epsilon(1e-14));
    // Two planes that dip 45 to the south-east and the south-west meet in a line to the south: tan(plunge) =
    // cos 45.
    const auto met = intersection(plane(45, 135), plane(45, 225));
    REQUIRE(met);
    CHECK((*met - line(std::atan(std::sqrt(0.5)) / kDeg, 180)).norm() < 1e-15);
    CHECK((*met - *intersection(plane(45, 225), plane(45, 135))).norm() < 1e-15);
    CHECK_FALSE(intersection(plane(45, 135), plane(45, 135)));
    CHECK_FALSE(intersection(plane(90, 0), plane(90, 180)));  // one plane
}

TEST_CASE(
    "planar sliding: steeper than friction, flatter than the face along its dip direction, within the "
    "limits") {
    CHECK(slides(plane(45, 180)));
    CHECK_FALSE(slides(plane(29.9, 180)));
    CHECK_FALSE(slides(plane(30, 180)));  // at the limit of friction
    CHECK(slides(plane(30.1, 180)));
    CHECK(slides(plane(69.9, 180)));
    CHECK_FALSE(slides(plane(70, 180)));  // the face's own plane
    CHECK_FALSE(slides(plane(45, 0)));    // into the face
    CHECK(slides(plane(45, 200)));        // the lateral limits are included, in every notation of the angle
    CHECK(slides(plane(45, 160)));
    CHECK(slides(plane(45, 160 - 360)));
    CHECK_FALSE(slides(plane(45, 200.1)));
    CHECK_FALSE(slides(plane(45, 159.9)));
    // Apparent dip of the face 60 degrees off its dip direction: tan = tan 70 cos 60.
    const double apparent = std::atan(std::tan(70 * kDeg) * 0.5) / kDeg;
    CHECK(slides(plane(apparent - 0.01, 240), 30, 90));
    CHECK_FALSE(slides(plane(apparent + 0.01, 240), 30, 90));
}

TEST_CASE("planar sliding: horizontal and vertical planes, friction of 0 and 90, a vertical face") {
    for (const double friction : {0.0, 30.0, 90.0}) {
        CHECK_FALSE(slides(plane(0, 0), friction, 90));
        CHECK_FALSE(slides(plane(90, 180), friction, 90));
    }
    CHECK(slides(plane(0.01, 180), 0));
    CHECK_FALSE(slides(plane(69, 180), 90));
    const Face wall = face(90, 180);
    CHECK(planarSliding(plane(89.9, 180), wall, limits(30)));
    CHECK_FALSE(planarSliding(plane(90, 180), wall, limits(30)));
    CHECK(planarSliding(plane(89.9, 269), wall,
                        limits(30, 90)));  // apparent dip of a wall is 90 within its half
    CHECK_FALSE(planarSliding(plane(89.9, 271), wall, limits(30, 90)));
}

TEST_CASE("wedges: the line's plunge against friction and the apparent dip of the face") {
    const Face slope = face(70, 180);
    CHECK(wedgeZone(line(45, 180), slope, 30 * kDeg) == WedgeZone::primary);
    CHECK(wedgeZone(line(30, 180), slope, 30 * kDeg) == WedgeZone::none);
    CHECK(wedgeZone(line(70, 180), slope, 30 * kDeg) == WedgeZone::none);
    CHECK(wedgeZone(line(45, 0), slope, 30 * kDeg) == WedgeZone::none);
    CHECK(wedgeZone(line(45, 240), slope, 30 * kDeg) == WedgeZone::primary);  // no lateral limits
    // Below the plane that dips at the friction angle: tan(plunge) > tan 30 cos 60, or plunge > 16.1.
    CHECK(wedgeZone(line(20, 240), slope, 30 * kDeg) == WedgeZone::secondary);
    CHECK(wedgeZone(line(30, 240), slope, 30 * kDeg) == WedgeZone::secondary);
    CHECK(wedgeZone(line(16, 240), slope, 30 * kDeg) == WedgeZone::none);
    CHECK(wedgeZone(line(30.1, 240), slope, 30 * kDeg) == WedgeZone::primary);
    // A face no steeper than friction has neither zone.
    for (double trend = 95; trend < 270; trend += 10)
        for (double plunge = 0; plunge <= 90; plunge += 2)
            CHECK(wedgeZone(line(plunge, trend), face(30, 180), 30 * kDeg) == WedgeZone::none);
}

TEST_CASE("wedges: friction of 0 and of 90 degrees") {
    for (double trend = 1; trend < 360; trend += 17)
        for (double plunge = 1; plunge < 90; plunge += 4) {
            const Face slope = face(70, 180);
            const bool comes_out =
                std::tan(plunge * kDeg) < std::tan(70 * kDeg) * std::cos((trend - 180) * kDeg);
            CHECK((wedgeZone(line(plunge, trend), slope, 0) == WedgeZone::primary) == comes_out);
            CHECK(wedgeZone(line(plunge, trend), slope, 90 * kDeg) == WedgeZone::none);
        }
}

TEST_CASE("wedges: they slide on one plane where its dip vector leads away from the other") {
    // Symmetrical planes: along the line. With 45/180 and 60/250 the first dips between the line and ... by
    // the rule below.
    CHECK(slidesOn(plane(45, 135), plane(45, 225)) == SlidesOn::both);
    rock_mass::Random random(7);
    int one = 0, both = 0;
    for (int k = 0; k < 2000; ++k) {
        const double dip_a = 5 + 80 * random.uniform(), dip_b = 5 + 80 * random.uniform();
        const double to_a = 360 * random.uniform(), to_b = 360 * random.uniform();
        // Hocking: on A where tan(dip B) cos(to_b - to_a), the apparent dip of B along A's dip direction,
        // exceeds tan(dip A).
        const double off = std::cos((to_b - to_a) * kDeg);
        const bool on_a = std::tan(dip_b * kDeg) * off > std::tan(dip_a * kDeg);
        const bool on_b = std::tan(dip_a * kDeg) * off > std::tan(dip_b * kDeg);
        const SlidesOn expected = on_a ? SlidesOn::first : on_b ? SlidesOn::second : SlidesOn::both;
        CHECK(slidesOn(plane(dip_a, to_a), plane(dip_b, to_b)) == expected);
        (expected == SlidesOn::both ? both : one) += 1;
        if (expected == SlidesOn::both) continue;
        // The dip direction of the plane it slides on lies between the other's and the line's (Hocking 1976).
        const Vec3 met = *intersection(plane(dip_a, to_a), plane(dip_b, to_b));
        const double trend = trendOf(met) / kDeg, own = on_a ? to_a : to_b, other = on_a ? to_b : to_a;
        CHECK(between(own, trend) + between(own, other) == doctest::Approx(between(trend, other)));
        CHECK(std::max(dip_a, dip_b) >= plungeOf(met) / kDeg);
    }
    CHECK(one > 200);
    CHECK(both > 200);
}

TEST_CASE("direct toppling: lines into the face within the lateral limits, steeper than 90 minus its dip") {
    const Face slope = face(70, 180);
    const auto zone = [&](double plunge, double trend, double friction = 30) {
        return topplingZone(line(plunge, trend), slope, limits(friction));
    };
    CHECK(zone(75, 0) == TopplingZone::direct);
    CHECK(zone(20.1, 0) == TopplingZone::direct);
    CHECK(zone(20, 0) == TopplingZone::none);
    CHECK(zone(75, 20) == TopplingZone::direct);  // included
    CHECK(zone(75, 340) == TopplingZone::direct);
    CHECK(zone(75, 20.1) == TopplingZone::oblique);  // within 30 degrees of vertical
    CHECK(zone(59, 30) == TopplingZone::none);
    CHECK(zone(61, 89) == TopplingZone::oblique);
    CHECK(zone(61, 91) == TopplingZone::none);  // out of the face
    CHECK(zone(75, 180) == TopplingZone::none);
    for (const double trend : {0.0, 90.0, 180.0}) CHECK(zone(90, trend) == TopplingZone::direct);
    // Base planes by their poles: they dip out of the face, less steeply than it.
    const auto base = [&](double dip, double towards) {
        return topplingZone(-plane(dip, towards), slope, limits(30));
    };
    CHECK(base(0, 0) == TopplingZone::direct);
    CHECK(base(69, 180) == TopplingZone::direct);
    CHECK(base(70, 180) == TopplingZone::none);
    CHECK(base(10, 0) == TopplingZone::none);  // into the face
    CHECK(base(29, 240) == TopplingZone::oblique);
    CHECK(base(31, 240) == TopplingZone::none);
}

TEST_CASE("flexural toppling: (90 - dip) + friction < dip of the face, into the face within the limits") {
    CHECK(topples(plane(80, 0)));
    CHECK(topples(plane(50.1, 0)));
    CHECK_FALSE(topples(plane(50, 0)));
    CHECK_FALSE(topples(plane(80, 180)));
    CHECK(topples(plane(80, 20)));
    CHECK(topples(plane(80, 340)));
    CHECK_FALSE(topples(plane(80, 20.1)));
    // 15 degrees off, the slip limit's apparent dip: tan(90 - dip) < tan 40 cos 15.
    const double least = 90 - std::atan(std::tan(40 * kDeg) * std::cos(15 * kDeg)) / kDeg;
    CHECK(topples(plane(least + 0.01, 15)));
    CHECK_FALSE(topples(plane(least - 0.01, 15)));
    // A vertical plane is the same with either dip direction.
    CHECK(topples(plane(90, 0)));
    CHECK(topples(plane(90, 180)));
    CHECK_FALSE(topples(plane(90, 90)));
    CHECK_FALSE(topples(plane(0, 0)));
    for (const double friction : {70.0, 90.0}) CHECK_FALSE(topples(plane(89, 0), friction));
    CHECK(topples(plane(20.1, 0), 0));
    CHECK(flexuralToppling(plane(30.1, 0), face(90, 180), limits(30)));
    CHECK_FALSE(flexuralToppling(plane(30, 0), face(90, 180), limits(30)));
}

TEST_CASE("planes of a tilted model are taken as they lie under gravity") {
    Gravity gravity;
    CHECK((normalUnderGravity(plane(35, 200), gravity) - plane(35, 200)).norm() < 1e-15);
    gravity.tilt = 20 * kDeg;  // downhill is -x, west
    CHECK((normalUnderGravity(plane(0, 0), gravity) - plane(20, 270)).norm() < 1e-15);
    CHECK((normalUnderGravity(plane(30, 270), gravity) - plane(50, 270)).norm() < 1e-14);
    CHECK((normalUnderGravity(plane(80, 270), gravity) - plane(80, 90)).norm() < 1e-14);
    gravity = {};
    gravity.direction = Vec3(-std::sin(20 * kDeg), 0, -std::cos(20 * kDeg));
    CHECK((normalUnderGravity(plane(30, 270), gravity) - plane(50, 270)).norm() < 1e-14);
}
