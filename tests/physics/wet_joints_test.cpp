// Joints that are weaker where water presses in them: a block on a plane that is wet in part, in closed form,
// by every analysis.

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "build/wet_joints.h"
#include "build/wet_tilt.h"
#include "support/models.h"
#include "support/wet_slab.h"
#include "talus/analysis.h"
#include "talus/block_theory.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"
#include "talus/storm.h"
#include "talus/theory.h"

using namespace talus;
using namespace talus::test;

namespace {

State built(const Model& model) {
    auto state = buildState(model, false);
    for (const Error& error : state.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(state.ok());
    return *state;
}

double factorOf(const Model& model) {
    const auto found = safetyFactor(model);
    for (const Error& error : found.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    return found->answer;
}

/// The answer, and the factor of safety at its own tilt, which is 1 by definition.
double angleOf(const Model& model) {
    const auto found = criticalAngle(model);
    for (const Error& error : found.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    Model there = model;
    there.gravity.tilt = found->answer;
    CHECK(factorOf(there) == doctest::Approx(1).epsilon(2e-3));
    const auto limit = limitAnalysis(model, Varied::tilt);
    REQUIRE(limit.ok());
    CHECK(limit->lower == doctest::Approx(found->answer).epsilon(1e-3));
    const auto ceiling = limitCeiling(model, Varied::tilt, true);
    REQUIRE(ceiling.ok());
    CHECK(*ceiling->value == doctest::Approx(limit->upper).epsilon(1e-6));
    return found->answer;
}

/// The tilt at which a slab with water up to an elevation has a factor of safety of 1, by halves.
double tiltOfElevation(WetSlab slab, double elevation, bool stands_in_front) {
    double stands = radians(slab.tilt_deg), fails = radians(60);
    while (fails - stands > 1e-9) {
        const double tilt = 0.5 * (stands + fails);
        slab.tilt_deg = degrees(tilt);
        slab.share = std::min(1.0, elevation / std::sin(tilt));
        (slab.factor(stands_in_front ? slab.inFront() : 0) > 1 ? stands : fails) = tilt;
    }
    return stands;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE(
        "wet joints: the wet share of an area is exact, for water between blocks, a table, and fissures") {
        for (const double share : {0.0, 0.25, 0.4, 0.8, 1.0}) {
            CAPTURE(share);
            WetSlab slab;
            slab.share = share;
            CHECK(wetShares(built(slab.belowTable())).at(0) == doctest::Approx(share).epsilon(1e-9));
            if (share > 0)
                CHECK(wetShares(built(slab.model())).at(0) == doctest::Approx(share).epsilon(1e-9));
        }
        Model stack = stackModel(2, 3, 1, 30);
        stack.joints[0].wet_strength_factor = 0.5;
        stack.waters = {fissureAt(stack, 0.2, 0.15)};
        const State state = built(stack);
        const std::vector<double> shares = wetShares(state);
        double sum = 0;
        for (const double share : shares) sum += share;
        CHECK(sum == doctest::Approx(1.5).epsilon(1e-9));  // one row and a half
    }

    TEST_CASE("wet joints: each analysis has the strength of the wet and the dry part by their areas") {
        for (const double share : {0.25, 0.4, 0.8, 1.0})
            for (const double wet : {0.6, 0.9}) {
                CAPTURE(share);
                CAPTURE(wet);
                WetSlab slab;
                slab.share = share;
                slab.wet_strength = wet;
                for (const bool table : {false, true}) {
                    CAPTURE(table);
                    const Model model = table ? slab.belowTable() : slab.model();
                    const double exact = slab.factor(table ? slab.inFront() : 0);
                    CHECK(factorOf(model) == doctest::Approx(exact).epsilon(2e-3));
                    const auto keys = keyBlocks(model);
                    REQUIRE(keys.ok());
                    CHECK(keys->blocks.at(0).sliding.factor == doctest::Approx(exact).epsilon(1e-6));
                    const auto limit = limitAnalysis(model, Varied::factor);
                    REQUIRE(limit.ok());
                    CHECK(limit->upper == doctest::Approx(exact).epsilon(1e-3));
                }
            }
    }

    TEST_CASE("wet joints: of two faces' joints the weaker one counts, as wet as it is") {
        for (const double share : {0.2, 0.6, 1.0})
            for (const bool first : {false, true}) {
                CAPTURE(share);
                CAPTURE(first);
                WetSlab slab;
                slab.share = share;
                slab.cohesion = 0;
                slab.wet_strength = 0.5;  // 35 deg fall below 30 deg where 35 % are wet
                Model model = slab.model();
                Joint dry = joint(30);
                dry.name = "dry";
                model.joints.push_back(dry);
                model.blocks[first ? 0 : 1].face_joint.assign(6, 1);
                WetSlab weaker = slab;
                if (share < 0.35) weaker.friction_deg = 30, weaker.wet_strength = 1;
                CHECK(factorOf(model) == doctest::Approx(weaker.factor()).epsilon(2e-3));
                const auto keys = keyBlocks(model);
                REQUIRE(keys.ok());
                CHECK(keys->blocks.at(0).sliding.factor == doctest::Approx(weaker.factor()).epsilon(1e-6));
                model.pair_joints = {{0, 1, 1, true, "interface[0]"}};
                WetSlab given = slab;
                given.friction_deg = 30, given.wet_strength = 1;
                CHECK(factorOf(model) == doctest::Approx(given.factor()).epsilon(2e-3));
            }
    }

    TEST_CASE("wet joints: a critical acceleration, and strength that falls with time as well") {
        WetSlab slab;
        slab.cohesion = 0;
        Model model = slab.model();
        const double weight = 0.5 * 2700 * 9.81, mobilised = 1 / slab.factor();
        CHECK(mobilised < 1);
        // At k: W (sin + k cos) = m tan(phi) (W (cos - k sin) - U)
        const double tangent = (1 - slab.share * (1 - slab.wet_strength)) * std::tan(radians(35));
        const double uplift = 0.5 * kWaterWeight * slab.share * slab.level();
        const double k =
            (tangent * (weight * std::cos(slab.beta()) - uplift) - weight * std::sin(slab.beta())) /
            (weight * (std::cos(slab.beta()) + tangent * std::sin(slab.beta())));
        // Level acceleration in the model's frame turns with gravity.
        const auto found = criticalAcceleration(model);
        REQUIRE(found.ok());
        CHECK(found->answer == doctest::Approx(k).epsilon(5e-3));

        model.joints[0].strength_over_time = {{0, 0.9}};
        CHECK(factorOf(model) == doctest::Approx(0.9 * slab.factor()).epsilon(2e-3));
    }

    TEST_CASE("wet joints: dilation beyond the friction of a wet joint is refused, and says which joint") {
        WetSlab slab;
        slab.wet_strength = 0.5;
        Model model = slab.model();
        model.joints[0].dilation = radians(30);
        const auto refused = safetyFactor(model);
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.errors()[0].field == "joint.default.dilation_deg");
        CHECK(refused.errors()[0].message.starts_with(
            "found 30 with a friction angle of 29.2561 where 40 % of the joint is wet: "));
        model.joints[0].dilation = radians(29);
        CHECK(safetyFactor(model).ok());
    }

    TEST_CASE("wet joints: a storm wets and dries them with its level") {
        WetSlab slab;
        Model model = slab.model();
        const double full = std::sin(slab.beta());
        model.waters[0].level = {{0, 0.05 * full}, {100, 0.85 * full}, {200, 0.05 * full}};
        const auto result = storm(model, {.step = 25});
        REQUIRE(result.ok());
        for (const StormPoint& point : result->points) {
            CAPTURE(point.time);
            WetSlab now = slab;
            now.share = point.levels.at(0) / full;
            CHECK(point.factor == doctest::Approx(now.factor()).epsilon(3e-3));
        }
    }

    TEST_CASE("wet joints: joints of their own are made once, and stand before those of the model") {
        const WetSlab slab;
        Model model = slab.model();
        model.pair_joints = {{0, 1, 0, true, "interface[0]"}};
        const Model once = withWetJoints(model, built(model), wetShares(built(model)));
        REQUIRE(once.joints.size() == 2);
        CHECK(once.joints[1].name == "default@0.4wet");
        CHECK(once.joints[1].cohesion == doctest::Approx(slab.cohesion * 0.84).epsilon(1e-12));
        CHECK(std::tan(once.joints[1].friction) ==
              doctest::Approx(0.84 * std::tan(radians(35))).epsilon(1e-12));
        CHECK(built(once).interfaces.joint.at(0) == 1);
        const Model twice = withWetJoints(once, built(once), wetShares(built(once)));
        CHECK(twice.joints.size() == 2);
        CHECK(twice.pair_joints.size() == once.pair_joints.size());
    }

    TEST_CASE(
        "wet joints: a model without water, or with a factor of 1, has the answer of before to the bit") {
        WetSlab slab;
        Model plain = slab.dry(), given = slab.dry();
        plain.joints[0].wet_strength_factor = 1;
        CHECK(factorOf(given) == factorOf(plain));
        slab.wet_strength = 1;
        const Model wet = slab.model();
        CHECK(run(wet, {}, RunOutput{}).ok());
    }

    TEST_CASE("wet joints: a critical angle, where the wet share is the same at each tilt") {
        for (const double share : {0.25, 0.6, 1.0})
            for (const double density : {1e-3, 1000.0}) {  // without uplift, and with it
                CAPTURE(share);
                CAPTURE(density);
                WetSlab slab;
                slab.cohesion = 0;
                slab.share = share;
                Model model = slab.byDepth();
                model.waters[0].density = density;
                model.analysis.start = radians(5);
                // W sin = m tan(phi) (W cos - U), U = rho g s^2 sin / 2
                const double m = slab.strength() * std::tan(radians(35));
                const double uplift = 0.5 * density * share * share / (0.5 * 2700);
                CHECK(std::tan(angleOf(model)) == doctest::Approx(m / (1 + m * uplift)).epsilon(2e-3));
            }
    }

    TEST_CASE("wet joints: a critical angle, where the wet share falls as the slope is tilted") {
        for (const double elevation : {0.05, 0.1, 0.2})
            for (const bool table : {false, true}) {
                CAPTURE(elevation);
                CAPTURE(table);
                WetSlab slab;
                slab.cohesion = 500;
                slab.friction_deg = 25;  // flat enough for all of the base to stay closed
                slab.tilt_deg = 15;
                slab.share = elevation / std::sin(slab.beta());
                Model model = slab.model();
                if (table) {
                    // Level at the critical tilt: a line that is level in the model leans with the slope.
                    WetSlab there = slab;
                    const double tilt = tiltOfElevation(slab, elevation, true);
                    there.tilt_deg = degrees(tilt);
                    there.share = elevation / std::sin(tilt);
                    model = there.belowTable();
                    model.gravity.tilt = slab.beta();
                }
                const double exact = tiltOfElevation(slab, elevation, table);
                CHECK(angleOf(model) == doctest::Approx(exact).epsilon(2e-3));
            }
    }

    TEST_CASE("wet joints: a slope that stands at every tilt, or at none, is as wet as there") {
        WetSlab slab;
        slab.cohesion = 0;
        Model model = slab.model();
        model.analysis.stop = radians(22);
        CHECK((criticalAngle(model)->status == SearchStatus::stable_to_stop));
        CHECK((limitAnalysis(model, Varied::tilt)->status == SearchStatus::stable_to_stop));
        model.analysis.stop = radians(60);
        model.analysis.start = radians(34.9);  // of 35 deg when it is dry
        CHECK((criticalAngle(model)->status == SearchStatus::unstable_at_start));
        CHECK((limitAnalysis(model, Varied::tilt)->status == SearchStatus::unstable_at_start));
    }

    TEST_CASE("wet joints: where what is wet changes abruptly with the tilt, a warning tells both tilts") {
        const WetSlab slab;
        const Model model = slab.model();
        auto wet = WetTilt::begin(model, false, {});
        REQUIRE(wet.ok());
        CHECK(wet->tilt() == slab.beta());
        CHECK_FALSE(hasWetJoints(wet->model()));
        const double jump = radians(30);
        int rounds = 1;
        while (wet->goesOn(wet->tilt() < jump ? radians(40) : radians(25))) ++rounds;
        CHECK(rounds <= 20);
        CHECK(wet->tilt() == doctest::Approx(jump).epsilon(1e-4));
        CHECK(wet->doubt().starts_with(
            "what is wet changes abruptly at 30 deg: the slope is stable below and fails above."));
        CHECK(wet->stands() < jump);
        CHECK(wet->fails() >= jump);
    }

    TEST_CASE("wet joints: a slope that fails between two tilts at which less is wet fails there") {
        // A block on two feet. At -15 deg the right one is wet, at 9 deg the left one, between both are.
        const auto scenario = formats::parseScenario(R"(
[analysis]
start_deg = -15.0
[gravity]
tilt_deg = -15.0
[seismic]
horizontal = 0.2
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e10
friction_deg = 25.0
wet_strength_factor = 0.6
[[block]]
name = "floor"
box = { min = [-4, -2, -1], max = [4, 3, 0] }
fixed = true
[[block]]
name = "slab"
parts = [
    { box = { min = [-1, 0, 0], max = [-0.9, 1, 0.1] } },
    { box = { min = [0.9, 0, 0], max = [1, 1, 0.1] } },
    { box = { min = [-1, 0, 0.1], max = [1, 1, 0.3] } },
]
[[water]]
between = ["floor", "slab"]
elevation = 0.1
density = 1.0
)",
                                                     "feet.toml");
        REQUIRE(scenario.ok());
        const auto found = criticalAngle(scenario->model);
        REQUIRE(found.ok());
        REQUIRE((found->status == SearchStatus::found));
        CHECK(degrees(found->answer) < 5);
        for (const double beside : {-0.1, 0.1}) {
            Model there = scenario->model;
            there.gravity.tilt = found->answer + radians(beside);
            there.analysis.start.reset();
            CHECK((factorOf(there) > 1) == (beside < 0));
        }
    }

    TEST_CASE("wet joints: a slope that fails where its base becomes wet at once has that critical angle") {
        // Water level with the edge about which the model turns wets the base as soon as it leans that way.
        for (const double wet_strength : {0.6, 0.5}) {
            CAPTURE(wet_strength);
            Model model = floorModel(25, 1e10);
            addBox(model, "slab", {-1, 0, 0}, {1, 1, 0.5});
            model.joints[0].wet_strength_factor = wet_strength;
            model.seismic.horizontal = 0.37;
            model.gravity.tilt = radians(-10);
            model.analysis.start = radians(-10);
            Water water;
            water.kind = Water::Level::elevation;
            water.level = {{0, 0.0}};
            water.pair = std::pair(0, 1);
            water.field = "water[0]";
            model.waters = {water};
            const auto found = criticalAngle(model);
            REQUIRE(found.ok());
            REQUIRE((found->status == SearchStatus::found));
            for (const double beside : {-0.1, 0.1}) {
                Model there = model;
                there.gravity.tilt = found->answer + radians(beside);
                there.analysis.start.reset();
                const auto factor = safetyFactor(there);
                REQUIRE(factor.ok());
                CHECK((factor->answer > 1) == (beside < 0));
            }
            CHECK(found->answer_interval->first <= found->answer);
            CHECK(found->answer_interval->second >= found->answer);
            const auto limit = limitAnalysis(model, Varied::tilt);
            REQUIRE(limit.ok());
            CHECK(std::abs(limit->lower - found->answer) < radians(0.01));
        }
    }
}
