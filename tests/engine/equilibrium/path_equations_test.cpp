#include "equilibrium/path_equations.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <random>

#include "forces/sum.h"
#include "support/paths.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

/// Equations about a state, with all that they refer to.
struct Equations {
    State state;
    SearchRules rules{};
    PathWork work{};
    FirstOrderGaps gaps{state};
    PathEquations path{state, gaps, rules, nullptr, work};

    Equations(State given, const Loading& loading, double load) : state(std::move(given)) {
        path.setLoading(loading, load);
        path.take();
    }
};

Model twoBoxes() {
    Model model = floorModel(30, 1e9);
    model.joints[0].shear_stiffness = 4e8;
    addBox(model, "a", {0, 0, 0}, {0.4, 0.2, 0.1});
    addBox(model, "b", {0.1, 0.05, 0.1}, {0.4, 0.2, 0.1});
    return model;
}

/// Displacements that close some contact points, open others and let some slip.
Vec6s shake(std::size_t rows, int seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> both(-1, 1);
    Vec6s x(rows);
    for (std::size_t r = 0; r < rows; ++r) {
        for (int k = 0; k < 6; ++k) x[r][k] = 2e-6 * both(random);
        x[r].z() -= 1e-6 * static_cast<double>(r + 1);
    }
    return x;
}

double largest(const Vec6s& x) {
    double most = 0;
    for (const Vec6& v : x) most = std::max(most, v.cwiseAbs().maxCoeff());
    return most;
}

