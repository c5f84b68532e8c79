#include "checks/joint_order.h"

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "support/models.h"
#include "talus/analysis.h"
#include "talus/simulation.h"
#include "talus/storm.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A cube with a joint of its own on a floor of another.
Model cube(const std::vector<LevelPoint>& factors) {
    Model model = floorModel(25);
    model.joints.push_back(joint(30));
    model.joints[0].name = "rock";
    model.joints[1].name = "ice";
    model.joints[1].strength_over_time = factors;
    addBox(model, "cube", {0, 0, 0}, {1, 1, 1});
    model.blocks.back().face_joint.assign(6, 1);
    return model;
}

std::vector<Error> doubtsOf(const Model& model) { return checks::weakerLater(*buildState(model, false)); }

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("a joint that becomes weaker than the one between two faces is told of") {
        const Model model = cube({{0, 1.0}, {1, 0.3}, {2, 0.3}, {3, 0.5}});
        const auto doubts = doubtsOf(model);
        REQUIRE(doubts.size() == 1);
        CHECK(doubts[0].field == "joint.ice.strength_over_time");
        // atan(0.3 tan 30)
        CHECK(doubts[0].message.find(
                  "at 1 s joint.ice has an angle of friction of 9.826 deg and joint.rock "
                  "has an angle of friction of 25 deg; between faces of both a run keeps joint.rock") == 0);
        ModelCheck found;
        REQUIRE(checkModel(model, {}, &found).empty());
        CHECK(std::count_if(found.warnings.begin(), found.warnings.end(), [&](const std::string& warning) {
                  return warning.starts_with(doubts[0].field);
              }) == 1);
    }

    TEST_CASE("no order of joints changes: nothing is told") {
        CHECK(doubtsOf(cube({})).empty());
        CHECK(doubtsOf(cube({{0, 1.0}, {1, 0.9}})).empty());  // 27.5 deg
        CHECK(doubtsOf(cube({{0, 0.5}, {1, 0.3}})).empty());  // the weaker one from the start
        CHECK(doubtsOf(cube({{0, 0.5}, {1, 1.0}})).size() == 1);
        Model both = cube({{0, 1.0}, {1, 0.3}});  // alike
        both.joints[0].strength_over_time = both.joints[1].strength_over_time;
        CHECK(doubtsOf(both).empty());
        Model given = cube({{0, 1.0}, {1, 0.3}});
        given.pair_joints = {{0, 1, 0, true, "interface[0]"}};
        CHECK(doubtsOf(given).empty());
    }

    TEST_CASE("joints that water weakens are compared as wet as they are") {
        Model model = cube({{0, 1.0}, {1, 0.8}});  // 24.8 deg
        model.joints[0].wet_strength_factor = 0.9;
        const auto wetted = [&] {
            Model wet = model;  // as withWetJoints does
            wet.joints.push_back(strengthened(wet.joints[0], 0.9));
            wet.joints.back().name = "rock@1wet";
            wet.joints.back().wet_strength_factor = 1;
            wet.pair_joints = {{0, 1, 2, false, "", 5, 4}};
            return wet;
        };
        CHECK(doubtsOf(model).size() == 1);
        const Model wet = wetted();
        REQUIRE(buildState(wet, false)->interfaces.joint[0] == 2);
        CHECK(doubtsOf(wet).empty());  // rock has 22.8 deg
        model.joints[1].strength_over_time[1].value = 0.7;
        const auto doubts = doubtsOf(wetted());
        REQUIRE(doubts.size() == 1);
        CHECK(doubts[0].message.find("joint.rock has an angle of friction of 22.77 deg") !=
              std::string::npos);
        model.joints[1].wet_strength_factor = 0.5;
        CHECK(doubtsOf(wetted())[0].message.find("joint.ice has an angle of friction of 11.42 deg") !=
              std::string::npos);
    }

    TEST_CASE("a search takes the joint that is weaker at time 0, a storm at each time") {
        Model model = cube({{0, 1.0}, {3600, 0.5}});
        model.gravity.tilt = radians(12);
        const auto factor = [](double tan_friction) { return tan_friction / std::tan(radians(12)); };
        const double rock = factor(std::tan(radians(25))), ice = factor(std::tan(radians(30)));
        const auto result = storm(model, {.step = 3600});
        REQUIRE(result.ok());
        REQUIRE(result->points.size() == 2);
        CHECK(result->points[0].factor == doctest::Approx(rock).epsilon(0.001));
        CHECK(result->points[1].factor == doctest::Approx(0.5 * ice).epsilon(0.001));
        model.joints[1].strength_over_time = {{0, 0.5}, {3600, 1.0}};
        const auto found = safetyFactor(model);
        REQUIRE(found.ok());
        CHECK(found->answer == doctest::Approx(0.5 * ice).epsilon(0.001));
    }
}
