#include "flow/equations.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>

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
    std::vector<double> unit = std::vector(network.triangles.size(), 1.0);
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
