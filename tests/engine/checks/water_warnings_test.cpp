#include "checks/water_warnings.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "build/build.h"
#include "checks/closed_volumes.h"
#include "checks/plausible.h"
#include "checks/water_levels.h"
#include "support/models.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A free block of 1 x 1 x 2 m on a fixed bench of 1 m, and a fixed wall behind both.
Model bench() {
    Model model = floorModel(40);
    model.blocks.push_back(box("bench", {0, 0, 0}, {1, 1, 1}, 2700, Motion::fixed));
    model.blocks.push_back(box("wall", {1, 0, 0}, {2, 1, 4}, 2700, Motion::fixed));
    addBox(model, "key", {0, 0, 1}, {1, 1, 2});
    return model;
}

/// In the plane before the wall: the wall's face, the bench's, and the key's from 1 m on.
Water behind(const Model& model) {
    Water water = fissureAt(model, 1, 0);
    water.base = -kInfinity;
    return water;
}

std::vector<std::string> told(const Model& model) {
    std::vector<std::string> all;
    for (const Error& doubt : checks::dryWaters(*buildState(model, false)))
        all.push_back(doubt.field + ": " + doubt.message);
    return all;
}

std::vector<std::string> levelsTold(Model model, const std::vector<Water>& waters, bool over_time = false) {
    model.waters = waters;
    std::vector<std::string> all;
    for (const Error& doubt : checks::levelsAboveJoints(*buildState(model, false), over_time))
        all.push_back(doubt.field + ": " + doubt.message);
    return all;
}

