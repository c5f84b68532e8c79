// Laws of strength other than Coulomb's: a block on a plane in closed form, by search, by a release and by
// explicit steps; Coulomb's law written as a table.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "build/build.h"
#include "equilibrium/release.h"
#include "support/models.h"
#include "support/paths.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

const double kStress = 26000 * std::cos(radians(35));  // of the scenarios [Pa]

Model planeModel(const std::string& law) {
    const auto scenario =
        formats::readScenario(TALUS_SOURCE_DIR "/bench/verification/plane-" + law + ".toml");
    REQUIRE(scenario.ok());
    return scenario->model;
}

/// What the scenarios state.
double factorOf(const std::string& law) {
    const double strength = law == "power" ? 1.2 * std::pow(kStress, 0.95)
                            : law == "barton-bandis"
                                ? kStress * std::tan(radians(28 + 10 * std::log10(5e7 / kStress)))
                                : 12000 + 0.56 * (kStress - 10000);
    return strength / (kStress * std::tan(radians(35)));
}

Model tableOfCoulomb(Model model) {
    for (Joint& joint : model.joints) {
        joint.law = StrengthLaw::envelope;
        joint.shear_strength.clear();
        for (const double stress : {0.0, 3e3, 1e6})
            joint.shear_strength.push_back({stress, stress * std::tan(joint.friction)});
    }
    return model;
}

/// How far the block of a plane goes in half a second [m].
double wayOf(const Model& model) {
    Model history = model;
    history.run.duration = 0.5;
    history.damping.contact = 1e-5;
    history.run.watch = {"block"};
    const auto result = run(history, {}, {});
    REQUIRE(result.ok());
    return result->watch.at(0).displacement.norm();
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a block on a plane: the factor of safety of each law is its formula's within 0.5 %") {
        for (const std::string law : {"barton-bandis", "power", "envelope"}) {
            const auto result = safetyFactor(planeModel(law));
            REQUIRE(result.ok());
            MESSAGE(law << ": " << result->answer << ", by the formula " << factorOf(law));
            CHECK((result->status == SearchStatus::found));
            CHECK((result->mode == FailureMode::sliding));
            CHECK(result->answer == doctest::Approx(factorOf(law)).epsilon(0.005));
        }
    }

    TEST_CASE("implicit and explicit agree: at rest just below the strength, sliding just beyond it") {
        for (const std::string law : {"barton-bandis", "power", "envelope"}) {
            for (const double share : {0.99, 1.01}) {
                Model model = planeModel(law);
                for (Joint& joint : model.joints) joint = reduced(joint, share * factorOf(law));
                const search::LoadAxis weight = search::weightAxis(1e-4);
                equilibrium::EquilibriumPath path(unloaded(model), {}, false, nullptr);
                path.vary(weight.loading, 0);
                const equilibrium::Released released = equilibrium::release(path, 1, path.parting(), 1e-2);
                const double way = wayOf(model);
                CAPTURE(law);
                CAPTURE(share);
                CAPTURE(way);
                CHECK((released == (share < 1 ? equilibrium::Released::rests : equilibrium::Released::left)));
                CHECK((way > 1e-3) == (share > 1));
            }
        }
    }

    TEST_CASE(
        "a curve with a residual: what has slipped slides with that share of its strength, what has not "
        "holds all of it") {
        for (const std::string law : {"barton-bandis", "power", "envelope"})
            for (const double residual : {0.9, 0.5, 0.0}) {
                CAPTURE(law);
                CAPTURE(residual);
                Model model = planeModel(law);
                for (Joint& joint : model.joints) {
                    joint = reduced(
                        joint,
                        0.6 * factorOf(law));  // stress under the block is uneven, and what is lost spreads
                    joint.residual_factor = residual;
                }
                CHECK(wayOf(model) < 1e-3);
                for (Joint& joint : model.joints) joint = reduced(joint, 1.02 / 0.6);
                // g sin(dip) less what is left of the strength
                const double acceleration = 9.81 * std::sin(radians(35)) * (1 - residual / 1.02);
                CHECK(wayOf(model) == doctest::Approx(0.5 * acceleration * 0.25).epsilon(0.05));
            }
    }

    TEST_CASE("Coulomb's law as a table gives Coulomb's answers") {
        const Model model = stackModel(3, 3, 1, 22);
        const auto coulomb = criticalAngle(model), table = criticalAngle(tableOfCoulomb(model));
        REQUIRE(coulomb.ok());
        REQUIRE(table.ok());
        CHECK(table->answer == doctest::Approx(coulomb->answer).epsilon(1e-6));
        CHECK((table->mode == coulomb->mode));
        CHECK(table->moving_blocks == coulomb->moving_blocks);
    }

    TEST_CASE("joints that the load only compresses keep their bonds on the way to equilibrium") {
        // The whole stack turns about its toe. Bonds that broke as it came to rest let it slide at 19.5
        // degrees.
        Model model = stackModel(4, 6, 1, 19.5, {0.25, 0.1, 0.1});
        for (Joint& joint : model.joints) joint.cohesion = 1e9;
        const auto topples = criticalAngle(model);
        REQUIRE(topples.ok());
        CHECK(topples->answer == doctest::Approx(std::atan(0.25 / 0.6)).epsilon(1e-3));
        CHECK((topples->mode == FailureMode::toppling));
    }

    TEST_CASE("limit analysis says that it is for straight envelopes") {
        const Model model = planeModel("power");
        const auto ceiling = limitCeiling(model, Varied::factor, false);
        REQUIRE(ceiling.ok());
        CHECK_FALSE(ceiling->value.has_value());
        CHECK(ceiling->reason.find("law \"power\"") != std::string::npos);
        const auto limit = limitAnalysis(model, Varied::factor);
        REQUIRE_FALSE(limit.ok());
        CHECK(limit.errors()[0].message.find("straight envelopes") != std::string::npos);
    }
}
