#include "equilibrium/point_response.h"

#include <doctest/doctest.h>
#include <Eigen/Core>

#include <random>

using namespace talus;
using PointResponse = equilibrium::PointResponse<double>;

namespace {

/// Joints and contact points with and without what they may have: cohesion, tension, dilation, a bond partly
/// gone.
struct Case {
    contact::JointLaw joint;
    contact::PointMemory memory;
    double area, slide_1, slide_2, gap;
};

Case randomCase(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    Case c{};
    c.joint.normal_stiffness = 1e9 * (1 + unit(random));
    c.joint.shear_stiffness = 1e9 * (1 + unit(random));
    c.joint.tan_friction = unit(random);
    c.joint.residual_tan_friction = c.joint.tan_friction * unit(random);
    if (unit(random) < 0.5) {
        c.joint.cohesion = 1e3 * unit(random);
        c.joint.tensile_strength = 1e3 * unit(random);
        c.joint.bonded = true;
        if (unit(random) < 0.5) c.joint.softening = 2e-5 * unit(random);
    }
    c.memory.bond = unit(random) < 0.3 ? 0.0 : unit(random) < 0.5 ? 1.0 : unit(random);
    c.memory.dilation = 1e-7 * unit(random);
    c.memory.offset_1 = 1e-6 * both(random);
    c.memory.offset_2 = 1e-6 * both(random);
    c.area = 0.01 * (1 + unit(random));
    c.slide_1 = 1e-6 * both(random);
    c.slide_2 = 1e-6 * both(random);
    c.gap = 2e-6 * both(random);
    return c;
}

PointResponse responseOf(const Case& c) {
    return equilibrium::pointResponse<true, double>(c.joint, c.area, c.slide_1, c.slide_2, c.gap, c.memory);
}

Eigen::Vector3d forceOf(const PointResponse& point) { return {point.shear_1, point.shear_2, point.normal}; }

Eigen::Matrix3d stiffnessOf(const PointResponse& point) {
    Eigen::Matrix3d k;
    k << point.by_1_1, point.by_1_2, point.by_gap_1, point.by_1_2, point.by_2_2, point.by_gap_2, 0, 0,
        point.by_gap_n;
    return k;
}

Eigen::Matrix3d differences(const Case& c) {
    constexpr double kStep = 1e-12;
    Eigen::Matrix3d result;
    for (int column = 0; column < 3; ++column) {
        Case more = c, less = c;
        for (auto [at, sign] : {std::pair{&more, 1.0}, std::pair{&less, -1.0}})
            (column == 0 ? at->slide_1 : column == 1 ? at->slide_2 : at->gap) += sign * kStep;
        result.col(column) = (forceOf(responseOf(more)) - forceOf(responseOf(less))) / (2 * kStep);
    }
    return result;
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("the response is the contact law's, without release") {
        std::mt19937 random(5);
        int slips = 0, open = 0, softened = 0;
        for (int k = 0; k < 20000; ++k) {
            const Case c = randomCase(random);
            contact::PointMemory memory = c.memory;
            const contact::PointForce law =
                contact::contactLaw(c.joint, c.area, c.gap, c.slide_1, c.slide_2, 0.0, memory);
            // Further softening is released when the step is committed.
            if (memory.bond != c.memory.bond) continue;
            const PointResponse point = responseOf(c);
            REQUIRE((forceOf(point) - Eigen::Vector3d(law.shear_1, law.shear_2, law.normal)).norm() <=
                    1e-12 * forceOf(point).norm());
            REQUIRE(point.open == law.open);
            REQUIRE(point.slips == law.slips);
            slips += point.slips;
            open += point.open;
            softened +=
                contact::softens(c.joint) && c.memory.bond > 0 && c.memory.bond < 1 && point.normal < 0;
        }
        CHECK(slips > 200);
        CHECK(softened > 10);
        CHECK(open > 200);
    }

    TEST_CASE("its stiffness is its derivative") {
        std::mt19937 random(7);
        for (int k = 0; k < 2000; ++k) {
            const Case c = randomCase(random);
            // Random states are at a corner of the law with probability nil; near one the difference sees it.
            const double scale = c.joint.normal_stiffness * c.area;
            REQUIRE((stiffnessOf(responseOf(c)) - differences(c)).norm() < 2e-5 * scale);
        }
    }

    TEST_CASE("a bond that holds shear but no tension gives no jump where the joint opens") {
        std::mt19937 random(11);
        int shears = 0;
        for (int k = 0; k < 2000; ++k) {
            Case c = randomCase(random);
            c.joint.softening = 0;
            c.joint.tensile_strength = 0;
            c.joint.bonded = c.joint.cohesion > 0;
            if (!c.joint.bonded) c.memory.bond = 1;
            constexpr double kNear = 1e-16;  // [m]
            c.gap = c.memory.dilation + kNear;
            const Eigen::Vector3d open = forceOf(responseOf(c));
            c.gap = c.memory.dilation - kNear;
            const Eigen::Vector3d closed = forceOf(responseOf(c));
            REQUIRE((open - closed).norm() < 1e-9 * c.joint.normal_stiffness * c.area * 1e-6);
            shears += open.norm() > 0;
        }
        CHECK(shears > 200);
    }
}
