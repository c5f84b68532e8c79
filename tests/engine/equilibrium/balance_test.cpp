#include "equilibrium/balance.h"

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include <random>

#include "build/build.h"
#include "forces/sum.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

/// Two boxes one on the other on a floor, pressed together and moved at random, so that some contact points
/// stick, slip and open.
State shaken(int seed, StrengthLaw law = StrengthLaw::coulomb, PointRule::Kind rule = PointRule::Kind::vertex,
             double cohesion = 0) {
    Model model = floorModel(30, 1e9);
    model.points.kind = rule;
    model.joints[0].shear_stiffness = 4e8;
    model.joints[0].law = law;
    model.joints[0].cohesion = model.joints[0].residual_cohesion = cohesion;
    model.joints[0].jrc = 12;  // at some 1 to 4 kPa
    model.joints[0].jcs = 5e4;
    if (law == StrengthLaw::barton_bandis) model.joints[0].residual_friction = radians(20);
    model.joints[0].a = 1.5;
    model.joints[0].b = 0.85;
    model.joints[0].shear_strength = {{0, 10}, {900, 600}, {5e3, 1.5e3}};
    addBox(model, "a", {0, 0, 0}, {0.4, 0.2, 0.1});
    addBox(model, "b", {0.1, 0.05, 0.1}, {0.4, 0.2, 0.1});
    State state = *buildState(model, false);
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> both(-1, 1);
    const Balance balance = makeBalance(state);
    Vec6s by(2);
    for (Vec6& v : by)
        for (int k = 0; k < 6; ++k) v[k] = 2e-6 * both(random);
    for (std::size_t r = 0; r < 2; ++r) by[r].z() -= 1e-6 * static_cast<double>(r + 1);
    Poses poses = posesOf(state);
    move(balance, by, 1.0, poses);
    setPoses(poses, state);
    return state;
}

PointRule::Kind ruleOf(int seed) {
    return (seed / 4) % 2 == 0 ? PointRule::Kind::vertex : PointRule::Kind::distributed;
}

/// Every law with every rule; Coulomb's with and without cohesion.
State shakenOfEach(int seed) {
    const auto law = static_cast<StrengthLaw>(seed % 4);
    const bool has_cohesion = law == StrengthLaw::coulomb && (seed / 8) % 2 == 1;
    return shaken(seed, law, ruleOf(seed), has_cohesion ? 400 : 0);
}

Vec6s forcesAt(const State& state, Balance& balance, const Poses& poses) {
    Vec6s force;
    sumForces(state, balance, poses, false, force);
    return force;
}

