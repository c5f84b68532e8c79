// Joints that are weaker where water presses in them: a block on a plane that is wet in part, in closed form,
// by every analysis that counts it; the others refuse it.

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "build/wet_joints.h"
#include "support/models.h"
#include "talus/analysis.h"
#include "talus/block_theory.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"
#include "talus/storm.h"
#include "talus/theory.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kUnitWeight = 1000 * 9.81;  // of water [N/m^3]

/// A block of 1 x 1 x 0.5 m on a plane whose lower part is wet.
struct WetSlab {
    double tilt_deg = 20, friction_deg = 35, cohesion = 4e3, wet_strength = 0.6;
    double share = 0.4;  ///< of the base that is wet

    double beta() const { return radians(tilt_deg); }
    double level() const { return share * std::sin(beta()); }  ///< along gravity above the lower edge [m]

    Model dry() const {
        Model made = floorModel(friction_deg);
        made.joints[0].cohesion = made.joints[0].residual_cohesion = cohesion;
        made.joints[0].wet_strength_factor = wet_strength;
        addBox(made, "block", {0, 0, 0}, {1, 1, 0.5});
        made.gravity.tilt = beta();
        return made;
    }
    /// Water between block and plane.
    Model model() const {
        Model made = dry();
        Water water;
        water.kind = Water::Level::elevation;
        water.level = {{0, level()}};
        water.pair = {{0, 1}};
        water.field = "water[0]";
        made.waters = {water};
        return made;
    }
    /// A level water table, which also stands in front of the block.
    Model belowTable() const {
        Model made = dry();
        PhreaticSurface table;
        for (const double x : {-4.0, 19.0})
            table.line.push_back({x, (level() - x * std::sin(beta())) / std::cos(beta())});
        table.field = "water[0]";
        made.phreatic = table;
        return made;
    }
    double factor(double in_front = 0) const {
        const double weight = 0.5 * 2700 * 9.81, uplift = 0.5 * kUnitWeight * share * level();
        const double strength = 1 - share * (1 - wet_strength);
        return strength *
               (cohesion + (weight * std::cos(beta()) - uplift) * std::tan(radians(friction_deg))) /
               (weight * std::sin(beta()) - in_front);
    }
    double inFront() const { return 0.5 * kUnitWeight * level() * level() / std::cos(beta()); }
};

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

template <class Answer>
void checkRefused(const Answer& answer, const char* by) {
    REQUIRE_FALSE(answer.ok());
    CHECK(answer.errors()[0].field == "joint.default.wet_strength_factor");
    CHECK(answer.errors()[0].message.find(std::string("in a model with water, which ") + by) !=
          std::string::npos);
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
        const double uplift = 0.5 * kUnitWeight * slab.share * slab.level();
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
        const Model once = withWetJoints(model, built(model));
        REQUIRE(once.joints.size() == 2);
        CHECK(once.joints[1].name == "default@0.4wet");
        CHECK(once.joints[1].cohesion == doctest::Approx(slab.cohesion * 0.84).epsilon(1e-12));
        CHECK(std::tan(once.joints[1].friction) ==
              doctest::Approx(0.84 * std::tan(radians(35))).epsilon(1e-12));
        CHECK(built(once).interfaces.joint.at(0) == 1);
        const Model twice = withWetJoints(once, built(once));
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

    TEST_CASE("wet joints: analyses that move the water, or whose frames hold the joints, refuse them") {
        const Model model = WetSlab{}.model();
        checkRefused(criticalAngle(model), "a search over the tilt");
        checkRefused(limitAnalysis(model, Varied::tilt), "limit analysis over the tilt");
        checkRefused(limitCeiling(model, Varied::tilt, true), "limit analysis over the tilt");
        checkRefused(run(model, {}, RunOutput{}), "a time history");
        Control keeps;
        keeps.keep_failing_state = true;
        checkRefused(safetyFactor(model, keeps), "the history of a failure");
        CHECK_FALSE(theory::predict(model));
    }
}
