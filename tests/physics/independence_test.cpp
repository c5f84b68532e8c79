// The answer is a property of the slope: not of the steps along the path, nor of how a release is made.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "support/models.h"
#include "support/rock_slopes.h"
#include "support/verification.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

// The answer, and nothing beside it.
const Control kAlone{.interval = false, .upper_bound = Beside::never};

struct Variant {
    const char* name;
    SearchRules rules;
};

const Variant kVariants[] = {
    {"default", {}},
    {"half the displacement in a step", {.step_displacement = 5e-4}},
    {"a fifth of the load in a step", {.step_tilt = 0.01, .step_factor = 0.05, .step_acceleration = 0.006}},
    {"ten times the accuracy", {.equilibrium_tolerance = 1e-3}},
    {"ten times the drag in a release", {.release_drag = 1e-2}},
    {"shorter steps of a release", {.release_growth = 2}},
    {"another start", {.first_step = 0.1}},
};

/// Spread of the answers over the variants [same unit], printed with each.
template <class Analysis>
double spread(const Model& model, const Analysis& analysis, double unit) {
    double low = kInfinity, high = -kInfinity;
    for (const Variant& variant : kVariants) {
        const SearchResult result = *analysis(model, kAlone, variant.rules);
        MESSAGE(std::string(variant.name)
                << ": " << result.answer * unit << " " << std::string(toString(result.mode)) << ", "
                << result.steps << " steps");
        CHECK((result.status == SearchStatus::found));
        low = std::min(low, result.answer);
        high = std::max(high, result.answer);
    }
    return (high - low) * unit;
}

}  // namespace

TEST_SUITE("slow: physics") {
    TEST_CASE("critical angle: sliding with water, toppling, leaning columns") {
        Model wet = stackModel(4, 5, 1, 19.5);
        wet.waters = {fissureAt(wet, 0.4, 0.35)};
        Model toppling = stackModel(1, 5, 1, 30);
        Model leaning = stackModel(4, 5, 1, 30, {0.1, 0.1, 0.1});
        for (Model* model : {&wet, &toppling, &leaning}) {
            model->analysis.start = 0;
            CHECK(spread(*model, criticalAngle, 180 / M_PI) <= 0.0101);
        }
    }

    // 14 columns of one to ten blocks leap from equilibrium to equilibrium before they fail, and which leap
    // is the failure depends on where the steps before it ended.
    // It falls between 8.24 and 8.72 degrees: a known fault of the search, which is why this may fail.
    TEST_CASE("a tilting table of leaning columns fails at one angle, wherever the search begins" *
              doctest::may_fail()) {
        Model model = verification("barla-table");
        double low = kInfinity, high = -kInfinity;
        for (const double start_deg : {0.0, 1.0, 2.0, 3.3, 5.0}) {
            CAPTURE(start_deg);
            model.analysis.start = radians(start_deg);
            const SearchResult found = *criticalAngle(model, kAlone);
            MESSAGE("from " << start_deg << ": " << degrees(found.answer) << " degrees");
            CHECK((found.status == SearchStatus::found));
            low = std::min(low, degrees(found.answer));
            high = std::max(high, degrees(found.answer));
        }
        CHECK(high - low < 0.03);
    }

    // Above a thousand free blocks a load step is as long as blocks hardly part in one.
    TEST_CASE("a row of many columns topples at the load at which one does") {
        const Vec3 size(0.2, 0.02, 0.1);
        const Model one = stackModel(1, 5, 1, 30, size), many = stackModel(1, 5, 210, 30, size);
        using Search = Result<SearchResult> (*)(const Model&, const Control&, const SearchRules&);
        for (const Search search : {Search(criticalAngle), Search(criticalAcceleration)}) {
            const SearchResult alone = *search(one, kAlone, {}), together = *search(many, kAlone, {});
            MESSAGE(alone.answer << " and " << together.answer << ", " << together.probes.size()
                                 << " points, " << together.factors << " factorisations");
            CHECK((together.status == SearchStatus::found));
            CHECK(together.answer == doctest::Approx(alone.answer).epsilon(0.005));
        }
    }

    TEST_CASE("factor of safety") {
        Model model = stackModel(4, 5, 1, 25);
        model.gravity.tilt = radians(10);
        model.waters = {fissureAt(model, 0.4, 0.35)};
        CHECK(spread(model, safetyFactor, 1.0) <= 0.00101);
    }

    // Columns that lean and lose their cohesion one after the other creep from some load on: a little in each
    // step, however short. With 0.001 degrees it is undecided: a known fault.
    TEST_CASE("columns whose bonds break as they lean fail at one angle, however narrow the bracket" *
              doctest::may_fail()) {
        RockSlope slope = uprightColumns();
        slope.cohesion = 18531;
        Model model = scenarioOf(slope).model;
        double low = kInfinity, high = -kInfinity;
        for (const double tolerance_deg : {0.05, 0.01, 0.005, 0.001}) {
            model.analysis.tolerance = radians(tolerance_deg);
            const SearchResult found = *criticalAngle(model, kAlone);
            MESSAGE(tolerance_deg << " deg wide: " << degrees(found.answer));
            CHECK((found.status == SearchStatus::found));
            CHECK(found.high - found.low <= model.analysis.tolerance * (1 + 1e-9));
            low = std::min(low, found.answer);
            high = std::max(high, found.answer);
        }
        CHECK(high < 1.02 * low);
    }

    TEST_CASE("brittle cohesion: the spread is stated, and small") {
        Model model = floorModel(30, 1e10);
        model.joints[0].cohesion = 2000;
        addBox(model, "body", {0, 0, 0}, {1, 1, 0.5}, 2000);
        model.analysis.start = 0;
        const double width = spread(model, criticalAngle, 180 / M_PI);
        MESSAGE("spread of the brittle answer: " << width << " deg");
        CHECK(width < 0.25);
    }
}
