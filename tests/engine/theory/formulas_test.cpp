// The closed formulas against published values and against each other.

#include <doctest/doctest.h>

#include <cmath>

#include "models.h"
#include "talus/theory.h"

using namespace talus;
using namespace talus::theory;
using talus::theory::testing::kDegree;

namespace {

SlidingMass paperMass(int columns, double friction_deg, double water_depth) {
    return {0.2 * columns, 0.5, 2700, 1000, water_depth, friction_deg * kDegree, 0, 9.81};
}

}  // namespace

TEST_CASE("sliding mass: the exact limits of the paper's slope") {
    struct Row {
        int fissure;
        double phi_18, phi_19_5, phi_21;
    };
    for (const Row& row :
         {Row{1, 5.60, 7.25, 8.92}, Row{2, 11.94, 13.53, 15.13}, Row{3, 14.00, 15.56, 17.13},
          Row{4, 15.01, 16.56, 18.12}, Row{5, 15.62, 17.16, 18.70}, Row{6, 16.02, 17.55, 19.09}}) {
        CAPTURE(row.fissure);
        CHECK(std::abs(criticalTiltSliding(paperMass(row.fissure, 18, 0.35)) / kDegree - row.phi_18) <
              0.0051);
        CHECK(std::abs(criticalTiltSliding(paperMass(row.fissure, 19.5, 0.35)) / kDegree - row.phi_19_5) <
              0.0051);
        CHECK(std::abs(criticalTiltSliding(paperMass(row.fissure, 21, 0.35)) / kDegree - row.phi_21) <
              0.0051);
    }
    CHECK(criticalTiltSliding(paperMass(7, 19.5, 0)) / kDegree == doctest::Approx(19.5).epsilon(1e-12));
    CHECK(std::abs(criticalTiltSliding(paperMass(7, 19.5, 0.35)) / kDegree - 17.83) < 0.0051);
}

TEST_CASE("sliding mass: deep water moves a level slope") {
    CHECK(criticalTiltSliding(paperMass(1, 19.5, 0.5)) < 0);
}

TEST_CASE("sliding mass: with cohesion the forces balance at the critical tilt") {
    SlidingMass mass = paperMass(2, 19.5, 0.35);
    for (const double cohesion : {0.0, 10.0, 500.0, 3000.0}) {
        mass.cohesion = cohesion;
        const double tilt = criticalTiltSliding(mass);
        CAPTURE(cohesion);
        CHECK(factorOfSafetySliding(mass, tilt) == doctest::Approx(1).epsilon(1e-13));
        CHECK(factorOfSafetySliding(mass, tilt - 0.01) > 1);
        CHECK(factorOfSafetySliding(mass, tilt + 0.01) < 1);
    }
}

TEST_CASE("sliding mass: without friction or water, cohesion alone carries W sin(beta) = C x") {
    SlidingMass mass{1, 0.5, 2700, 1000, 0, 0, 4000, 9.81};
    CHECK(criticalTiltSliding(mass) == doctest::Approx(std::asin(4000 / (2700 * 9.81 * 0.5))).epsilon(1e-14));
    mass.cohesion = 2700 * 9.81 * 0.5 * 1.01;
    CHECK(std::isinf(criticalTiltSliding(mass)));
}

TEST_CASE("factor of safety of a dry mass is tan(phi) / tan(beta) (eq 15)") {
    const double beta = 10 * kDegree;
    CHECK(factorOfSafetySliding(paperMass(3, 19.5, 0), beta) ==
          doctest::Approx(std::tan(19.5 * kDegree) / std::tan(beta)).epsilon(1e-14));
    CHECK(std::isinf(factorOfSafetySliding(paperMass(3, 19.5, 0), 0)));
}

TEST_CASE("the paper's 6 %: a full fissure three times as far as it is deep lowers tan(beta) by 0.0617") {
    const SlidingMass mass{1.5, 0.5, 2700, 1000, 0.5, 19.5 * kDegree, 0, 9.81};
    const double drop = std::tan(19.5 * kDegree) - std::tan(criticalTiltSliding(mass));
    CHECK(drop == doctest::Approx(0.0617).epsilon(0.001));
    CHECK(drop / std::tan(19.5 * kDegree) == doctest::Approx(0.17).epsilon(0.03));  // not 6 % of tan(phi)
}

TEST_CASE("single bodies: sliding and toppling, dry, half full and full") {
    const double density = 26000 / 9.81;
    const auto slides = [density](double b, double h, double phi, double depth) {
        return criticalTiltSliding({b, h, density, 1000, depth, phi * kDegree, 0, 9.81}) / kDegree;
    };
    const auto topples = [density](double b, double h, double depth) {
        return criticalTiltToppling(b, h, density, depth) / kDegree;
    };
    CHECK(std::abs(slides(1, 1, 40, 0.5) - 38.38) < 0.0051);
    CHECK(std::abs(slides(1, 1, 40, 1.0) - 33.04) < 0.0051);
    CHECK(std::abs(topples(1, 2, 0) - 26.57) < 0.0051);
    CHECK(std::abs(topples(1, 2, 1) - 25.11) < 0.0051);
    CHECK(std::abs(topples(1, 2, 2) - 13.95) < 0.0051);
    CHECK(std::abs(topples(0.5, 1, 0.5) - 25.11) < 0.0051);
    CHECK(std::abs(slides(0.5, 1, 30, 1) - 11.31) < 0.0051);
    CHECK(std::abs(topples(0.4, 1, 0) - 21.80) < 0.0051);
}

TEST_CASE("plane failure with a tension crack (Hoek and Bray)") {
    TensionCrack slope;
    slope.face = 60 * kDegree;
    slope.plane = 35 * kDegree;
    slope.cohesion = 25000;
    slope.friction = 37 * kDegree;
    const double expected[] = {1.544, 1.464, 1.363, 1.247, 1.119};
    for (int depth = 0; depth <= 4; ++depth) {
        CAPTURE(depth);
        slope.crack_water_depth = depth;
        CHECK(planeFailure(slope).factor_of_safety == doctest::Approx(expected[depth]).epsilon(0.0005));
    }
    const TensionCrackResult result = planeFailure(slope);
    CHECK(std::abs(result.crack_depth - 4.348) < 0.0006);
    CHECK(std::abs(result.base_area - 13.34) < 0.006);
    CHECK(std::abs(result.weight - 1241.7e3) < 60);
    CHECK(result.thrust == doctest::Approx(9810 * 16 / 2.0));
    CHECK(result.uplift == doctest::Approx(9810 * 4 * result.base_area / 2));
}
