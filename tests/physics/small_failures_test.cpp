// Failures of too little mass to be the answer: they are removed and named, and the search continues with the
// rest.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("physics") {
    TEST_CASE("a failure of too little mass to be the answer is removed, in every search") {
        using Find = Result<SearchResult> (*)(const Model&, const Control&, const SearchRules&);
        struct Kind {
            Find find;
            double tilt;                       // [deg] of the model
            double (*answer)(double, double);  // of friction and that tilt, both [rad]
        };
        const Kind kinds[] = {
            {criticalAngle, 0, [](double phi, double) { return phi; }},
            {safetyFactor, 10, [](double phi, double tilt) { return std::tan(phi) / std::tan(tilt); }},
            {criticalAcceleration, 5, [](double phi, double tilt) { return std::tan(phi - tilt); }}};
        // Friction under each box of so many metres; masses in all are 1 + 0.027 + 0.008 + 1.
        const double friction[] = {35, 24, 20, 40}, size[] = {1, 0.3, 0.2, 1};
        struct Wanted {
            double share;
            std::size_t answer, removed_groups;
        };
        for (const Kind& kind : kinds) {
            std::uint64_t hash = 0;
            for (const Wanted& wanted : {Wanted{0, 2, 0}, Wanted{0.003, 2, 0}, Wanted{0.005, 1, 1},
                                         Wanted{0.05, 0, 2}, Wanted{0.6, 0, 2}}) {
                CAPTURE(kind.tilt);
                CAPTURE(wanted.share);
                Model model = floorModel(30);
                for (int k = 0; k < 4; ++k) {
                    model.joints.push_back(joint(friction[k]));
                    addBox(model, "b" + std::to_string(k), {2.0 * k, 0, 0}, {size[k], size[k], size[k]});
                    model.pair_joints.push_back({0, k + 1, k + 1});
                }
                model.gravity.tilt = radians(kind.tilt);
                model.analysis.least_mass_share = wanted.share;
                const SearchResult result = *kind.find(model, {}, {});
                const auto answer = [&](std::size_t k) {
                    return kind.answer(radians(friction[k]), radians(kind.tilt));
                };
                // With the last share the remaining blocks would have too little mass for an answer.
                CHECK((result.status == SearchStatus::found));
                CHECK(result.answer == doctest::Approx(answer(wanted.answer)).epsilon(0.001));
                CHECK(result.moving_blocks == std::vector{"b" + std::to_string(wanted.answer)});
                REQUIRE(result.removed_groups.size() == wanted.removed_groups);
                for (std::size_t k = 0; k < wanted.removed_groups; ++k) {
                    CHECK(result.removed_groups[k].factor == doctest::Approx(answer(2 - k)).epsilon(0.001));
                    CHECK(result.removed_groups[k].blocks == std::vector{"b" + std::to_string(2 - k)});
                }
                CHECK(leftOut(result).size() == wanted.removed_groups);
                if (wanted.share == 0) hash = result.state_hash;
                if (wanted.removed_groups == 0) CHECK(result.state_hash == hash);  // the same search
                if (kind.find != safetyFactor || wanted.share != 0.05) continue;
                Control control;
                control.groups = 3;
                const SearchResult groups = *safetyFactor(model, control);
                CHECK(groups.removed_groups.size() == 2);
                REQUIRE(groups.groups.size() == 2);
                CHECK(groups.groups[0].blocks == std::vector<std::string>{"b0"});
                CHECK(groups.groups[1].factor == doctest::Approx(answer(3)).epsilon(0.001));
            }
        }
    }

    TEST_CASE(
        "what has too little mass to be the answer is let go at the start, too, and is not called loose") {
        for (const double tilt : {25.0, 31.0, 34.0}) {  // beyond the friction of one or two
            CAPTURE(tilt);
            Model model = floorModel(35);
            for (const double friction : {20.0, 30.0}) {
                model.joints.push_back(joint(friction));
                const auto b = static_cast<std::int32_t>(model.blocks.size());
                addBox(model, "b" + std::to_string(b), {2.0 * b, 0, 0}, {0.2, 0.2, 0.2});
                model.pair_joints.push_back({0, b, b});
            }
            addBox(model, "slope", {0, 0, 0}, {1, 1, 1});
            model.analysis.start = radians(tilt);
            CHECK((criticalAngle(model)->status == SearchStatus::unstable_at_start));
            model.analysis.least_mass_share = 0.05;
            const SearchResult result = *criticalAngle(model);
            CHECK((result.status == SearchStatus::found));
            CHECK(degrees(result.answer) == doctest::Approx(35).epsilon(0.001));
            CHECK(result.fallen_at_start.empty());
            CHECK(leftOut(result).size() == 2);
            CHECK(result.removed_groups[0].factor == doctest::Approx(radians(tilt)));
            // No answer where what fails has that much of the mass.
            model.analysis.least_mass_share = 0.001;
            CHECK((criticalAngle(model)->status == SearchStatus::unstable_at_start));
        }
    }

    TEST_CASE("a small block that a bolt ties is not removed: the bolt would stay tied to its place") {
        for (const bool is_tied : {false, true}) {
            CAPTURE(is_tied);
            Model model = floorModel(35);
            model.joints.push_back(joint(20));
            addBox(model, "pebble", {0, 0, 0}, {0.2, 0.2, 0.2});
            addBox(model, "slope", {2, 0, 0}, {1, 1, 1});
            model.pair_joints = {{0, 1, 1}};
            model.analysis.least_mass_share = 0.05;
            if (is_tied) {
                Bolt bolt;  // upslope, and far too weak
                bolt.name = "B";
                bolt.head = {0, 0.1, 0.1};
                bolt.end = {1.5, 0.1, -0.5};
                bolt.area = 1e-4;
                bolt.modulus = 2e11;
                bolt.yield_force = 10;
                model.bolts = {bolt};
            }
            const SearchResult result = *criticalAngle(model);
            CHECK((result.status == SearchStatus::found));
            CHECK(result.removed_groups.size() == (is_tied ? 0 : 1));
            CHECK(result.moving_blocks == std::vector<std::string>{is_tied ? "pebble" : "slope"});
            CHECK(degrees(result.answer) > (is_tied ? 20.5 : 34.9));
            CHECK(degrees(result.answer) < (is_tied ? 25.0 : 35.1));
        }
    }

    TEST_CASE(
        "what does not stand without a block that is let go goes with it, and together they may be the "
        "answer") {
        const auto plank = [](double share) {
            Model model = floorModel(35);
            model.joints.push_back(joint(15));
            model.joints.push_back(joint(1));
            addBox(model, "pier", {0, 0, 0}, {1, 1, 0.2});
            addBox(model, "prop", {1.7, 0.4, 0}, {0.2, 0.2, 0.2});
            addBox(model, "plank", {0.55, 0.4, 0.2}, {1.3, 0.2, 0.05});  // its centre is beside the pier
            model.pair_joints = {{0, 2, 1}, {2, 3, 2}};
            model.analysis.least_mass_share = share;
            return *criticalAngle(model);
        };
        // Of 0.2 + 0.008 + 0.013 cubic metres: the prop has 3.6 % and the plank 5.9 %.
        const SearchResult gone = plank(0.12);
        CHECK((gone.status == SearchStatus::found));
        CHECK(degrees(gone.answer) == doctest::Approx(35).epsilon(0.001));
        CHECK(gone.moving_blocks == std::vector<std::string>{"pier"});
        REQUIRE(gone.removed_groups.size() == 1);
        CHECK(gone.removed_groups[0].blocks == std::vector<std::string>{"plank", "prop"});
        const SearchResult together = plank(0.08);
        CHECK((together.status == SearchStatus::found));
        CHECK(together.answer == gone.removed_groups[0].factor);
        CHECK(together.moving_blocks == std::vector<std::string>{"plank", "prop"});
        CHECK(together.removed_groups.empty());
        // The prop slides, then the plank falls: each is said to move as it does.
        CHECK((together.mode == FailureMode::mixed));
        struct Told {
            std::string block;
            FailureMode mode;
        };
        for (const Told& told : {Told{"prop", FailureMode::sliding}, {"plank", FailureMode::toppling}}) {
            CAPTURE(told.block);
            const auto motion = std::find_if(together.motions.begin(), together.motions.end(),
                                             [&](const BlockMotion& m) { return m.block == told.block; });
            REQUIRE(motion != together.motions.end());
            CHECK(motion->moving);
            CHECK((motion->mode == told.mode));
        }
    }

    TEST_CASE("water presses on the other blocks as before when a small block is removed") {
        const std::string pebble =
            "[joint.slick]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 2\n"
            "[[block]]\nname = \"shelf\"\nfixed = true\nbox = { min = [-9, 0, -1], max = [-7, 1, 0] }\n"
            "[[block]]\nname = \"pebble\"\njoint = \"slick\"\nbox = { min = [-8.05, 0.5, 0], max = [-8, "
            "0.55, 0.05] }\n";
        for (const std::string water :
             {"[[water]]\nfissure = 1\ndepth = 0.15\n", "[[water]]\nsurface = [[-20, 0.1], [20, 0.1]]\n"}) {
            CAPTURE(water);
            const auto found = [&](const std::string& more) {
                const auto scenario = formats::parseScenario(
                    "[material.granite]\ndensity = 2700\n[joint.default]\nnormal_stiffness = "
                    "1e10\nshear_stiffness = 1e10\nfriction_deg = 19.5\n[[stack]]\ncolumns = 2\nrows = "
                    "2\nslices = 1\nblock = [0.2, 0.1, 0.1]\n" +
                        water + more,
                    "wet.toml");
                REQUIRE(scenario.ok());
                return *criticalAngle(scenario->model);
            };
            const SearchResult alone = found(""),
                               rest = found(pebble + "[analysis]\nleast_mass_share = 0.05\n");
            CHECK((alone.status == SearchStatus::found));
            CHECK((rest.status == SearchStatus::found));
            REQUIRE(rest.removed_groups.size() == 1);
            CHECK(rest.removed_groups[0].blocks == std::vector<std::string>{"pebble"});
            CHECK(rest.moving_blocks == alone.moving_blocks);
            CHECK(degrees(rest.answer) == doctest::Approx(degrees(alone.answer)).epsilon(0.002));
            CHECK(degrees(alone.answer) < 19);  // by the water
        }
    }
}
