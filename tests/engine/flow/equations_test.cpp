#include "flow/equations.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "flow/cubic_law.h"
#include "flow/linear_system.h"
#include "flow/solve.h"
#include "support/flow_network.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A small dam and its equations.
struct Dam : FlowNetwork {
    Dam() : FlowNetwork(gridDam(3, 3, 1, {1, 1, 1}, 2.4, 0.6)) {}

    // Of 1 m2/s each, so that differences of inflows compare with 1.
    std::vector<flow::Corners> unit = std::vector(network.triangles.size(), flow::Corners{1, 1, 1});
    flow::Equations equations{network, conditions, unit};

    flow::Vector anyHeads(unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> between(-0.5, 2.5);
        flow::Vector heads(static_cast<Eigen::Index>(network.nodes.size()));
        for (double& head : heads) head = between(random);
        equations.hold(heads);
        return heads;
    }
};

}  // namespace

TEST_CASE("flow equations: the derivative is that of the inflows, by differences") {
    const Dam dam;
    for (const double ramp : {1.0, 0.1}) {
        const flow::Vector heads = dam.anyHeads(3);
        const Eigen::MatrixXd derivative =
            dam.equations.derivative(heads, dam.equations.wetnessOf(heads, ramp));
        const auto inflowAt = [&](const flow::Vector& at) {
            return dam.equations.inflows(at, dam.equations.wetnessOf(at, ramp));
        };
        constexpr double kStep = 1e-6;
        for (Eigen::Index j = 0; j < heads.size(); ++j) {
            if (dam.equations.isHeld(static_cast<std::size_t>(j))) continue;
            flow::Vector more = heads, less = heads;
            more[j] += kStep;
            less[j] -= kStep;
            const flow::Vector slope = (inflowAt(more) - inflowAt(less)) / (2 * kStep);
            for (Eigen::Index i = 0; i < heads.size(); ++i)
                if (!dam.equations.isHeld(static_cast<std::size_t>(i)))
                    CHECK(std::abs(derivative(i, j) - slope[i]) < 1e-4 * (1 + std::abs(slope[i])));
        }
    }
}

namespace {

/// A triangle with its angles somewhere between flat and equal.
flow::Network drawnTriangle(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    flow::Network network;
    network.nodes = {{0, 0, 0}, {1, 0, 0}, {share(random), 0.02 + share(random), 0}};
    network.triangles = {{0, 1, 2}};
    return network;
}

flow::Corners alongSides(const flow::Corners& aperture) {
    return {flow::taperedTransmissivity(1, aperture[0], aperture[1], 1),
            flow::taperedTransmissivity(1, aperture[1], aperture[2], 1),
            flow::taperedTransmissivity(1, aperture[2], aperture[0], 1)};
}

}  // namespace

TEST_CASE("flow equations: flow along the slope of an aperture leaves a triangle as a linear head's does") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    for (int draw = 0; draw < 300; ++draw) {
        const flow::Network network = drawnTriangle(random);
        const double turn = angle(random);
        const Vec3 along(std::cos(turn), std::sin(turn), 0);
        const flow::Gradients gradients = flow::gradientsOf(network, 0);
        const flow::Corners even = flow::conductancesOf(gradients, {1, 1, 1});
        if (std::ranges::min(even) < 0) continue;  // no obtuse angle
        const auto x = [&](std::size_t k) { return network.corner(0, k).dot(along); };
        const auto b = [&](std::size_t k) { return 2 + x(k); };
        const flow::Corners tapered = flow::conductancesOf(gradients, alongSides({b(0), b(1), b(2)}));
        for (std::size_t k = 0, next = 1; k < 3; ++k, next = (k + 1) % 3) {
            // b^3 dh/dx = 12 has h = -6 / b^2.
            const double fall = 6 / (b(k) * b(k)) - 6 / (b(next) * b(next));
            CHECK(std::abs(tapered[k] * fall - even[k] * (x(next) - x(k))) < 1e-12);
        }
    }
}

