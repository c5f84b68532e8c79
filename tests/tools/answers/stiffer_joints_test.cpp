// What becomes of an answer above its ceiling.

#include "answers/stiffer_joints.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::tools;

namespace {

constexpr double kGiven = 1e9;  // Pa/m

formats::Scenario scenarioOf(double stiffness) {
    formats::Scenario scenario;
    Joint joint;
    joint.normal_stiffness = stiffness;
    joint.shear_stiffness = 0.1 * stiffness;
    scenario.model.joints = {joint, joint};
    return scenario;
}

SearchResult standsAt(double factor) {
    SearchResult result;
    result.status = SearchStatus::found;
    result.low = factor;
    result.high = 1.001 * factor;
    result.answer = 1.0005 * factor;
    result.steps = 100;
    result.factors = 10;
    result.wall_seconds = 1;
    result.probes.resize(2);
    result.probes[0].verdict = Verdict::stable;
    result.probes[0].displacement = 0.2;
    result.probes[1].verdict = Verdict::failing;
    result.probes[1].displacement = 9;
    return result;
}

/// A slope that stands above 1 by as much as its joints give.
double softened(const Model& model) { return 1 + 0.3 * kGiven / model.joints[0].normal_stiffness; }
using Find = Result<SearchResult> (*)(const Model&, const Control&, const QuasiStatic&);

Result<SearchResult> findSoftened(const Model& model, const Control&, const QuasiStatic&) {
    return standsAt(softened(model));
}
Result<SearchResult> findUnlessStiff(const Model& model, const Control&, const QuasiStatic&) {
    if (model.joints[0].normal_stiffness > 500 * kGiven) return Error{"", "too stiff"};
    return standsAt(softened(model));
}
Result<SearchResult> findHigh(const Model&, const Control&, const QuasiStatic&) { return standsAt(1.3); }
Result<SearchResult> findUndecided(const Model& model, const Control&, const QuasiStatic&) {
    SearchResult result = standsAt(softened(model));
    if (model.joints[0].normal_stiffness > kGiven) result.status = SearchStatus::undecided;
    return result;
}

CeiledAnswer held(Find find, SearchResult given, double ceiling, const Control& control = {},
                  double stiffness = kGiven) {
    LoadSearch search = *loadSearch("safety-factor");
    search.find = find;
    return heldUnderCeiling(
        search, scenarioOf(stiffness), std::move(given),
        [&](const formats::Scenario&, const SearchResult&) {
            return Ceiling{ceiling, ""};
        },
        control);
}

bool says(const SearchResult& result, const std::string& text) {
    return result.warnings.size() == 1 && result.warnings[0].find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("an answer that is not above its ceiling stays as it is") {
    for (const double ceiling : {1.3, 1.2945, 5.0}) {
        const CeiledAnswer answer = held(findHigh, standsAt(1.3), ceiling);
        CHECK((answer.result.status == SearchStatus::found));
        CHECK(answer.result.low == 1.3);
        CHECK(answer.result.steps == 100);
        CHECK(answer.result.warnings.empty());
        CHECK(answer.stiffness == 1);
        CHECK(*answer.ceiling.value == ceiling);
    }
}

TEST_CASE(
    "an answer above its ceiling is that of joints with which blocks stay where they were built, and says "
    "both") {
    const CeiledAnswer answer = held(findSoftened, standsAt(1.3), 1.0);
    CHECK((answer.result.status == SearchStatus::found));
    CHECK(answer.stiffness == 1000);
    CHECK(answer.result.low == doctest::Approx(1.0003));
    CHECK(answer.result.steps == 200);
    CHECK(answer.result.factors == 20);
    CHECK(answer.result.wall_seconds == 2);
    CHECK(says(answer.result, "1000 times the stiffness given"));
    CHECK(says(answer.result, "move by 0.20 m"));
    CHECK(says(answer.result, "stands at factor 1.3000, above the ceiling"));
    CHECK_FALSE(answer.result.range);
}

TEST_CASE("joints so stiff that the search or a scenario refuses them are not taken") {
    CHECK(held(findUnlessStiff, standsAt(1.3), 1.0).stiffness == 100);
    CHECK((held(findUnlessStiff, standsAt(1.3), 1.0).result.status == SearchStatus::found));
    const double most = propertyOf(&Joint::normal_stiffness).allowed.max;
    const CeiledAnswer none = held(findSoftened, standsAt(1.3), 1.0, {}, 0.5 * most);
    CHECK((none.result.status == SearchStatus::undecided));
    CHECK(none.stiffness == 1);
}

TEST_CASE("an answer that is above its ceiling with stiffer joints, or undecided, is wrong") {
    for (const Find find : {findHigh, findUndecided}) {
        const CeiledAnswer answer = held(find, standsAt(1.3), 1.0);
        CHECK((answer.result.status == SearchStatus::undecided));
        CHECK(answer.stiffness == 1);
        CHECK(says(answer.result, "the answer is wrong"));
        CHECK(answer.result.steps == 400);  // of all four searches
    }
}

TEST_CASE("the range of softer joints' answers is kept where it begins below") {
    SearchResult given = standsAt(1.3);
    given.range = {0.9, 1.3};
    given.range_reason = "friction remembers";
    const CeiledAnswer answer = held(findSoftened, given, 1.0);
    REQUIRE(answer.result.range);
    CHECK(answer.result.range->first == 0.9);
    CHECK(answer.result.range->second == answer.result.answer);
    CHECK(answer.result.range_reason.find("factor 0.9000 with joints as soft as given") == 0);
    CHECK(says(answer.result, "count on the lower end"));

    given.range = {1.2, 1.3};
    CHECK_FALSE(held(findSoftened, given, 1.0).result.range);
}

TEST_CASE("a search that is stopped before stiffer joints have answered is interrupted") {
    std::atomic<bool> stop{true};
    Control control;
    control.stop = &stop;
    const CeiledAnswer answer = held(findSoftened, standsAt(1.3), 1.0, control);
    CHECK((answer.result.status == SearchStatus::interrupted));
    CHECK(answer.result.warnings.empty());
    CHECK_FALSE(answer.ceiling.value);
    CHECK(answer.stiffness == 1);
}
