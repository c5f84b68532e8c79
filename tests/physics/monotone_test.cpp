// More friction never gives less safety, and what the joints' stiffness is does not matter as long as they are stiff.

#include <doctest/doctest.h>

#include <string>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

Model read(const std::string& name) {
    auto scenario = formats::readScenario(TALUS_SOURCE_DIR "/bench/verification/" + name + ".toml");
    REQUIRE(scenario.ok());
    return std::move(scenario->model);
}

double factorOf(Model model, double friction_deg, double normal, double shear) {
    for (Joint& joint : model.joints) {
        if (friction_deg > 0) joint.friction = joint.residual_friction = radians(friction_deg);
        joint.normal_stiffness = normal;
        joint.shear_stiffness = shear;
    }
    const SearchResult result = *safetyFactor(model);
    CHECK((result.status == SearchStatus::found));
    CHECK(result.confirmed);
    return result.answer;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("Goodman and Bray's slope: its factor grows with friction and does not change with stiffness") {
        const Model model = read("goodman-bray-slice-38.15");
        double before = 0;
        for (const double friction : {38.15, 38.3, 38.5, 38.66, 38.7}) {
            CAPTURE(friction);
            const double factor = factorOf(model, friction, 1e11, 1e10);
            CHECK(factor >= before);
            before = factor;
            double soft = 0, stiff = 0;
            soft = factorOf(model, friction, 1e10, 1e9);
            stiff = factorOf(model, friction, 1e12, 1e11);
            MESSAGE("friction " << friction << ": " << soft << ", " << factor << ", " << stiff
                                << " on joints of 1e10, 1e11, 1e12 Pa/m");
            CHECK(soft == doctest::Approx(factor).epsilon(0.005));
            CHECK(stiff == doctest::Approx(factor).epsilon(0.005));
        }
    }

    TEST_CASE("Goodman and Bray's slope with its base in steps: its factor grows with friction") {
        Model model = read("goodman-bray");
        const double normal = model.joints[0].normal_stiffness, shear = model.joints[0].shear_stiffness;
        double before = 0;
        for (const double friction : {38.15, 38.3, 38.5, 38.66, 38.7}) {
            const double factor = factorOf(model, friction, normal, shear);
            CAPTURE(friction);
            CHECK(factor >= before);
            before = factor;
        }
    }

    TEST_CASE("Alejano and Alonso's columns: what the ratio of the two stiffnesses is worth") {
        const Model model = read("alejano-alonso");
        for (const double ratio : {0.03, 0.1, 0.3, 1.0}) {
            const double factor = factorOf(model, 0, 1e12, ratio * 1e12);
            MESSAGE("shear stiffness " << ratio << " of the normal one: " << factor);
            CHECK(factor == doctest::Approx(0.77).epsilon(0.02));
        }
    }
}
