#include "equilibrium/local_equilibrium.h"

#include <doctest/doctest.h>

#include <vector>

#include "equilibrium/path_newton.h"
#include "support/paths.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

/// A wall in equilibrium, and a point of a step at its load: one block is displaced.
struct Displaced {
    LoadedPath loaded;
    PathWork work{};
    State state;
    FirstOrderGaps gaps;
    PathEquations equations;
    Arc arc{.unknown = Unknown::none, .displacement = kInfinity};
    PathStep at{.unknown = Unknown::none};
    Poses poses{};
    Vec6s residual{};

    Displaced(const Model& model, const SearchRules& rules, std::size_t row, const Vec3& by)
        : loaded(model, search::tiltAxis, rules),
          state(loaded.path.exactState()),
          gaps(state),
          equations(state, gaps, loaded.rules, nullptr, work) {
        equations.setLoading(loaded.axis.loading, 0);
        equations.take();
        at.x.assign(equations.balance().block.size(), Vec6::Zero());
        at.x[row].head<3>() += by;
        poses = equations.moved(at.x);
        equations.residual(arc, at, poses, true, residual);
    }
};

/// A wall of 6 by 5 blocks.
Model wall() { return stackModel(6, 5, 5, 35, {0.2, 0.1, 0.1}, 1e9); }

std::vector<std::size_t> movedRows(const PathStep& before, const PathStep& after) {
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < before.x.size(); ++r)
        if (before.x[r] != after.x[r]) rows.push_back(r);
    return rows;
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("blocks that alone are out of balance are brought into equilibrium, and no others move") {
        for (const double rings : {1.0, 2.0})
            for (const Vec3& by : {Vec3(3e-7, 0, 0), Vec3(0, 0, 5e-6), Vec3(-3e-7, 0, -1e-6)}) {
                CAPTURE(rings);
                CAPTURE(by.transpose());
                Displaced displaced(wall(), {.local_rings = rings, .local_share = 0.5}, 14, by);
                const PathStep before = displaced.at;
                const double residual = displaced.equations.merit(displaced.residual);
                REQUIRE(settleWorst(displaced.equations, displaced.arc, displaced.residual, displaced.at,
                                    displaced.poses));
                displaced.equations.residual(displaced.arc, displaced.at, displaced.poses, false,
                                             displaced.residual);
                const std::vector<std::size_t> moved = movedRows(before, displaced.at);
                CHECK(moved.size() >= 3);
                CHECK(moved.size() < 0.5 * static_cast<double>(before.x.size()));
                for (const std::size_t r : moved)
                    CHECK(displaced.equations.inaccuracy(r, displaced.residual[r]) < 1.01);
                CHECK(displaced.equations.merit(displaced.residual) < residual);
            }
    }

    TEST_CASE("nothing is moved where the blocks with nearly all of a residual are not few") {
        Displaced all(wall(), {.local_share = 0.02}, 14, {3e-7, 0, 0});
        const PathStep before = all.at;
        const Poses poses = all.poses;
        CHECK_FALSE(settleWorst(all.equations, all.arc, all.residual, all.at, all.poses));
        CHECK(movedRows(before, all.at).empty());
        CHECK(all.poses.position == poses.position);
    }

    TEST_CASE("Newton's method ends at the same equilibrium with and without blocks solved by themselves") {
        for (const double share : {0.0, 0.25}) {
            CAPTURE(share);
            Displaced path(wall(), {.local_share = share}, 14, {3e-7, 0, 0});
            path.arc.drag = 0.1;
            const PathStep rest = solveStep(path.equations, path.arc, path.at);
            REQUIRE(rest);
            for (const Vec6& x : rest.x) CHECK(x.norm() < 1e-8);
        }
    }
}
