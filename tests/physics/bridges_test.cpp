// Rock bridges against limit equilibrium: a block on one joint that ends under it.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "build/build.h"
#include "forces/wet_walls.h"
#include "geometry/polygon.h"
#include "support/bench_scenario.h"
#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/overrides.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Of water at an elevation in the joint alone, on the block above [N].
double upliftOf(double dip_deg, double end, double elevation) {
    const double dip = radians(dip_deg), depth = elevation - 1;  // at the joint's lower end
    const double wet = std::min(end / std::cos(dip), depth / std::sin(dip));
    return 1000 * 9.81 * 2 * wet * (depth - 0.5 * wet * std::sin(dip));
}

/// J. E. Jennings (1970): friction and cohesion in proportion to the areas of joint and rock.
double factorOf(double dip_deg, double end, double joint_cohesion, double rock_cohesion, double uplift = 0) {
    const double dip = radians(dip_deg), rock = 1 - end / 10, area = 2 * 10 / std::cos(dip);
    const double volume = 2 * 10 * (9 - 5 * std::tan(dip)), weight = 2600 * 9.81 * volume;
    const double tangent = (1 - rock) * std::tan(radians(30)) + rock * std::tan(radians(45));
    const double cohesion = (1 - rock) * joint_cohesion + rock * rock_cohesion;
    return (cohesion * area + (weight * std::cos(dip) - uplift) * tangent) / (weight * std::sin(dip));
}

}  // namespace

TEST_CASE("bridges: a block on a joint that ends under it has Jennings's factor of safety") {
    for (const double dip : {35.0, 40.0})
        for (const double end : {2.0, 6.5, 9.0})
            for (const double rock : {20e3, 60e3}) {
                CAPTURE(dip);
                CAPTURE(end);
                CAPTURE(rock);
                const auto scenario =
                    formats::parseScenario(bench(dip, end, 5e3, rock, "bridge = \"intact\"\n"), "bench.toml");
                REQUIRE(scenario.ok());
                CHECK(scenario->finite_cuts.bridged == 1);
                const SearchResult result = *safetyFactor(scenario->model);
                CHECK((result.status == SearchStatus::found));
                CHECK(result.answer == doctest::Approx(factorOf(dip, end, 5e3, rock)).epsilon(2e-3));
            }
}

/// A cube on a slope held by the rock behind it, whose strength in tension is a share of the cube's weight
/// along the slope. Limit equilibrium counts it to the end; a joint that tears at once has nothing left when
/// the cube begins to slide.
TEST_CASE("bridges: what holds a block in tension counts as far as it softens with the opening") {
    for (const double dip_deg : {20.0, 30.0})
        for (const double share : {0.2, 0.6})
            for (const bool reduced : {true, false}) {
                CAPTURE(dip_deg);
                CAPTURE(share);
                CAPTURE(reduced);
                const double dip = radians(dip_deg), friction = std::tan(radians(40));
                const double weight = 2700 * 9.81, driving = weight * std::sin(dip);
                Model model = floorModel(40);
                model.gravity.tilt = dip;
                addBox(model, "held", {0, 0, 0}, {1, 1, 1});
                model.blocks.push_back(box("behind", {1, 0, 0}, {3, 1, 1}, 2700, Motion::fixed));
                model.joints.push_back(joint(40, 1e11));
                model.joints[1].name = "rock";
                model.joints[1].tensile_strength = share * driving;
                model.joints[1].tension_reduced = reduced;
                model.pair_joints.push_back({1, 2, 1, true, "interface[0]"});
                const double on_friction = weight * std::cos(dip) * friction / driving;
                const double to_the_end = reduced ? on_friction + share : on_friction / (1 - share);
                double last = 0;
                for (const double softening : {0.0, 1e-6, 1e-5, 1e-4, 1.0}) {
                    CAPTURE(softening);
                    model.joints[1].softening_displacement = softening;
                    const SearchResult result = *safetyFactor(model);
                    REQUIRE((result.status == SearchStatus::found));
                    if (softening == 0.0) {
                        CHECK(result.answer == doctest::Approx(on_friction).epsilon(2e-3));
                        CHECK(std::any_of(
                            result.warnings.begin(), result.warnings.end(), [](const std::string& text) {
                                return text.find("depends on tensile strength that is lost at once") !=
                                       std::string::npos;
                            }));
                    }
                    CHECK(result.answer >= (1 - 1e-3) * last);
                    CHECK(result.answer <= (1 + 2e-3) * to_the_end);
                    last = result.answer;
                }
                CHECK(last == doctest::Approx(to_the_end).epsilon(2e-3));
            }
}

