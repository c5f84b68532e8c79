// Fixed blocks that touch are one body. A block that slides over blocks whose tops are level is pressed into
// its joint; it must not hang on the edge between them, however soft the joint is.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/models.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kFriction = 27.0;  // [deg]

/// A block 1 m long on level ground that is cut in two at a distance behind its front [m].
Model overSeam(double stiffness, double behind_front) {
    Model model;
    model.joints = {joint(kFriction, stiffness)};
    model.blocks = {box("ahead", {-3, 0, -1}, {behind_front, 1, 0}, 2700, Motion::fixed),
                    box("below", {behind_front, 0, -1}, {3, 1, 0}, 2700, Motion::fixed)};
    addBox(model, "block", {0, 0, 0}, {1, 1, 0.5});
    return model;
}

/// Fixed blocks side by side: the column's step, one in front whose top is level with its bed, a higher one
/// behind.
Model onSteps(double stiffness, double rise) {
    Model model;
    model.joints = {joint(kFriction, stiffness)};
    const double tops[]{0, 0, rise};
    for (const int k : {0, 1, 2})
        model.blocks.push_back(
            box("step" + std::to_string(k), {k - 1.0, 0, -1}, {k + 0.0, 1, tops[k]}, 2700, Motion::fixed));
    addBox(model, "column", {0, 0, 0}, {1, 1, 5});
    return model;
}

SearchResult found(const Result<SearchResult>& result) {
    REQUIRE(result.ok());
    CHECK((result->status == SearchStatus::found));
    return *result;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a block slides over the edge between two fixed blocks as over one") {
        for (const double stiffness : {1e7, 1e8, 1e9, 1e10})
            for (const double behind_front : {-0.25, 0.0, 1e-4, 0.3}) {
                CAPTURE(stiffness);
                CAPTURE(behind_front);
                Model model = overSeam(stiffness, behind_front);
                const SearchResult at = found(criticalAngle(model));
                CHECK(degrees(at.answer) == doctest::Approx(kFriction).epsilon(1e-3));
                CHECK((at.mode == FailureMode::sliding));
                model.gravity.tilt = radians(20);
                const double expected = std::tan(radians(kFriction)) / std::tan(radians(20));
                CHECK(found(safetyFactor(model)).answer == doctest::Approx(expected).epsilon(2e-3));
            }
    }

    TEST_CASE("a column that has sunk into the joint of its step slides out over the next, level with it") {
        const double overturns = std::atan2(1, 5.0);  // near it, its front carries all of its weight
        for (const double stiffness : {1e8, 3e8, 1e9, 3e9})
            for (const double rise : {0.0, 0.2})
                for (const double share : {0.6, 0.9, 0.95}) {
                    CAPTURE(stiffness);
                    CAPTURE(rise);
                    CAPTURE(share);
                    Model model = onSteps(stiffness, rise);
                    model.gravity.tilt = share * overturns;
                    const auto result = safetyFactor(model);
                    REQUIRE(result.ok());
                    if (result->status == SearchStatus::unstable_at_start) continue;  // it has overturned
                    const double expected = std::tan(radians(kFriction)) / std::tan(model.gravity.tilt);
                    CHECK(found(result).answer == doctest::Approx(expected).epsilon(2e-3));
                }
    }
}
