#include "search/unloaded_joints.h"

#include <doctest/doctest.h>

#include <cmath>

#include "search/path_follower.h"
#include "state/incidence.h"
#include "support/paths.h"

using namespace talus;
using namespace talus::test;
using namespace talus::search;

namespace {

/// The tilt at which the assembly fails [deg], with or without friction on joints that carry nothing at
/// first.
double fails(const Model& model, bool with_friction) {
    LoadedPath loaded(model);
    const UnloadedJoints unloaded(loaded.path.state(), 0.01);
    if (!with_friction) loaded.path.mark([&](State& state) { unloaded.release(state); });
    const Followed followed =
        followPath(loaded.path, loaded.axis, {.target = radians(60), .displacements = {3e-4}});
    REQUIRE((followed.result == PathResult::failed));
    return degrees(0.5 * (followed.bracket.stands + followed.bracket.fails));
}

/// Columns of one piece side by side.
Model columns(const std::vector<double>& heights, double friction_deg) {
    Model model = floorModel(friction_deg, 1e12);
    for (std::size_t k = 0; k < heights.size(); ++k)
        addBox(model, "k" + std::to_string(k), {0.2 * static_cast<double>(k), 0, 0}, {0.2, 0.5, heights[k]});
    return model;
}

}  // namespace

TEST_SUITE("search") {
    TEST_CASE("joints between columns side by side carry nothing under the weight, their bases do") {
        for (const int count : {1, 2, 5}) {
            const LoadedPath loaded(stackModel(count, 3, 1, 30));
            const UnloadedJoints unloaded(loaded.path.state(), 0.01);
            CHECK(unloaded.size() == static_cast<std::size_t>(3 * (count - 1)));
            CHECK(unloaded.empty() == (count == 1));
            CHECK(unloaded.shearCarried(loaded.path.state()) < 1e-4);
        }
    }

    TEST_CASE("joints that hold without load are not taken for unloaded ones") {
        Model model = stackModel(2, 3, 1, 30);
        model.joints[0].cohesion = 1e4;
        const LoadedPath loaded(model);
        CHECK(UnloadedJoints(loaded.path.state(), 0.01).empty());
    }

    TEST_CASE("released, unloaded joints have no friction, and the others have theirs") {
        LoadedPath loaded(stackModel(2, 2, 1, 30));
        State state = loaded.path.state();
        const UnloadedJoints unloaded(state, 0.01);
        REQUIRE(unloaded.size() == 2);
        unloaded.release(state);
        unloaded.release(state);  // again changes nothing
        REQUIRE(state.laws.size() == 2);
        std::size_t without = 0;
        for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
            if (isIdle(state.interfaces, i)) continue;
            const double friction =
                state.laws[static_cast<std::size_t>(state.interfaces.joint[i])].tan_friction;
            const bool has_none = friction < 0.01;
            without += has_none ? 1 : 0;
            if (!has_none) CHECK(friction == doctest::Approx(std::tan(radians(30))));
        }
        CHECK(without == 2);
        const LoadAxis weakened = unloaded.with(strengthAxis(loaded.model, loaded.rules));
        weakened.loading.apply(state, 2);
        REQUIRE(state.laws.size() == 2);
        CHECK(state.laws[0].tan_friction == doctest::Approx(std::tan(radians(30)) / 2));
        CHECK(state.laws[1].tan_friction < 0.01);
    }

    // A low column in front of a tall one holds it by friction that locks on their joint as the tall one
    // leans. Without it the tall one pushes with its own moment, and no less than alone: the low one may
    // slide.
    TEST_CASE(
        "friction locked on unloaded joints released: columns fail no later, and no sooner than statics") {
        for (const double low : {0.2, 0.3, 0.4})
            for (const double friction : {30.0, 40.0, 50.0}) {
                CAPTURE(low);
                CAPTURE(friction);
                const Model model = columns({0.6, low, 0.6}, friction);
                const double with = fails(model, true), without = fails(model, false);
                MESSAGE("low column of " << low << ", friction " << friction << ": " << with
                                         << " with friction there, " << without << " without");
                CHECK(without <= with + 0.01);
                // The first column leans on nothing.
                CHECK(without <= degrees(std::atan(0.2 / 0.6)) + 0.02);
            }
    }

    TEST_CASE("released, equal columns topple where one of them does, however rough they are") {
        for (const int count : {2, 3, 5})
            for (const double friction : {30.0, 45.0, 60.0}) {
                CAPTURE(count);
                CAPTURE(friction);
                const Model model =
                    columns(std::vector<double>(static_cast<std::size_t>(count), 0.6), friction);
                CHECK(fails(model, false) == doctest::Approx(degrees(std::atan(0.2 / 0.6))).epsilon(2e-3));
            }
    }
}