TEST_CASE("bridges: without rock the joint's strength continues, with a warning") {
    const auto scenario = formats::parseScenario(bench(40, 5, 5e3, 60e3), "bench.toml");
    REQUIRE(scenario.ok());
    REQUIRE(scenario->warnings.size() == 2);
    CHECK(scenario->warnings[1].find("nothing in the file uses this joint") != std::string::npos);
    CHECK(scenario->warnings[0].find("13.1 of 26.1 m2") != std::string::npos);
    CHECK(scenario->warnings[0].find("rock_mass.bridge") != std::string::npos);
    CHECK(scenario->model.pair_joints.empty());
    CHECK(safetyFactor(scenario->model)->answer ==
          doctest::Approx(factorOf(40, 10, 5e3, 60e3)).epsilon(2e-3));
    const auto through = formats::parseScenario(bench(40, 10, 5e3, 60e3), "bench.toml");
    REQUIRE(through->warnings.size() == 1);
    CHECK(through->warnings[0] == scenario->warnings[1]);
}

TEST_CASE("bridges: what a bridge is mixed of follows a change of either by reading again") {
    const std::string text = bench(40, 5, 5e3, 60e3, "bridge = \"intact\"\n");
    const auto scenario = formats::parseScenario(text, "bench.toml");
    REQUIRE(scenario.ok());
    const Joint& mixed = scenario->model.joints.back();
    CHECK(mixed.name == "default@0.5intact");
    CHECK(mixed.cohesion == doctest::Approx(32.5e3));
    CHECK(std::tan(mixed.friction) ==
          doctest::Approx(0.5 * (std::tan(radians(30)) + std::tan(radians(45)))).epsilon(1e-12));
    CHECK_FALSE(formats::canOverride(*scenario, "joint.default.friction_deg"));
    CHECK_FALSE(formats::canOverride(*scenario, "joint.intact.cohesion"));
}

TEST_CASE("bridges: joint and rock are mixed only if their strengths change alike") {
    const std::string table = "strength_over_time = [[0, 0.8], [10, 0.5]]\n";
    std::string text = bench(40, 5, 5e3, 60e3, "bridge = \"intact\"\n");
    text.insert(text.find("[joint.intact]"), table);
    const auto refused = formats::parseScenario(text, "bench.toml");
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.errors()[0].field == "rock_mass.bridge");
    CHECK(refused.errors()[0].message.find("\"default\" with another strength_over_time than \"intact\"") !=
          std::string::npos);
    text.insert(text.find("[rock_mass]"), table);
    std::string wet = text;
    wet.insert(wet.find("[joint.intact]"), "wet_strength_factor = 0.5\n");
    const auto refused_too = formats::parseScenario(wet, "bench.toml");
    REQUIRE_FALSE(refused_too.ok());
    CHECK(refused_too.errors()[0].message.find("with a wet_strength_factor of 0.5") != std::string::npos);
    const auto scenario = formats::parseScenario(text, "bench.toml");
    REQUIRE(scenario.ok());
    CHECK(scenario->model.joints.back().strength_over_time.size() == 2);
    CHECK(safetyFactor(scenario->model)->answer ==
          doctest::Approx(0.8 * factorOf(40, 5, 5e3, 60e3)).epsilon(3e-3));
}

TEST_CASE("bridges: water in a joint does not stand in the rock beyond it") {
    // A cross joint parts the block above: the hinder of the two has nothing but rock below it.
    const std::string cross =
        "[[single_joint]]\npolygon = [[6, 0, 7], [6, 0, 11], [6, 2, 11], [6, 2, 7]]\n"
        "[[water]]\njoint = \"J\"\nelevation = 9\n";
    const auto walls = [&](const std::string& bridge) {
        const auto scenario = formats::parseScenario(bench(40, 3, 0, 60e3, bridge) + cross, "bench.toml");
        REQUIRE(scenario.ok());
        return scenario->model.waters[0].walls.size();
    };
    CHECK(walls("") == 3);
    CHECK(walls("bridge = \"intact\"\n") == 2);
}

