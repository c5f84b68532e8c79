// Both projections: places by hand, their inverse, areas and angles kept.

#include "report/net.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::tools;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Vec3 line(double plunge, double trend) {
    return {std::cos(plunge * kDeg) * std::sin(trend * kDeg),
            std::cos(plunge * kDeg) * std::cos(trend * kDeg), -std::sin(plunge * kDeg)};
}

}  // namespace

TEST_CASE("net: places by hand") {
    const Net area({100, 100}, 50, Projection::equal_area), angle({100, 100}, 50, Projection::equal_angle);
    for (const Net* net : {&area, &angle}) {
        CHECK(net->onNet(line(90, 0)).y == doctest::Approx(0));
        CHECK(net->onNet(line(0, 0)).y == doctest::Approx(1));  // north at the top
        CHECK(net->onPage(line(0, 0)).y == doctest::Approx(50));
        CHECK(net->onPage(line(0, 90)).x == doctest::Approx(150));  // east at the right
    }
    CHECK(area.onNet(line(30, 180)).y == doctest::Approx(-std::sqrt(2.0) * std::sin(30 * kDeg)));
    CHECK(angle.onNet(line(30, 180)).y == doctest::Approx(-std::tan(30 * kDeg)));
}

TEST_CASE("net: a place leads back to its line, over the edge, too") {
    for (const Projection projection : {Projection::equal_area, Projection::equal_angle}) {
        const Net net({0, 0}, 1, projection);
        for (double trend = 5; trend < 360; trend += 40)
            for (double plunge = -6; plunge < 90; plunge += 7)
                CHECK((net.lineAt(net.onNet(line(plunge, trend))) - line(plunge, trend)).norm() < 1e-12);
        CHECK((net.lineAt({0, 0}) + Vec3::UnitZ()).norm() < 1e-15);
    }
}

TEST_CASE("net: equal-area keeps the share of the hemisphere, equal-angle keeps circles") {
    const Net area({0, 0}, 1, Projection::equal_area);
    for (const double t : {10.0, 40.0, 80.0})
        CHECK(std::pow(area.radiusOf(t * kDeg), 2) == doctest::Approx(1 - std::cos(t * kDeg)));
    // A cone of 20 degrees about a line that plunges 50: all its places have one distance from one middle.
    const Net angle({0, 0}, 1, Projection::equal_angle);
    const double middle = 0.5 * (std::tan(30 * kDeg) + std::tan(10 * kDeg));
    const double radius = 0.5 * (std::tan(30 * kDeg) - std::tan(10 * kDeg));
    const Vec3 axis = line(50, 90), side = Vec3::UnitY(), other = axis.cross(side);
    for (int k = 0; k < 12; ++k) {
        const Vec3 on = std::cos(20 * kDeg) * axis + std::sin(20 * kDeg) * (std::cos(30 * k * kDeg) * side +
                                                                            std::sin(30 * k * kDeg) * other);
        const Spot at = angle.onNet(on);
        CHECK(std::hypot(at.x - middle, at.y) == doctest::Approx(radius));
    }
}

TEST_CASE("net: a great circle goes through the dip vector and both ends of the strike") {
    const Net net({0, 0}, 1, Projection::equal_area);
    const auto arc = net.greatCircle(upwardNormal(50 * kDeg, 120 * kDeg));
    const auto near = [&](const Spot& a, const Spot& b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-12; };
    CHECK(near(arc.front(), net.onPage(line(0, 30))) != near(arc.front(), net.onPage(line(0, 210))));
    CHECK(near(arc.back(), net.onPage(line(0, 30))) != near(arc.back(), net.onPage(line(0, 210))));
    CHECK(near(arc[arc.size() / 2], net.onPage(line(50, 120))));
    CHECK(net.greatCircle(Vec3::UnitZ()).size() > 100);  // a horizontal plane is the net's edge
}
