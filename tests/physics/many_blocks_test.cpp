// Searches of more than a thousand free blocks, which remove failures of too little mass without refining
// them.

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr int kRows = 32, kColumns = 32;  // of cubes of 0.2 m that stand by themselves: 1,024
constexpr double kFriction = 35;          // under all that have none of their own [deg]

struct Slick {
    double friction;  // under it [deg]
    double size;      // [m]
};

/// A field of cubes, and boxes of other sizes with joints of their own beside it.
Model field(const std::vector<Slick>& slick, double tilt) {
    Model model = floorModel(kFriction);
    model.blocks[0] = box("floor", {-1, -5, -1}, {16, 16, 0}, 2700, Motion::fixed);
    for (int i = 0; i < kRows; ++i)
        for (int k = 0; k < kColumns; ++k)
            addBox(model, "c" + std::to_string(i) + "-" + std::to_string(k), {0.4 * i, 0.4 * k, 0},
                   {0.2, 0.2, 0.2});
    for (std::size_t k = 0; k < slick.size(); ++k) {
        const auto b = static_cast<std::int32_t>(model.blocks.size());
        model.joints.push_back(joint(slick[k].friction));
        addBox(model, "s" + std::to_string(k), {0.5 * static_cast<double>(k), -3, 0},
               Vec3::Constant(slick[k].size));
        model.pair_joints.push_back({0, b, static_cast<std::int32_t>(model.joints.size()) - 1});
    }
    model.gravity.tilt = radians(tilt);
    return model;
}

using Find = Result<SearchResult> (*)(const Model&, const Control&, const SearchRules&);
struct Kind {
    Find find;
    double tilt;                       // [deg] of the model
    double (*answer)(double, double);  // of friction and that tilt, both [rad]

    double at(double friction) const { return answer(radians(friction), radians(tilt)); }
};
const Kind kKinds[] = {
    {criticalAngle, 0, [](double phi, double) { return phi; }},
    {safetyFactor, 10, [](double phi, double tilt) { return std::tan(phi) / std::tan(tilt); }},
    {criticalAcceleration, 5, [](double phi, double tilt) { return std::tan(phi - tilt); }}};

}  // namespace

TEST_SUITE("slow: physics") {
    TEST_CASE("among many blocks one of too little mass is removed near the load at which it slides") {
        const std::vector<Slick> slick = {{24, 0.2}, {20, 0.1}, {28, 0.3}, {24.2, 0.05}};
        for (const Kind& kind : kKinds) {
            CAPTURE(kind.tilt);
            Model model = field(slick, kind.tilt);
            const SearchResult first = *kind.find(model, {}, {});
            CHECK(first.answer == doctest::Approx(kind.at(20)).epsilon(0.002));
            CHECK(first.moving_blocks == std::vector<std::string>{"s1"});
            model.analysis.least_mass_share = 0.01;
            const SearchResult result = *kind.find(model, {}, {});
            CHECK((result.status == SearchStatus::found));
            CHECK(result.answer == doctest::Approx(kind.at(kFriction)).epsilon(0.002));
            CHECK(result.moving_blocks.size() == static_cast<std::size_t>(kRows * kColumns));
            std::vector<std::string> gone;
            for (const BlockGroup& group : result.removed_groups)
                for (const std::string& name : group.blocks) {
                    CAPTURE(name);
                    const double exact = kind.at(slick[static_cast<std::size_t>(name[1] - '0')].friction);
                    CHECK(group.low <= 1.002 * exact);  // as exactly as a search without removals
                    CHECK(group.high >= 0.998 * exact);
                    CHECK(group.high - group.low < 0.1 * exact);
                    gone.push_back(name);
                }
            std::sort(gone.begin(), gone.end());
            CHECK(gone == std::vector<std::string>{"s0", "s1", "s2", "s3"});
        }
    }

    TEST_CASE("with any bracket and any interruption the search reports its results so far") {
        for (const Kind& kind : kKinds) {
            CAPTURE(kind.tilt);
            Model model = field({{20, 0.1}}, kind.tilt);
            model.analysis.least_mass_share = 0.01;
            model.analysis.tolerance = radians(0.5);
            model.analysis.factor_tolerance = 0.05;
            model.analysis.acceleration_tolerance = 0.01;
            for (const int after : {0, 1, 2, 3, 5, 8, 13, 21}) {  // reports of the path
                CAPTURE(after);
                std::atomic<bool> stop = false;
                bool begun_late = false;
                int left = after;
                Control control;
                control.stop = &stop;
                control.progress = [&](const Progress& progress) {
                    begun_late = begun_late || (stop && progress.stage != "path");
                    if (progress.stage == "path" && left-- == 0) stop = true;
                };
                const SearchResult result = *kind.find(model, control, {});
                CHECK(!begun_late);  // nothing is begun after the stop
                CHECK((result.status == SearchStatus::interrupted ||
                       (!stop && result.status == SearchStatus::found)));
                CHECK(result.low <= kind.at(kFriction));
                CHECK(result.high >= kind.at(result.removed_groups.empty() ? 20 : kFriction));
            }
        }
    }

    TEST_CASE("many small blocks that fail together are the answer") {
        const std::vector<Slick> together(20, {25, 0.2});  // each has a thousandth of the mass
        for (const Kind& kind : kKinds) {
            CAPTURE(kind.tilt);
            for (const double share : {0.0, 0.01, 0.03}) {
                CAPTURE(share);
                Model model = field(together, kind.tilt);
                model.analysis.least_mass_share = share;
                const SearchResult result = *kind.find(model, {}, {});
                CHECK((result.status == SearchStatus::found));
                CHECK(result.answer ==
                      doctest::Approx(kind.at(share < 0.02 ? 25 : kFriction)).epsilon(0.002));
                CHECK(result.moving_blocks.size() == (share < 0.02 ? 20 : 1024));
                CHECK(leftOut(result).size() == (share < 0.02 ? 0 : 20));
            }
        }
    }
}
