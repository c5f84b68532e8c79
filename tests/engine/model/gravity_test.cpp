#include "model/gravity.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/models.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("model") {
    TEST_CASE("a tilt and the direction it gives are the same gravity, and so is a push towards downhill") {
        for (const double tilt_deg : {-20.0, 0.0, 35.0}) {
            const double tilt = radians(tilt_deg);
            const Gravity plain{};
            const Vec3 down = downward(plain, tilt);
            CHECK((down - Vec3(-std::sin(tilt), 0, -std::cos(tilt))).norm() == 0);
            const Gravity turned{.direction = 7.0 * down};
            CHECK((downward(turned, 0) - down).norm() < 1e-15);
            CHECK((downward(turned, 0.1) - downward(plain, tilt + 0.1)).norm() < 1e-15);
            const Seismic downhill{};
            CHECK((pushOf(downhill, plain, tilt) - Vec3(-std::cos(tilt), 0, std::sin(tilt))).norm() == 0);
            CHECK((pushOf(downhill, turned, 0) - pushOf(downhill, plain, tilt)).norm() < 1e-15);
        }
    }

    TEST_CASE("an earthquake pushes level, clockwise from north, and upwards") {
        for (const auto& [azimuth, way] :
             {std::pair<double, Vec3>{0, {0, 1, 0}}, {90, {1, 0, 0}}, {180, {0, -1, 0}}}) {
            const Seismic seismic{.horizontal = 0.2, .azimuth = radians(azimuth), .vertical = 0.1};
            CHECK((pushOf(seismic, {}, 0) - way).norm() == 0);
            CHECK((seismicShare(seismic, 0.2, {}, 0) - (0.2 * way + Vec3(0, 0, 0.1))).norm() < 1e-16);
        }
        const Gravity odd{.direction = Vec3(1, 2, -3)};
        for (const double azimuth : {20.0, 140.0, 300.0}) {
            const Vec3 push = pushOf({.azimuth = radians(azimuth)}, odd, 0.3);
            CHECK(push.norm() == doctest::Approx(1).epsilon(1e-14));
            CHECK(std::abs(push.dot(downward(odd, 0.3))) < 1e-15);
        }
    }
}
