// More friction or cohesion never gives less safety, and stiff joints give the same answer at any stiffness.

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "support/models.h"
#include "support/rock_slopes.h"
#include "support/verification.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

const Control kAlone{.interval = false, .upper_bound = Beside::never};

double factorOf(Model model, double friction_deg, double normal, double shear) {
    for (Joint& joint : model.joints) {
        if (friction_deg > 0) joint.friction = joint.residual_friction = radians(friction_deg);
        joint.normal_stiffness = normal;
        joint.shear_stiffness = shear;
    }
    const SearchResult result = *safetyFactor(model, kAlone);
    CHECK((result.status == SearchStatus::found));
    CHECK(!result.moving_blocks.empty());
    return result.answer;
}

/// A rock slope 5 m deep that three joint sets cut: all that may be drawn of it is.
Model drawnSlope(unsigned seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(random);
    };
    const double height = between(6, 9), foot = height / std::tan(radians(between(55, 75)));
    const auto number = [](double value) { return std::to_string(value); };
    const auto corner = [&](double x, double z) { return "[" + number(x) + ", " + number(z) + "], "; };
    const auto set = [&](int k, double dip, double direction, const char* law) {
        return "[[joint_set]]\nname = \"J" + std::to_string(k) + "\"\ndip_deg = " + number(dip) +
               "\ndip_direction_deg = " + number(direction) + "\nspacing = " + number(between(2, 3)) +
               "\nspacing_law = \"" + law + "\"\nfisher = 500\n";
    };
    const std::string text =
        "[material.rock]\ndensity = 2600.0\n[joint.default]\nfriction_deg = 30.0\nnormal_stiffness = 1e10\n"
        "shear_stiffness = 5e9\n[rock_mass]\nregion = { profile = [" +
        corner(-3, -2) + corner(foot + 7, -2) + corner(foot + 7, height) + corner(foot, height) +
        corner(0, 0) + corner(-3, 0) +
        "], y = [0, 5] }\nmin_thickness = 0.2\nseed = " + std::to_string(seed) +
        "\nfixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }]\n" +
        set(0, between(20, 40), between(255, 285), "exponential") +
        set(1, between(65, 85), between(70, 110), "uniform") +
        set(2, between(75, 88), between(0, 15), "constant");
    auto scenario = formats::parseScenario(text, "drawn.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(formats::format(error));
    REQUIRE(scenario.ok());
    return std::move(scenario->model);
}

}  // namespace