/// Forces and matrix by one build of the kernel.
std::pair<Vec6s, BlockMatrix> systemOf(State& state, simd::InstructionSet set) {
    state.instructions = set;
    Balance balance = makeBalance(state);
    Vec6s force;
    sumForces(state, balance, posesOf(state), true, force);
    return {force, balance.matrix};
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("forces are those of the engine's own kernel, with every law") {
        for (int seed = 0; seed < 80; ++seed) {
            State state = shakenOfEach(seed);
            Balance balance = makeBalance(state);
            const Vec6s force = forcesAt(state, balance, posesOf(state));
            state.release = 0;  // on the way to equilibrium bonds hold
            updateForces(state, false);
            for (std::size_t r = 0; r < 2; ++r) {
                const Wrench own = outOfBalance(state, balance.block[r], bodyAcceleration(state));
                CHECK((force[r].head<3>() - own.force).norm() < 1e-6);
                CHECK((force[r].tail<3>() * balance.radius[r] - own.torque).norm() < 1e-6);
            }
        }
    }

    TEST_CASE("of some of the blocks: their rows of the whole system, the others held") {
        State state = *buildState(stackModel(7, 6, 2, 30), false);
        for (std::size_t b = 0; b < state.blocks.size(); ++b)
            if (state.blocks.motion[b] == Motion::free)
                state.blocks.position.set(
                    b, state.blocks.position.get(b) - Vec3(0, 0, 1e-7 * static_cast<double>(b % 5)));
        Balance all = makeBalance(state);
        std::vector<char> moving(state.blocks.size(), 0);
        for (std::size_t b = 0; b < moving.size(); ++b) moving[b] = b % 3 == 1;
        Balance some = makeBalance(state, moving);
        REQUIRE((some.block.size() > 20 && some.block.size() < all.block.size() / 2));
        Vec6s of_all, of_some;
        sumForces(state, all, posesOf(state), true, of_all);
        sumForces(state, some, posesOf(state), true, of_some);
        for (std::size_t r = 0; r < some.block.size(); ++r) {
            const auto row = static_cast<std::size_t>(all.row[some.block[r]]);
            CHECK((of_some[r].array() == of_all[row].array()).all());
            CHECK(some.matrix.diagonal[r] == all.matrix.diagonal[row]);
            CHECK(some.drag[r] == all.drag[row]);
        }
        const auto block_of = [&](std::int32_t row) { return some.block[static_cast<std::size_t>(row)]; };
        for (std::size_t e = 0; e < some.matrix.edges.size(); ++e) {
            const std::pair pair{all.row[block_of(some.matrix.edges[e].first)],
                                 all.row[block_of(some.matrix.edges[e].second)]};
            const auto& edges = all.matrix.edges;
            const auto found = std::lower_bound(edges.begin(), edges.end(), pair);
            REQUIRE((found != edges.end() && *found == pair));
            CHECK(some.matrix.upper[e] == all.matrix.upper[static_cast<std::size_t>(found - edges.begin())]);
        }
    }

    TEST_CASE("momentum: force and moment of the two sides add up to nothing") {
        for (int seed = 0; seed < 20; ++seed) {
            const State state = shaken(seed);
            Balance balance = makeBalance(state);
            const Poses poses = posesOf(state);
            forcesAt(state, balance, poses);
            for (const ActiveInterface& i : balance.interfaces) {
                const InterfaceWrench& w = balance.wrenches[i.slot];
                const Vec3 apart = poses.position.get(i.block_b) - poses.position.get(i.block_a);
                CHECK((w.moment_a + w.moment_b + apart.cross(w.force)).norm() <
                      1e-12 * (1 + w.moment_b.norm()));
            }
        }
    }

    TEST_CASE("the same bits from each build") {
        for (const simd::InstructionSet set : {simd::InstructionSet::avx2, simd::InstructionSet::avx512}) {
            if (!simd::isAvailable(set)) continue;
            for (int seed = 0; seed < 40; ++seed) {
                State state = shakenOfEach(seed);
                const auto [scalar_force, scalar_matrix] = systemOf(state, simd::InstructionSet::scalar);
                const auto [force, matrix] = systemOf(state, set);
                CHECK(force == scalar_force);
                CHECK(matrix.diagonal == scalar_matrix.diagonal);
                CHECK(matrix.upper == scalar_matrix.upper);
                CHECK(matrix.lower == scalar_matrix.lower);
            }
        }
    }

    TEST_CASE("the matrix is minus the derivative of the forces, finite turns and lever arms included") {
        constexpr double kStep = 1e-10;
        for (int seed = 0; seed < 60; ++seed) {
            const State state = shakenOfEach(seed);
            Balance balance = makeBalance(state);
            const Poses poses = posesOf(state);
            Vec6s force;
            sumForces(state, balance, poses, true, force);
            const BlockMatrix matrix = balance.matrix;
            for (std::size_t column = 0; column < 12; ++column) {
                Vec6s unit(2, Vec6::Zero()), product;
                unit[column / 6][static_cast<Eigen::Index>(column % 6)] = 1;
                matrix.multiply(unit, product);
                Poses more = poses, less = poses;
                move(balance, unit, kStep, more);
                move(balance, unit, -kStep, less);
                const Vec6s up = forcesAt(state, balance, more), down = forcesAt(state, balance, less);
                for (std::size_t r = 0; r < 2; ++r)
                    REQUIRE((product[r] + (up[r] - down[r]) / (2 * kStep)).norm() < 1e-5 * balance.drag[r]);
            }
        }
    }
}
