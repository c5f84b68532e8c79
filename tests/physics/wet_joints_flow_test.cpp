// Joints that are weaker where the flow in them presses: a block on a plane with a head at either end of its base,
// in closed form.

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "build/build.h"
#include "build/wet_joints.h"
#include "forces/flow_water.h"
#include "support/flows.h"
#include "support/snapshots.h"
#include "support/wet_slab.h"
#include "talus/analysis.h"
#include "talus/block_theory.h"
#include "talus/limit_analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A slab whose base carries flow from the higher of two heads to the other. The pressure falls in a straight
/// line from the head at the lower edge to nothing at the slab's share of its base.
struct FlowSlab {
    WetSlab slab{};
    double rise = 0;  ///< of the head from the lower edge to the upper one [m]

    double atToe() const { return slab.share * (std::sin(slab.beta()) - rise); }
    Model model(bool coupled = false) const {
        Model made = slab.dry();
        made.flow = flowAlongX(1e-4, atToe(), atToe() + rise);
        made.flow->refinements = 3;
        made.flow->coupled = coupled;
        return made;
    }
    double uplift() const { return 0.5 * kWaterWeight * slab.share * atToe(); }
    double factor() const {
        const double weight = 0.5 * 2700 * 9.81;
        return slab.strength() *
               (slab.cohesion +
                (weight * std::cos(slab.beta()) - uplift()) * std::tan(radians(slab.friction_deg))) /
               (weight * std::sin(slab.beta()));
    }
};

State built(const Model& model) {
    auto state = buildState(model, false);
    for (const Error& error : state.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(state.ok());
    return *state;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("wet joints: the wet share of a triangle, against the areas of many small ones") {
        constexpr int kParts = 400;
        for (const auto& p :
             {std::array{1.0, 2.0, 3.0}, std::array{-1.0, 2.0, 3.0}, std::array{-1.0, -2.0, 3.0},
              std::array{-1.0, -2.0, -3.0}, std::array{2.0, -1.0, 0.0}, std::array{0.0, 0.0, 1.0},
              std::array{0.0, 0.0, 0.0}}) {
            double wet = 0, all = 0;
            for (int i = 0; i < kParts; ++i)
                for (int j = 0; i + j < kParts; ++j) {
                    const double a = (i + 1 / 3.0) / kParts, b = (j + 1 / 3.0) / kParts;
                    all += 1;
                    wet += p[0] + a * (p[1] - p[0]) + b * (p[2] - p[0]) > 0 ? 1 : 0;
                }
            CHECK(flow_water::wetShare(p) == doctest::Approx(wet / all).epsilon(5e-3));
        }
    }

    TEST_CASE("wet joints: what a flow wets is exact, and each analysis has its strength") {
        for (const double share : {0.25, 0.6, 1.0})
            for (const double rise : {0.0, 0.15}) {
                CAPTURE(share);
                CAPTURE(rise);
                const FlowSlab flow{{.share = share}, rise};
                const Model model = flow.model();
                CHECK(wetShares(built(model)).at(0) == doctest::Approx(share).epsilon(1e-6));
                const auto found = safetyFactor(model);
                for (const Error& error : found.errors()) FAIL_CHECK(error.field << ": " << error.message);
                REQUIRE(found.ok());
                CHECK(found->answer == doctest::Approx(flow.factor()).epsilon(2e-3));
                const auto keys = keyBlocks(model);
                REQUIRE(keys.ok());
                CHECK(keys->blocks.at(0).sliding.factor == doctest::Approx(flow.factor()).epsilon(1e-6));
                const auto limit = limitAnalysis(model, Varied::factor);
                REQUIRE(limit.ok());
                CHECK(limit->upper == doctest::Approx(flow.factor()).epsilon(1e-3));
            }
    }

    TEST_CASE("wet joints: a critical angle keeps the flow of the scenario's tilt, and what that wets") {
        FlowSlab flow{{.tilt_deg = 15, .friction_deg = 25, .cohesion = 0}};
        const auto found = criticalAngle(flow.model());
        REQUIRE(found.ok());
        // W sin = m tan(phi) (W cos - U), with the U of the scenario
        const double m = flow.slab.strength() * std::tan(radians(25)),
                     u = flow.uplift() / (0.5 * 2700 * 9.81);
        const double at = found->answer;
        CHECK(std::sin(at) == doctest::Approx(m * (std::cos(at) - u)).epsilon(2e-3));
    }

    TEST_CASE("wet joints: a history under flow slides with the weaker joint, and goes on to the same bits") {
        FlowSlab flow{{.tilt_deg = 30, .friction_deg = 33, .cohesion = 0}};
        Model model = flow.model();
        model.run.duration = 0.05;
        model.run.frame_interval = 0.005;
        const Recorded whole = record(model, 4);
        for (const Error& error : whole.result.errors()) FAIL_CHECK(error.field << ": " << error.message);
        REQUIRE(whole.result.ok());
        const double beta = flow.slab.beta(), tangent = flow.slab.strength() * std::tan(radians(33));
        const double a = 9.81 * (std::sin(beta) - tangent * std::cos(beta)) + tangent * flow.uplift() / 1350;
        CHECK(-whole.lights.back().velocity.x[1] ==
              doctest::Approx(a * whole.lights.back().time).epsilon(5e-3));
        CHECK(record(model, 4, &whole.fulls.at(1)).result->state_hash == whole.result->state_hash);
    }

    TEST_CASE("wet joints: made joints have the apertures and boundaries of the joints they are made of") {
        const FlowSlab flow{{}, 0.15};
        Model model = flow.model();
        model.flow->joint_apertures = {{0, 3e-4}};
        for (FlowBoundary& boundary : model.flow->boundaries) boundary.joints = {0};
        const State dry = built(model);
        const Model wet = withWetJoints(model, dry, wetShares(dry));
        REQUIRE(wet.joints.size() == 2);
        const State again = built(wet);
        CHECK(again.interfaces.joint.at(0) == 1);
        CHECK(flow_water::wetAreas(again) == flow_water::wetAreas(dry));
        CHECK(wet.flow->joint_apertures.back() == std::pair<std::int32_t, double>{1, 3e-4});
        CHECK(wet.flow->boundaries[1].joints == std::vector<std::int32_t>{0, 1});
    }

    TEST_CASE("wet joints: coupled flow is refused, because what is wet changes as joints open") {
        const auto refused = safetyFactor(FlowSlab{}.model(true));
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.errors()[0].field == "joint.default.wet_strength_factor");
        CHECK(refused.errors()[0].message ==
              "found 0.6 in a model with coupled flow, whose wet areas change as joints open; allowed: 1, or "
              "flow.coupled = false");
        CHECK(criticalAngle(FlowSlab{}.model(true)).errors()[0].field == refused.errors()[0].field);
        CHECK(run(FlowSlab{}.model(true), {}, RunOutput{}).errors()[0].field == refused.errors()[0].field);
    }
}
