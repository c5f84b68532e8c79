#include "equilibrium/equilibrium_path.h"

#include <doctest/doctest.h>

#include <cmath>

#include "forces/contact_forces.h"
#include "measure/measure.h"
#include "support/paths.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

Model boxOnFloor(double friction_deg, const Vec3& size, double stiffness = 1e10) {
    Model model = floorModel(friction_deg, stiffness);
    addBox(model, "box", {0, 0, 0}, size);
    return model;
}

/// Steps along until neighbours have parted that far. \return the highest load
double climb(EquilibriumPath& path, double parted) {
    const Parting since = path.parting();
    double highest = path.load();
    for (int k = 0; k < 2'000 && path.partedSince(since) < parted; ++k) {
        PathStep step = path.along({.unknown = Unknown::load, .displacement = 1e-3, .load = 0.02});
        if (!step) break;  // beyond the peak
        path.commit(std::move(step));
        if (!path.isBalanced()) {  // contacts were found anew
            PathStep rest = path.toRest();
            if (!rest || path.partedBy(rest) > parted) break;
            path.commit(std::move(rest));
        }
        CHECK(path.isBalanced());
        highest = std::max(highest, path.load());
    }
    return highest;
}

/// Normal force on a block's lower face [N].
double forceUnder(const State& state, std::size_t block) {
    double sum = 0;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        const std::pair pair = std::minmax(state.interfaces.block_a[i], state.interfaces.block_b[i]);
        if (static_cast<std::size_t>(pair.second) != block) continue;
        for (const ContactPoint& point : contactPoints(state, i)) sum += point.force.normal;
    }
    return sum;
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("along the path a block on a plane climbs to its friction angle and slides there") {
        for (const double friction : {10.0, 20.0, 35.0}) {
            CAPTURE(friction);
            LoadedPath loaded(boxOnFloor(friction, {1, 1, 0.3}));
            const double highest = climb(loaded.path, 5e-3);
            CHECK(degrees(highest) == doctest::Approx(friction).epsilon(1e-4));
            CHECK(degrees(loaded.path.load()) == doctest::Approx(friction).epsilon(1e-4));
            CHECK(loaded.path.outOfBalance() < 1e-5);
        }
    }

    TEST_CASE("along the path a slender block climbs to atan(b / h) and overturns there") {
        for (const double width : {0.2, 0.3, 0.5}) {
            CAPTURE(width);
            LoadedPath loaded(boxOnFloor(50, {width, 1, 1}, 1e12));
            const double highest = climb(loaded.path, 2e-3);
            CHECK(degrees(highest) == doctest::Approx(degrees(std::atan(width))).epsilon(1e-3));
        }
    }

    TEST_CASE("a path whose work is limited ends as if interrupted, within one step in Newton's method") {
        constexpr std::int64_t kMost = 7;
        LoadedPath loaded(boxOnFloor(35, {1, 1, 0.3}));
        EquilibriumPath& path = loaded.path;
        const std::int64_t before = path.work().factors;
        path.limitWork(before + kMost);
        CHECK_FALSE(path.stopped());
        climb(path, 5e-3);
        CHECK(path.stopped());
        CHECK(path.work().factors > before + kMost);
        CHECK(path.work().factors <= before + kMost + 1);
        CHECK_FALSE(path.toRest());
    }

    TEST_CASE("joints give under the weight by rho g h / k") {
        for (const double height : {0.1, 0.4}) {
            const LoadedPath loaded(boxOnFloor(30, {1, 1, height}, 1e9));
            CHECK(loaded.path.elasticDisplacement() ==
                  doctest::Approx(2700 * 9.81 * height / 1e9).epsilon(1e-4));
        }
    }

    TEST_CASE("after a return to an earlier state the path is the same, to the bit") {
        LoadedPath loaded(stackModel(2, 3, 1, 30, {0.2, 0.1, 0.1}, 1e10));
        EquilibriumPath& path = loaded.path;
        const auto goOn = [&] {
            for (int k = 0; k < 5; ++k) {
                PathStep step = path.along({.unknown = Unknown::load, .displacement = 1e-3, .load = 0.02});
                REQUIRE(step);
                path.commit(std::move(step));
            }
            return std::pair(path.load(), stateHash(path.state()));
        };
        goOn();
        const auto place = path.place();
        const std::uint64_t hash = stateHash(path.state());
        const auto first = goOn();
        path.goBack(place);
        CHECK(stateHash(path.state()) == hash);
        CHECK(goOn() == first);
    }

    TEST_CASE("the same bits with and without threads") {
        const Model model = stackModel(3, 5, 1, 30);
        const search::LoadAxis weight = search::weightAxis(1e-4);
        std::uint64_t hashes[2];
        for (const bool parallel : {false, true}) {
            EquilibriumPath path(unloaded(model), {}, parallel, nullptr);
            path.vary(weight.loading, 0);
            REQUIRE((release(path, 1, path.parting(), 0.1) == Released::rests));
            hashes[parallel ? 1 : 0] = stateHash(path.state());
        }
        CHECK(hashes[0] == hashes[1]);
    }

    TEST_CASE("a block that is taken out weighs on nothing, and stays where it was") {
        Model model = floorModel(30, 1e10);
        addBox(model, "lower", {0, 0, 0}, {1, 1, 0.3});
        addBox(model, "upper", {0, 0, 0.3}, {1, 1, 0.3});
        LoadedPath loaded(model);
        EquilibriumPath& path = loaded.path;
        const double weight = 2700 * 9.81 * 0.3;
        CHECK(forceUnder(path.state(), 1) == doctest::Approx(2 * weight).epsilon(1e-5));
        const Vec3 before = path.state().blocks.position.get(2);
        path.takeOut({2});
        REQUIRE((release(path, path.load(), path.parting(), 1e-2) == Released::rests));
        CHECK(forceUnder(path.state(), 1) == doctest::Approx(weight).epsilon(1e-5));
        CHECK(path.state().blocks.position.get(2) == before);
    }

    TEST_CASE("an exact state has the gaps that its poses make") {
        LoadedPath loaded(boxOnFloor(50, {0.2, 1, 1}, 1e9));
        climb(loaded.path, 1e-3);
        State exact = loaded.path.exactState();
        FirstOrderGaps gaps(exact);
        gaps.set(exact, exact.blocks.position, exact.blocks.orientation);
        gaps.remove(exact);
        CHECK(stateHash(exact) == stateHash(loaded.path.exactState()));
    }
}
