#include "step/time_step.h"

#include <doctest/doctest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>

#include "build/build.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "step/motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Highest omega^2 of the closed assembly: stiffness by central differences of the forces, dense eigenvalues.
double highestByBruteForce(const State& state) {
    const std::size_t n = state.blocks.size() - 1;  // block 0 is the floor
    const auto size = static_cast<Eigen::Index>(6 * n);
    Eigen::MatrixXd scaled(size, size);
    const double h = 1e-9;
    for (Eigen::Index column = 0; column < size; ++column) {
        Eigen::VectorXd difference(size);
        for (const double sign : {1.0, -1.0}) {
            State moved = state;
            const auto b = static_cast<std::size_t>(column / 6) + 1;
            const int axis = static_cast<int>(column % 6);
            if (axis < 3) {
                Vec3 x = moved.blocks.position.get(b);
                x[axis] += sign * h;
                moved.blocks.position.set(b, x);
            } else {  // boxes: own axes are the model's, so a small quaternion does
                moved.blocks.orientation[b].x = axis == 3 ? sign * h / 2 : 0;
                moved.blocks.orientation[b].y = axis == 4 ? sign * h / 2 : 0;
                moved.blocks.orientation[b].z = axis == 5 ? sign * h / 2 : 0;
            }
            updateForces(moved, false);
            for (std::size_t k = 0; k < n; ++k) {
                const Wrench wrench = outOfBalance(moved, k + 1, Vec3::Zero());
                for (int i = 0; i < 3; ++i) {
                    const auto row = static_cast<Eigen::Index>(6 * k) + i;
                    const double force = -wrench.force[i] / (2 * h), torque = -wrench.torque[i] / (2 * h);
                    difference[row] = sign > 0 ? force : difference[row] - force;
                    difference[row + 3] = sign > 0 ? torque : difference[row + 3] - torque;
                }
            }
        }
        scaled.col(column) = difference;
    }
    Eigen::VectorXd root(size);
    for (std::size_t k = 0; k < n; ++k) {
        const auto row = static_cast<Eigen::Index>(6 * k);
        root.segment<3>(row).setConstant(std::sqrt(state.blocks.mass[k + 1]));
        root.segment<3>(row + 3) = state.blocks.inertia.get(k + 1).cwiseSqrt();
    }
    scaled = root.cwiseInverse().asDiagonal() * scaled * root.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd symmetric = 0.5 * (scaled + scaled.transpose());
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
}

State bonded(Model model) {
    for (Joint& j : model.joints) j.cohesion = j.tensile_strength = 1e15;
    model.gravity.magnitude = 0;
    return *buildState(model, false);
}

}  // namespace

TEST_SUITE("step") {
    TEST_CASE("the frequency bound is exact for one block on the floor") {
        Model model = floorModel(30, 1e9);
        addBox(model, "box", {0, 0, 0}, {0.6, 0.4, 0.5});
        const State state = bonded(model);
        const std::vector<double> bounds = frequencyBounds(state, false);
        CHECK(bounds[1] == doctest::Approx(highestByBruteForce(state)).epsilon(1e-4));
        CHECK(bounds[0] == 0);
    }

    TEST_CASE("it bounds the highest frequency of assemblies, and not by much") {
        for (const auto& [columns, rows, slices] :
             {std::array{3, 1, 1}, std::array{1, 4, 1}, std::array{3, 3, 2}}) {
            const State state = bonded(stackModel(columns, rows, slices, 30));
            const std::vector<double> bounds = frequencyBounds(state, false);
            const double bound = *std::max_element(bounds.begin(), bounds.end());
            const double exact = highestByBruteForce(state);
            MESSAGE(columns << " x " << rows << " x " << slices << ": bound over exact " << bound / exact);
            CHECK(bound >= exact * (1 - 1e-6));
            CHECK(bound < 2.0 * exact);
        }
    }

    TEST_CASE("the step is stable just below 2/omega and not just above") {
        Model model = floorModel(30, 1e9);
        addBox(model, "box", {0, 0, 0}, {0.6, 0.4, 0.5});
        State state = bonded(model);
        const double limit = stableTimeStep(frequencyBounds(state, false)[1], 0.0);
        const auto motionAfter = [&](double dt) {
            State moving = state;
            moving.blocks.velocity.set(1, {1e-6, 2e-6, -1e-6});
            moving.blocks.angular_momentum.set(1, {1e-5, -1e-5, 2e-5});
            const double before = kineticEnergy(moving);
            for (int k = 0; k < 2000; ++k) advance(moving, {dt, false});
            return kineticEnergy(moving) / before;
        };
        CHECK(motionAfter(0.97 * limit) < 100);
        CHECK_FALSE(motionAfter(1.03 * limit) < 1e6);  // also when it has become nan
    }

    TEST_CASE("contact damping shortens the stable step as the formula says") {
        Model model = floorModel(30, 1e9);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1}, 1000);
        State state = bonded(model);
        state.damping.contact = 5e-4;
        const double limit = stableTimeStep(frequencyBounds(state, false)[1], state.damping.contact);
        CHECK(frequencyOfStep(limit, state.damping.contact) ==
              doctest::Approx(frequencyBounds(state, false)[1]).epsilon(1e-12));
        const auto energyAfter = [&](double dt) {
            State moving = state;
            moving.blocks.velocity.set(1, {1e-4, 1e-4, -1e-4});
            moving.blocks.angular_momentum.set(1, {1e-3, 2e-3, 0});
            for (int k = 0; k < 3000; ++k) advance(moving, {dt, false});
            return kineticEnergy(moving);
        };
        CHECK(energyAfter(0.97 * limit) < 1e-3);
        CHECK_FALSE(energyAfter(1.2 * limit) < 1.0);
    }
}