// Friction divided by the factor of safety is the friction at which a slope fails, whatever it has.
// Known faults, which is why two of these may fail: factors differ by 0.3 %, tilts fall by 0.6 %.
TEST_SUITE("slow: physics") {
    TEST_CASE("rock masses at random: the factor of safety is in proportion to the tangent of friction" *
              doctest::may_fail()) {
        int found = 0;
        for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
            CAPTURE(seed);
            Model model = drawnSlope(seed);
            std::optional<SearchResult> first;
            for (const double friction : {28.0, 28.5, 36.0, 43.0}) {
                CAPTURE(friction);
                for (Joint& joint : model.joints)
                    joint.friction = joint.residual_friction = radians(friction);
                const SearchResult result = *safetyFactor(model, kAlone);
                if (!first) first = result;
                CHECK((result.status == first->status));
                CHECK(result.answer / std::tan(radians(friction)) ==
                      doctest::Approx(first->answer / std::tan(radians(28.0))).epsilon(1e-9));
                CHECK(result.fallen_at_start == first->fallen_at_start);
                CHECK(result.moving_blocks == first->moving_blocks);
            }
            MESSAGE("seed " << seed << ", " << model.blocks.size() << " blocks, "
                            << first->fallen_at_start.size()
                            << " loose: " << std::string(toString(first->status)) << ", " << first->answer
                            << " at 28 degrees");
            found += first->status == SearchStatus::found ? 1 : 0;
        }
        CHECK(found >= 3);
    }

    // A long load step that ends at rest too far off is tried again in short ones: the last of them begins
    // where the slope stands, and not where the long one began. Of the first slope the angle was 5.62 degrees
    // with 4 % more friction, for 12.72.
    TEST_CASE("columns that three sets cut: the tilt at which they fail never falls with friction" *
              doctest::may_fail()) {
        const RockSlope slopes[] = {{.height = 12.51,
                                     .crest = 2.37,
                                     .back = 18.63,
                                     .width = 7.79,
                                     .plane_dip_deg = 25.2,
                                     .density = 2688,
                                     .normal_stiffness = 8.32e9,
                                     .shear_stiffness = 3.25e8,
                                     .friction_deg = 34.94,
                                     .sets = {{90, 90, 2.63}, {90, 0, 3.76}, {13.8, 270, 5.64}}},
                                    uprightColumns()};
        for (RockSlope slope : slopes) {
            const double given = std::tan(radians(slope.friction_deg));
            double before = 0;
            for (const double more : {1.0, 1.02, 1.04, 1.07, 1.1}) {
                slope.friction_deg = degrees(std::atan(more * given));
                CAPTURE(slope.friction_deg);
                const SearchResult result = *criticalAngle(scenarioOf(slope).model, kAlone);
                CHECK((result.status == SearchStatus::found));
                CHECK(!result.moving_blocks.empty());
                CHECK(result.answer >= before * (1 - 1e-3));
                MESSAGE("friction " << slope.friction_deg << ": " << degrees(result.answer));
                before = result.answer;
            }
        }
    }

    TEST_CASE(
        "stacks with cohesion that is lost once: more of it never less, and with enough they topple as one") {
        struct Shape {
            int columns, rows;
            double width;
        };
        int undecided = 0;
        for (const Shape shape : {Shape{1, 3, 0.2}, {1, 6, 0.3}, {4, 6, 0.25}, {7, 5, 0.2}, {5, 8, 0.3}})
            for (const double friction : {19.5, 30.0}) {
                CAPTURE(shape.columns);
                CAPTURE(shape.rows);
                CAPTURE(friction);
                Model model = stackModel(shape.columns, shape.rows, 1, friction, {shape.width, 0.1, 0.1});
                const double topples = std::atan(shape.width / (0.1 * shape.rows));
                double before = 0;
                bool is_last_decided = false;
                for (const double cohesion : {0.0, 500.0, 2e3, 8e3, 3e4, 1e9}) {
                    CAPTURE(cohesion);
                    for (Joint& joint : model.joints) joint.cohesion = cohesion;
                    const SearchResult result = *criticalAngle(model, kAlone);
                    undecided += result.status == SearchStatus::undecided;
                    is_last_decided = result.status != SearchStatus::undecided;
                    if (!is_last_decided) continue;
                    CHECK((result.status == SearchStatus::found));
                    CHECK(!result.moving_blocks.empty());
                    // What breaks first decides what breaks next: 0.09 degrees less with 2 kPa than with 0.5
                    // in one of these.
                    CHECK(result.answer >= before - radians(0.15));
                    before = result.answer;
                }
                if (is_last_decided) CHECK(before == doctest::Approx(topples).epsilon(0.001));
            }
        // Newton's method goes round in circles where many bonded joints open and close in turn.
        MESSAGE(undecided << " of 60 undecided");
        CHECK(undecided == 0);
    }
}

TEST_SUITE("physics") {
    TEST_CASE("Goodman and Bray's slope: its factor grows with friction and does not change with stiffness") {
        const Model model = verification("goodman-bray-slice-38.15");
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
        Model model = verification("goodman-bray");
        const double normal = model.joints[0].normal_stiffness, shear = model.joints[0].shear_stiffness;
        double before = 0;
        for (const double friction : {38.15, 38.3, 38.5, 38.66, 38.7}) {
            const double factor = factorOf(model, friction, normal, shear);
            CAPTURE(friction);
            CHECK(factor >= before);
            before = factor;
        }
    }

    TEST_CASE("Alejano and Alonso's columns: the effect of the ratio of the two stiffnesses") {
        const Model model = verification("alejano-alonso");
        for (const double ratio : {0.03, 0.1, 0.3, 1.0}) {
            const double factor = factorOf(model, 0, 1e12, ratio * 1e12);
            MESSAGE("shear stiffness " << ratio << " of the normal one: " << factor);
            CHECK(factor == doctest::Approx(0.77).epsilon(0.02));
        }
    }
}