TEST_CASE("flow equations: however apertures differ, a triangle with an obtuse angle dissipates") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0, 1);
    int obtuse = 0;
    for (int draw = 0; draw < 1000; ++draw) {
        const flow::Network network = drawnTriangle(random);
        const auto aperture = [&] { return std::pow(10.0, share(random)); };
        const auto c = flow::conductancesOf(flow::gradientsOf(network, 0),
                                            alongSides({aperture(), aperture(), aperture()}));
        // The form sum of c_ij (h_i - h_j)^2 is positive where its two principal minors are.
        CHECK(c[0] + c[1] + c[2] > 0);
        CHECK(c[0] * c[1] + c[1] * c[2] + c[2] * c[0] > 0);
        obtuse += std::ranges::min(c) < 0 ? 1 : 0;
    }
    CHECK(obtuse > 100);
}

TEST_CASE("flow equations: square polygons have an M-matrix, whatever the heads") {
    // Entries off the diagonal are negative, and no column sums to less than zero: heads are unique.
    const Dam dam;
    for (unsigned seed = 1; seed <= 10; ++seed)
        for (const double ramp : {1.0, 0.03}) {
            CAPTURE(seed);
            const flow::Vector heads = dam.anyHeads(seed);
            const Eigen::MatrixXd derivative =
                dam.equations.derivative(heads, dam.equations.wetnessOf(heads, ramp));
            const double rounding = 1e-13 * derivative.cwiseAbs().maxCoeff();
            for (Eigen::Index j = 0; j < heads.size(); ++j) {
                CHECK(derivative(j, j) > 0);
                CHECK(derivative.col(j).sum() > -rounding);
                for (Eigen::Index i = 0; i < heads.size(); ++i)
                    if (i != j) CHECK(derivative(i, j) < rounding);
            }
        }
}

TEST_CASE("flow equations: inflows sum to zero, whatever the heads") {
    const Dam dam;
    const flow::Vector heads = dam.anyHeads(5);
    const flow::Vector inflow = dam.equations.inflows(heads, dam.equations.wetnessOf(heads, 0.1));
    CHECK(std::abs(inflow.sum()) < 1e-12 * inflow.cwiseAbs().sum());
}

TEST_CASE("flow solution: outlets are under no pressure where water flows out, and closed elsewhere") {
    const Dam dam;
    const flow::Heads found = flow::solveHeads(dam.network, dam.conditions, dam.unit, true);
    REQUIRE(found.found);
    std::size_t open = 0, closed = 0;
    for (std::size_t n = 0; n < found.head.size(); ++n) {
        if (dam.conditions.of[n] != flow::Condition::outlet) continue;
        const double pressure_head = found.head[n] - dam.conditions.elevation[n];
        CHECK(pressure_head < 1e-8);
        CHECK(found.inflow[n] < 1e-12);
        (std::abs(pressure_head) < 1e-8 ? open : closed) += 1;
    }
    CHECK(open + closed > 0);
}

TEST_CASE("flow equations: a step of Newton's method is that of dense factors, also far from the solution") {
    const Dam dam;
    flow::LinearSystem system;
    for (unsigned seed = 1; seed <= 10; ++seed)
        for (const double ramp : {1.0, 0.03}) {
            CAPTURE(seed);
            const flow::Vector heads = dam.anyHeads(seed);
            const flow::Wetness wetness = dam.equations.wetnessOf(heads, ramp);
            const flow::SparseMatrix derivative = dam.equations.derivative(heads, wetness);
            flow::Vector right = -dam.equations.inflows(heads, wetness);
            for (Eigen::Index n = 0; n < right.size(); ++n)
                if (dam.equations.isHeld(static_cast<std::size_t>(n))) right[n] = 0;
            const auto step = system.solve(derivative, right);
            REQUIRE(step.has_value());
            const flow::Vector expected = Eigen::MatrixXd(derivative).fullPivLu().solve(right);
            CHECK((*step - expected).norm() < 1e-8 * expected.norm());
            for (Eigen::Index n = 0; n < right.size(); ++n)
                if (dam.equations.isHeld(static_cast<std::size_t>(n))) CHECK((*step)[n] == 0);
        }
}