constexpr double kPathLoad = 0.05;

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("path equations: the matrix is minus the derivative of the residual by the displacements") {
        const Model model = twoBoxes();
        const search::LoadAxis tilt = search::tiltAxis(model, {});
        for (int seed = 0; seed < 30; ++seed) {
            Equations equations(*buildState(model, false), tilt.loading, kPathLoad);
            PathEquations& path = equations.path;
            const Arc arc{.unknown = Unknown::load, .displacement = 1e-3, .load = 0.01};
            const PathStep at{.unknown = Unknown::load, .x = shake(2, seed), .value = 0.003};
            const Poses poses = path.moved(at.x);
            Vec6s force;
            path.residual(arc, at, poses, true, force);
            REQUIRE(path.factorise(arc, at));  // adds the drag to the matrix
            const BlockMatrix matrix = path.balance().matrix;
            const auto residualAt = [&](const Vec6s& unit, double by) {
                PathStep moved = at;
                Poses there = poses;
                move(path.balance(), unit, by, there);
                for (std::size_t r = 0; r < 2; ++r) moved.x[r] += by * unit[r];
                Vec6s result;
                path.residual(arc, moved, there, false, result);
                return result;
            };
            constexpr double kStep = 1e-10;
            for (std::size_t column = 0; column < 12; ++column) {
                Vec6s unit(2, Vec6::Zero()), product;
                unit[column / 6][static_cast<Eigen::Index>(column % 6)] = 1;
                matrix.multiply(unit, product);
                const Vec6s up = residualAt(unit, kStep), down = residualAt(unit, -kStep);
                for (std::size_t r = 0; r < 2; ++r)
                    REQUIRE((product[r] + (up[r] - down[r]) / (2 * kStep)).norm() <
                            1e-5 * path.balance().drag[r]);
            }
        }
    }

    TEST_CASE("path equations: the derivative by the load is that of the residual, for each kind of load") {
        Model model = twoBoxes();
        model.gravity.tilt = kPathLoad;
        struct Kind {
            const char* name;
            search::LoadAxis axis;
            double load;
        };
        const Kind kinds[] = {{"tilt", search::tiltAxis(model, {}), kPathLoad},
                              {"strength", search::strengthAxis(model, {}), 1.2},
                              {"horizontal", search::accelerationAxis(model, {}), 0.03},
                              {"weight", search::weightAxis(1e-4), 0.7}};
        for (const Kind& kind : kinds) {
            CAPTURE(kind.name);
            for (int seed = 0; seed < 10; ++seed) {
                Equations equations(*buildState(model, false), kind.axis.loading, kind.load);
                PathEquations& path = equations.path;
                const Arc arc{.unknown = Unknown::load, .displacement = 1e-3, .load = 0.01};
                const PathStep at{.unknown = Unknown::load, .x = shake(2, seed), .value = 0.002};
                const Poses poses = path.moved(at.x);
                Vec6s rate, up, down;
                path.byUnknown(arc, at, poses, rate);
                PathStep more = at, less = at;
                constexpr double kStep = 1e-6;
                more.value += kStep, less.value -= kStep;
                path.residual(arc, more, poses, false, up);
                path.residual(arc, less, poses, false, down);
                for (std::size_t r = 0; r < 2; ++r)
                    CHECK((rate[r] - (up[r] - down[r]) / (2 * kStep)).norm() < 1e-3 * (1 + largest(rate)));
            }
        }
    }

    TEST_CASE("path equations: by the tilt, the weight turns") {
        const Model model = twoBoxes();
        const search::LoadAxis tilt = search::tiltAxis(model, {});
        const double beta = radians(20);
        Equations equations(*buildState(model, false), tilt.loading, beta);
        const Arc arc{.unknown = Unknown::load, .displacement = 1e-3, .load = 0.01};
        const PathStep at{.unknown = Unknown::load, .x = Vec6s(2, Vec6::Zero())};
        Vec6s rate;
        equations.path.byUnknown(arc, at, equations.path.poses(), rate);
        for (std::size_t r = 0; r < 2; ++r) {
            const double weight = equations.path.balance().weight[r];
            CHECK(rate[r].x() == doctest::Approx(-weight * std::cos(beta)).epsilon(1e-5));
            CHECK(rate[r].z() == doctest::Approx(weight * std::sin(beta)).epsilon(1e-5));
            CHECK(std::abs(rate[r].y()) < 1e-9 * weight);
        }
    }

    TEST_CASE("path equations: by the drag, each block is held by the stiffness of its joints") {
        const Model model = twoBoxes();
        const search::LoadAxis tilt = search::tiltAxis(model, {});
        Equations equations(*buildState(model, false), tilt.loading, kPathLoad);
        PathEquations& path = equations.path;
        const Arc arc{.unknown = Unknown::drag, .displacement = 1e-3};
        const PathStep at{.unknown = Unknown::drag, .x = shake(2, 3), .value = 0.2};
        const Poses poses = path.moved(at.x);
        Vec6s rate, with, without;
        path.byUnknown(arc, at, poses, rate);
        PathStep free = at;
        free.value = 0;
        path.residual(arc, at, poses, false, with);
        path.residual(arc, free, poses, false, without);
        for (std::size_t r = 0; r < 2; ++r) {
            CHECK((rate[r] + path.balance().drag[r] * at.x[r]).norm() < 1e-12 * rate[r].norm());
            CHECK((with[r] - without[r] - 0.2 * rate[r]).norm() < 1e-9 * rate[r].norm());
        }
    }

    TEST_CASE(
        "path equations: in pseudo-time each block is held by the stiffness of its joints, and by more when "
        "it is slowed") {
        const Model model = twoBoxes();
        const search::LoadAxis tilt = search::tiltAxis(model, {});
        Equations equations(*buildState(model, false), tilt.loading, kPathLoad);
        PathEquations& path = equations.path;
        const PathStep at{.unknown = Unknown::none, .x = shake(2, 3)};
        const Poses poses = path.moved(at.x);
        const auto residual = [&](double drag) {
            const Arc arc{.unknown = Unknown::none, .displacement = kInfinity, .drag = drag};
            Vec6s force;
            path.residual(arc, at, poses, false, force);
            return force;
        };
        const Vec6s once = residual(0.2), twice = residual(0.4);
        const auto held = [&](std::size_t r) { return Vec6(path.balance().drag[r] * at.x[r]); };
        for (std::size_t r = 0; r < 2; ++r)
            CHECK((once[r] - twice[r] - 0.2 * held(r)).norm() < 1e-9 * held(r).norm());
        // A block that is slowed has more of it, until it has recovered.
        path.slow({1});
        CHECK((residual(0.2)[0] - once[0]).norm() == 0);
        const double more = path.rules().release_slowed - 1;
        CHECK((once[1] - residual(0.2)[1] - more * 0.2 * held(1)).norm() < 1e-9 * held(1).norm());
        for (int k = 0; k < 5; ++k) path.recover(0.5);
        CHECK((residual(0.2)[1] - once[1]).norm() < 1e-9 * held(1).norm());
    }

    TEST_CASE("path equations: the worst rows are the fewest with nearly all of a residual") {
        Equations equations(*buildState(twoBoxes(), false), search::tiltAxis(twoBoxes(), {}).loading, 0);
        const std::vector<double>& weight = equations.path.balance().weight;
        const auto worst = [&](double first, double second) {
            Vec6s force(2, Vec6::Zero());
            force[0].x() = first * weight[0];
            force[1].z() = second * weight[1];
            return equations.path.worstRows(force);
        };
        CHECK(worst(1, 0.1) == std::vector<std::size_t>{0});
        CHECK(worst(0.1, -1) == std::vector<std::size_t>{1});
        CHECK(worst(1, -2) == std::vector<std::size_t>{1, 0});
        CHECK(worst(1, kInfinity).empty());
    }

    TEST_CASE("path equations: displacements are measured in sizes of the blocks, of pebbles in a share") {
        Model model = floorModel(30, 1e9);
        for (int k = 0; k < 4; ++k) addBox(model, "b" + std::to_string(k), {1.0 * k, 0, 0}, {0.4, 0.4, 0.4});
        addBox(model, "pebble", {6, 0, 0}, {0.01, 0.01, 0.01});
        const search::LoadAxis tilt = search::tiltAxis(model, {});
        Equations equations(*buildState(model, false), tilt.loading, 0);
        const PathEquations& path = equations.path;
        const auto normOf = [&](std::size_t row) {
            Vec6s x(5, Vec6::Zero());
            x[row].x() = 0.4;
            return path.norm(x);
        };
        CHECK(normOf(0) == doctest::Approx(1));
        CHECK(normOf(4) == doctest::Approx(1 / equations.rules.least_block_size));
        Vec6s both(5, Vec6::Zero());
        both[0].x() = 0.4, both[1].y() = 0.4;
        CHECK(path.norm(both) == doctest::Approx(std::sqrt(2.0)));
        CHECK(path.dot(both, both) == doctest::Approx(2));
    }

    TEST_CASE("path equations: a residual is compared with a hundredth of a cell of the load") {
        const Model model = twoBoxes();
        search::LoadAxis tilt = search::tiltAxis(model, {});
        Equations equations(*buildState(model, false), tilt.loading, 0);
        const PathEquations& path = equations.path;
        const double limit = equations.rules.equilibrium_tolerance * tilt.loading.imbalance;
        CHECK(path.limitOf(0) == doctest::Approx(limit));
        Vec6s force(2, Vec6::Zero());
        force[1].x() = equations.rules.newton_accuracy * limit * path.balance().weight[1];
        CHECK(path.inaccuracy(force) == doctest::Approx(1));
        force[0].y() = std::nan("");
        CHECK(std::isinf(path.inaccuracy(force)));
        // Far from the origin on stiff joints rounding leaves more.
        Model far = floorModel(30, 1e13);
        addBox(far, "a", {15, 0, 0}, {0.4, 0.2, 0.001});
        tilt.loading.imbalance = 1e-9;
        CHECK(Equations(*buildState(far, false), tilt.loading, 0).path.limitOf(0) > 2e-11);
    }
}