void checkTold(const Model& model, const std::string& key, const std::string& why) {
    const auto all = told(model);
    CAPTURE(key);
    REQUIRE(all.size() == 1);
    CAPTURE(all[0]);
    CHECK(all[0].find(key + ": found ") == 0);
    CHECK(all[0].find(why) != std::string::npos);
    CHECK(all[0].find("it wets no free block") != std::string::npos);
}

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("water below all free blocks is reported by its scenario key") {
        Model model = bench();
        const auto with = [&](auto change) {
            Water water = behind(model);
            change(water);
            model.waters = {water};
        };
        with([](Water& w) { w.level = {{0, 0.8}}; });
        checkTold(model, "water[0].depth", "up to 0.8 m, which is not above the lowest");
        with([](Water& w) { w.level = {{0, 0.2}, {1, 0.9}, {2, 0.1}}; });
        checkTold(model, "water[0].levels", "up to 0.9 m");
        with([](Water& w) { w.kind = Water::Level::elevation, w.level = {{0, 1.0}}; });
        checkTold(model, "water[0].elevation", "walls on free blocks, at 1 m");
        with([](Water& w) { w.level = {{0, 0.5}}, w.base = 3.2; });
        checkTold(model, "water[0].base", "no wall of a free block above its base, 3.2 m");
    }

    TEST_CASE("water that reaches a free block at any time is not doubted") {
        Model model = bench();
        Water water = behind(model);
        for (const std::vector<LevelPoint>& level :
             {std::vector<LevelPoint>{{0, 1.01}}, {{0, 0.0}, {1, 1.5}, {2, 0.5}}, {{0, 5.0}}}) {
            water.level = level;
            model.waters = {water};
            CHECK(told(model).empty());
        }
        // What is given as nothing is meant to be dry.
        water.level = {{0, 0.0}};
        model.waters = {water};
        CHECK(told(model).empty());
    }

    TEST_CASE("water with no wall of a free block") {
        Model model = bench();
        model.waters = {waterOn(model, 2, -Vec3::UnitX(), 2.5)};  // on the wall alone
        checkTold(model, "water[0].depth", "no wall of a free block");
        Water between;  // of two fixed blocks it is an error, as they share no interface
        between.kind = Water::Level::head;
        between.head = {1, 1};
        between.field = "water[0]";
        between.pair = {{3, 1}};
        model.waters = {between};
        CHECK(told(model).empty());
    }

    TEST_CASE("water whose pressure falls from nothing at the joint's upper end") {
        Model model = bench();
        Water water = behind(model);
        water.kind = Water::Level::elevation;
        water.daylight = Water::Daylight::straight;
        water.level = {{0, 4.0}};  // where the joint ends
        model.waters = {water};
        checkTold(model, "water[0].daylights", "not above the joint's upper end, at 4 m");
        water.level = {{0, 4.5}};
        model.waters = {water};
        CHECK(told(model).empty());
        water.daylight = Water::Daylight::half_height;
        water.level = {{0, 4.0}};
        model.waters = {water};
        CHECK(told(model).empty());
    }

    TEST_CASE("a tilt turns what is above what; heights are along gravity") {
        Model model = bench();
        Water water = behind(model);
        water.kind = Water::Level::elevation;
        water.level = {{0, 1.2}};
        model.waters = {water};
        CHECK(told(model).empty());
        model.gravity.tilt = radians(30);  // the key's foot at x = 1 stands at sin(30) + cos(30)
        checkTold(model, "water[0].elevation", "at 1.366 m (heights along gravity at a tilt of 30 deg)");
    }

    TEST_CASE("a level above the joint that holds it names level, upper end and difference") {
        Model model = bench();  // the joint ends at 4 m
        Water water = behind(model);
        water.level = {{0, 4.0}};
        CHECK(levelsTold(model, {water}).empty());
        water.level = {{0, 1.0}, {1, 5.5}, {2, 0.0}};
        CHECK(levelsTold(model, {water}).empty());  // at time 0
        auto all = levelsTold(model, {water}, true);
        REQUIRE(all.size() == 1);
        CHECK(all[0].find(
                  "water[0]: found a depth of 5.5 m at 1 s, so that the water stands 1.5 m above the joint's "
                  "upper end: at 5.5 m instead of at most 4 m") == 0);
        water.kind = Water::Level::elevation;
        water.level = {{0, 4.5}};
        all = levelsTold(model, {water});
        REQUIRE(all.size() == 1);
        CHECK(all[0].find("a level of 4.5 m, so that the water stands 0.5 m above") != std::string::npos);
        model.gravity.tilt = radians(30);  // the wall's top at x = 1 stands at sin(30) + 4 cos(30) = 3.964
        all = levelsTold(model, {water});
        REQUIRE(all.size() == 1);
        CHECK(all[0].find("0.5359 m above the joint's upper end") != std::string::npos);
    }

    TEST_CASE("of levels over time the one farthest above counts at which no other joint feeds it") {
        Model model = bench();
        addBox(model, "top", {0, 0, 3}, {1, 1, 2});
        Water low = behind(model), high = behind(model);
        low.kind = high.kind = Water::Level::elevation;
        low.pair = {{3, 2}}, low.walls.clear();                             // key and wall, up to 3 m
        high.pair = {{4, 2}}, high.walls.clear(), high.field = "water[1]";  // up to 4 m
        low.level = {{0, 1.0}, {10, 3.5}, {20, 3.8}, {30, 1.0}};
        high.level = {{0, 3.1}, {10, 3.1}, {20, 3.9}, {30, 3.9}};
        auto all = levelsTold(model, {low, high}, true);
        REQUIRE(all.size() == 1);  // at 20 s the upper joint feeds it
        CHECK(all[0].find("water[0]: found a level of 3.5 m at 10 s, so that") == 0);
        high.level = {{0, 3.9}};
        CHECK(levelsTold(model, {low, high}, true).empty());
        low.level = {{0, 3.6}, {10, 1.0}};
        all = levelsTold(model, {low}, true);
        REQUIRE(all.size() == 1);
        CHECK(all[0].find("3.6 m at 0 s") != std::string::npos);
    }

    TEST_CASE("a history looks at levels of all times, a search at those of time 0") {
        Model model = bench();
        model.waters = {behind(model)};
        model.waters[0].level = {{0, 1.5}, {1, 4.5}};
        const auto countOf = [&](const std::vector<std::string>& warnings) {
            return std::count_if(warnings.begin(), warnings.end(), [&](const std::string& warning) {
                return checks::isOfLevelAboveJoint(warning, model.waters[0]);
            });
        };
        ModelCheck checked;
        REQUIRE(checkModel(model, {}, &checked).empty());
        CHECK(countOf(checked.warnings) == 1);
        model.run.duration = 0.01;
        const auto ran = run(model, {}, RunOutput{});
        REQUIRE(ran.ok());
        CHECK(countOf(ran->warnings) == 1);
        CHECK(countOf(checks::doubts(*buildState(model, false))) == 0);
    }

    TEST_CASE("a reservoir may stand above the face that it presses on") {
        Model model = bench();
        CHECK(levelsTold(model, {waterOn(model, 3, -Vec3::UnitX(), 9)}).empty());
    }

    TEST_CASE("a level above one joint may be that of another that reaches so high") {
        Model model = bench();
        addBox(model, "top", {0, 0, 3}, {1, 1, 2});
        Water low = behind(model), high = behind(model);
        low.kind = high.kind = Water::Level::elevation;
        low.pair = {{3, 2}}, low.walls.clear();  // key and wall, up to 3 m
        high.pair = {{4, 2}}, high.walls.clear(), high.field = "water[1]";
        low.level = high.level = {{0, 3.5}};
        CHECK(levelsTold(model, {low}).size() == 1);
        CHECK(levelsTold(model, {low, high}).empty());
    }

    TEST_CASE("strength when wet has no effect where the joint is dry") {
        Model model = bench();
        model.waters = {behind(model)};
        model.waters[0].level = {{0, 1.5}};
        CHECK(checks::wetStrengthOfDryJoints(model).empty());
        model.joints[0].wet_strength_factor = 0.5;
        model.joints[0].name = "clay@18deg";
        const auto doubts = checks::wetStrengthOfDryJoints(model);
        REQUIRE(doubts.size() == 1);
        CHECK(doubts[0].field == "joint.clay.wet_strength_factor");
        model.joints.push_back(model.joints[0]);
        model.joints[1].name = "clay@18deg@0.25wet";
        CHECK(checks::wetStrengthOfDryJoints(model).empty());
        model.joints.pop_back();
        model.waters[0].level = {{0, 0.0}};
        CHECK(checks::wetStrengthOfDryJoints(model).empty());
    }

    TEST_CASE("a closed volume in a history without dashpots is told of") {
        Model model = bench();
        model.waters = {behind(model)};
        CHECK(checks::undampedVolumes(model).empty());
        model.waters[0].closed = true;
        REQUIRE(checks::undampedVolumes(model).size() == 1);
        CHECK(checks::undampedVolumes(model)[0].field == "damping.contact");
        model.damping.mass = 45;
        CHECK(checks::undampedVolumes(model).size() == 1);
        model.damping.contact = 1e-5;
        CHECK(checks::undampedVolumes(model).empty());
    }

    TEST_CASE("a leak without other water is told of") {
        Model model = bench();
        model.waters = {behind(model)};
        model.waters[0].closed = true;
        CHECK(checks::leaksWithoutPressure(model).empty());
        model.waters[0].leak_aperture = 1e-4;
        REQUIRE(checks::leaksWithoutPressure(model).size() == 1);
        CHECK(checks::leaksWithoutPressure(model)[0].field == "water[0].leak_aperture");
        model.waters.push_back(behind(model));
        CHECK(checks::leaksWithoutPressure(model).empty());
    }

    TEST_CASE("a water table below all free blocks") {
        Model model = bench();
        PhreaticSurface table;
        table.field = "water[0]";
        table.line = {{-5, 0.5}, {20, 0.9}};
        model.phreatic = table;
        checkTold(model, "water[0].surface", "a water table below all free blocks");
        model.phreatic->line = {{-5, 0.5}, {20, 4}};
        CHECK(told(model).empty());
    }
}
