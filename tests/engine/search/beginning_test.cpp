#include "search/beginning.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/paths.h"

using namespace talus;
using namespace talus::test;
using namespace talus::search;

namespace {

constexpr double kFriction = 20;  // [deg]

struct Case {
    double tilt_deg = 0, horizontal = 0, water = 0;
};

Model slope(const Case& of) {
    Model model = floorModel(kFriction);
    addBox(model, "box", {0, 0, 0}, {1, 1, 0.5});
    if (of.water > 0) model.waters = {waterOn(model, 1, Vec3::UnitX(), of.water)};
    return model;
}

struct Brought {
    Begun begun;
    double tilt, horizontal, gravity_share, water_share;
    bool is_balanced;
};

Brought brought(const Case& of) {
    const Model model = slope(of);
    equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
    const LoadAxis strength = strengthAxis(model, path.rules());
    Start start{
        .tilt = radians(of.tilt_deg), .horizontal = of.horizontal, .strength = strength, .imbalance = 1e-4};
    start.displacements = {3e-4};
    const Begun begun = bringToStart(path, model, start);
    const Load& load = path.state().load;
    return {begun, load.tilt, load.horizontal, load.gravity_share, load.water_share, path.isBalanced()};
}

}  // namespace

TEST_SUITE("search") {
    TEST_CASE("beginning: weight, water, tilt and push are all there at its end, in equilibrium") {
        for (const Case& of : {Case{}, {10, 0, 0}, {-5, 0, 0}, {10, 0.1, 0}, {10, 0, 0.3}, {5, 0.1, 0.3}}) {
            CAPTURE(of.tilt_deg);
            CAPTURE(of.horizontal);
            CAPTURE(of.water);
            const Brought at = brought(of);
            REQUIRE((at.begun.result == PathResult::reached));
            CHECK(at.tilt == doctest::Approx(radians(of.tilt_deg)));
            CHECK(at.horizontal == doctest::Approx(of.horizontal));
            CHECK(at.gravity_share == 1);
            if (of.water > 0) CHECK(at.water_share == 1);
            CHECK(at.is_balanced);
            CHECK(at.begun.parted <= 0);  // joints give, blocks do not part
        }
    }

    TEST_CASE(
        "beginning: a slope that fails on the way says at which stage, and at which share of its load") {
        const Brought steep = brought({25, 0, 0});
        CHECK((steep.begun.result == PathResult::failed));
        CHECK(std::string(steep.begun.stage) == "tilt");
        CHECK(steep.begun.followed.bracket.stands == doctest::Approx(kFriction / 25).epsilon(1e-3));

        const Brought pushed = brought({10, 0.5, 0});
        CHECK((pushed.begun.result == PathResult::failed));
        CHECK(std::string(pushed.begun.stage) == "horizontal load");
        CHECK(pushed.begun.followed.bracket.stands ==
              doctest::Approx(std::tan(radians(10)) / 0.5).epsilon(1e-3));
    }

    TEST_CASE("beginning: deep water that pushes a block uphill comes after the tilt it needs") {
        // Level, the thrust rho g H^2 / 2 = 1.77 kN/m exceeds the friction, 4.8 kN/m tan(20), by nothing;
        // deeper water does.
        Model model = floorModel(kFriction);
        addBox(model, "box", {0, 0, 0}, {0.5, 1, 0.8}, 1200);
        model.waters = {waterOn(model, 1, -Vec3::UnitX(), 0.75)};  // from below
        const double weight = 1200 * 9.81 * 0.4, thrust = 9810 * 0.75 * 0.75 / 2;
        REQUIRE(thrust > weight * std::tan(radians(kFriction)));
        equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
        const LoadAxis strength = strengthAxis(model, path.rules());
        Start start{.tilt = radians(15), .strength = strength, .imbalance = 1e-4};
        start.displacements = {3e-4};
        CHECK((bringToStart(path, model, start).result == PathResult::reached));
        CHECK(path.state().load.water_share == 1);
        CHECK(path.state().load.tilt == doctest::Approx(radians(15)));
    }

    TEST_CASE("beginning: water that slides a block even at twice its strength comes on with more of it") {
        // Thrust rho g H^2 / 2 = 4.4 kN/m against W tan(20) = 1.4 to 4.1 kN/m: two to eight times the
        // strength hold it.
        for (const double density : {400.0, 700.0, 1200.0}) {
            CAPTURE(density);
            Model model = floorModel(kFriction);
            addBox(model, "box", {0, 0, 0}, {1, 1, 0.95}, density);
            model.waters = {waterOn(model, 1, Vec3::UnitX(), 0.95)};
            const double weight = density * 9.81 * 0.95, thrust = 9810 * 0.95 * 0.95 / 2;
            equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
            const LoadAxis strength = strengthAxis(model, path.rules());
            Start start{.weakens = false, .strength = strength, .imbalance = 1e-4};
            start.displacements = {3e-4};
            const Begun begun = bringToStart(path, model, start);
            REQUIRE((begun.result == PathResult::reached));
            CHECK(begun.factor < weight * std::tan(radians(kFriction)) / thrust);
        }
    }

    TEST_CASE("beginning: a block that nothing holds falls as its weight comes on") {
        Model model = slope({});
        addBox(model, "hangs", {1, 0.3, 0.3}, {0.1, 0.1, 0.1});
        equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
        const LoadAxis strength = strengthAxis(model, path.rules());
        const Begun begun =
            bringToStart(path, model, {.strength = strength, .imbalance = 1e-4, .displacements = {3e-4}});
        CHECK((begun.result == PathResult::failed));
        CHECK(std::string(begun.stage) == "weight");
    }

    TEST_CASE("beginning: a block that slides at twice its strength is not followed until it has fallen") {
        // A site at 45 degrees: 1.0 = tan(45) of the weight against 0.73, 1.46 and 2.91 = 2, 4 and 8 tan(20).
        Model model = slope({});
        model.gravity.direction = Vec3(1, 0, -1).normalized();
        equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
        const LoadAxis strength = strengthAxis(model, path.rules());
        Start start{.weakens = false, .strength = strength, .imbalance = 1e-4};
        start.displacements = {3e-4};
        const Begun begun = bringToStart(path, model, start);
        REQUIRE((begun.result == PathResult::reached));
        CHECK(begun.factor == doctest::Approx(1.0 / 8));
        CHECK(begun.parted <= start.displacements[0]);
        const SearchRules& rules = path.rules();
        CHECK(static_cast<double>(path.work().steps) < 0.5 * rules.fallen / rules.step_displacement);
    }

    TEST_CASE("beginning: where something changes under the weight, equilibrium is found anew") {
        const Model model = slope({10, 0, 0});
        equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
        const LoadAxis strength = strengthAxis(model, path.rules());
        int called = 0;
        Start start{.tilt = radians(10), .strength = strength, .imbalance = 1e-4};
        start.displacements = {3e-4};
        start.weighted = [&](equilibrium::EquilibriumPath& at) {
            CHECK(at.isBalanced());
            CHECK(at.state().load.gravity_share == 1);
            CHECK(at.state().load.tilt == 0);
            return ++called > 0;
        };
        CHECK((bringToStart(path, model, start).result == PathResult::reached));
        CHECK(called == 1);
    }
}