TEST_CASE("bridges: water lifts what lies over the joint, and not over the rock beyond it") {
    for (const double dip : {35.0, 40.0})
        for (const double end : {2.0, 5.0, 8.0})
            for (const double elevation : {1.5, 4.0, 7.0}) {
                CAPTURE(dip);
                CAPTURE(end);
                CAPTURE(elevation);
                const std::string water =
                    "[[water]]\njoint = \"J\"\nelevation = " + std::to_string(elevation) + "\n";
                const auto scenario = formats::parseScenario(
                    bench(dip, end, 5e3, 60e3, "bridge = \"intact\"\n") + water, "bench.toml");
                REQUIRE(scenario.ok());
                const SearchResult result = *safetyFactor(scenario->model);
                CHECK((result.status == SearchStatus::found));
                CHECK(result.answer ==
                      doctest::Approx(factorOf(dip, end, 5e3, 60e3, upliftOf(dip, end, elevation)))
                          .epsilon(2e-3));
            }
}

/// A water table is the pore pressure of the whole mass, of rock as of joints: normal stresses are effective
/// ones everywhere.
TEST_CASE("bridges: a water table lifts the rock beyond a joint as it lifts the joint") {
    for (const double dip_deg : {35.0, 40.0})
        for (const double end : {2.0, 5.0, 8.0})
            for (const double depth :
                 {0.2, 0.6}) {  // below it at the bed's upper end, where the back is; none at the toe
                CAPTURE(dip_deg);
                CAPTURE(end);
                CAPTURE(depth);
                const double dip = radians(dip_deg), top = 1 + 10 * std::tan(dip) + depth;
                const auto scenario = formats::parseScenario(
                    bench(dip_deg, end, 5e3, 60e3, "bridge = \"intact\"\n") +
                        "[[water]]\nsurface = [[0, 1], [10, " + std::to_string(top) + "]]\n",
                    "bench.toml");
                REQUIRE(scenario.ok());
                const SearchResult result = *safetyFactor(scenario->model);
                CHECK((result.status == SearchStatus::found));
                const double uplift = 1000 * 9.81 * 2 * 0.5 * depth * 10 / std::cos(dip);
                const double thrust = 1000 * 9.81 * 2 * 0.5 * depth * depth;  // on the back
                const double weight = 2600 * 9.81 * 2 * 10 * (9 - 5 * std::tan(dip));
                const double dry = factorOf(dip_deg, end, 5e3, 60e3, uplift + thrust * std::sin(dip));
                const double driving = weight * std::sin(dip);
                CHECK(result.answer ==
                      doctest::Approx(dry * driving / (driving + thrust * std::cos(dip))).epsilon(2e-3));
            }
}

TEST_CASE("bridges: water in a disc pushes on as much as the disc has, on both sides, at any inclination") {
    for (const double dip : {0.0, 30.0, 85.0})
        for (const double direction : {0.0, 77.0}) {
            CAPTURE(dip);
            CAPTURE(direction);
            const auto scenario = formats::parseScenario(
                "[material.rock]\ndensity = 2600.0\n[joint.default]\nnormal_stiffness = "
                "1e10\nshear_stiffness = 1e10\n"
                "friction_deg = 30\n[joint.intact]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\n"
                "friction_deg = 45\ncohesion = 1e6\n"
                "[rock_mass]\nregion = { box = { min = [100, 0, 0], max = [110, 10, 10] } }\nbridge = "
                "\"intact\"\n"
                "fixed = [{ boundary = \"-z\" }]\n[[single_joint]]\nname = \"J\"\npoint = [105, 5, "
                "5]\nradius = 2.5\n"
                "dip_deg = " +
                    std::to_string(dip) + "\ndip_direction_deg = " + std::to_string(direction) +
                    "\n[[water]]\njoint = \"J\"\nelevation = 12\n",
                "disc.toml");
            if (!scenario.ok()) FAIL(scenario.errors()[0].message);
            const State state = *buildState(scenario->model, false);
            REQUIRE(state.wet.size() == 2);
            for (std::size_t w = 0; w < 2; ++w)
                CHECK(area(wetPolygon(state.wet, w)) == doctest::Approx(M_PI * 2.5 * 2.5));
        }
}

TEST_CASE("bridges: only Coulomb's law is mixed, only joints that are there") {
    const auto refused = [](const std::string& text, const std::string& what) {
        const auto scenario = formats::parseScenario(text, "bench.toml");
        REQUIRE_FALSE(scenario.ok());
        CHECK(scenario.errors()[0].field == "rock_mass.bridge");
        CHECK(scenario.errors()[0].message.find(what) != std::string::npos);
    };
    refused(bench(40, 5, 0, 0, "bridge = \"intakt\"\n"), "intact");
    std::string curved = bench(40, 5, 0, 0, "bridge = \"curved\"\n");
    curved +=
        "[joint.curved]\nlaw = \"power\"\na = 1.0\nb = 0.9\nnormal_stiffness = 1e10\nshear_stiffness = "
        "1e10\n";
    refused(curved, "\"power\"");
}
