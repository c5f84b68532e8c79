#include <doctest/doctest.h>

#include <atomic>
#include <set>

#include "reproduction/cases.h"
#include "reproduction/laboratory.h"
#include "reproduction/run.h"
#include "reproduction/scenario_text.h"
#include "talus/simulation.h"
#include "tools/reproduction/samples.h"

using namespace talus;
using namespace talus::tools;

namespace {

/// Stands in for the engine: the friction angle is the answer, the steps say which model it was.
Result<SearchResult> frictionAsAnswer(const Model& model, const Control& control) {
    if (control.progress) control.progress({"probe 1", 0.5, ""});
    SearchResult result;
    result.status = SearchStatus::found;
    result.answer = model.joints.front().friction;
    result.steps = static_cast<std::int64_t>(model.blocks.size());
    return result;
}

std::vector<PaperCase> threeCases() {
    std::vector<PaperCase> cases;
    for (const int fissure : {1, 2, 3}) {
        cases.push_back(samples::paperCase(PaperGroup::table, std::to_string(fissure), {fissure}, 19.5));
        cases.back().scenario.model.joints.front().friction = radians(10 * fissure);
        cases.back().scenario.model.blocks.resize(static_cast<std::size_t>(fissure));
    }
    return cases;
}

}  // namespace

TEST_CASE("a value of a scenario's text is replaced, added to its table, or added with its table") {
    const std::string text = "[a]\nx = 1  # one\n\n[[b]]\ny=2\n[[b]]\ny = 3\n";
    CHECK(withValue(text, "[a]", "x", "5") == "[a]\nx = 5  # one\n\n[[b]]\ny=2\n[[b]]\ny = 3\n");
    CHECK(withValue(text, "[[b]]", "y", "5") == "[a]\nx = 1  # one\n\n[[b]]\ny = 5\n[[b]]\ny = 3\n");
    CHECK(withValue(text, "[a]", "y", "5") == "[a]\ny = 5\nx = 1  # one\n\n[[b]]\ny=2\n[[b]]\ny = 3\n");
    CHECK(withValue(text, "[c]", "z", "\"w\"") == text + "\n[c]\nz = \"w\"\n");
}

TEST_CASE("the cases are Table 1, section 5, the study of contact points and quarter points with water") {
    const auto cases = paperCases("vertex");
    REQUIRE(cases.size() == 41);
    std::set<std::string> files;
    for (const PaperCase& what : cases) {
        CAPTURE(what.name);
        CHECK(files.insert(fileName(what)).second);
        CHECK(checkModel(what.scenario.model).empty());
        CHECK(what.theory.has_value());
    }
    CHECK(cases.front().name == "dry");
    CHECK(cases.front().friction_deg == 18.0);
    CHECK(cases[20].name == "fissure-6");
    CHECK(cases[20].friction_deg == 21.0);
    CHECK(cases[22].fissures == std::vector{7, 8, 9, 10});
    CHECK(cases[23].points == "quarter");
    CHECK(cases[34].points == "grid 10");
    CHECK(cases.back().name == "quarter-fissure-6");
}

TEST_CASE("the built-in scenarios say what the cases' labels say") {
    for (const PaperCase& what : paperCases("corner")) {
        CAPTURE(what.name);
        const Model& model = what.scenario.model;
        const bool study = what.group == PaperGroup::points || what.group == PaperGroup::quarter_water;
        REQUIRE(model.stack.has_value());
        CHECK(model.stack->slices == (study ? 1 : 3));
        CHECK(model.stack->columns == (what.group == PaperGroup::section5 ? 12 : 7));
        CHECK(model.joints.front().friction == doctest::Approx(radians(what.friction_deg)));
        CHECK(model.joints.front().residual_friction == doctest::Approx(radians(what.friction_deg)));
        if (!study) CHECK(model.points.kind == PointRule::Kind::corner);
        REQUIRE(model.waters.size() == what.fissures.size());
        for (std::size_t i = 0; i < model.waters.size(); ++i) {
            const Water& water = model.waters[i];
            CHECK(water.level.front().value == kLaboratoryWaterDepth);
            REQUIRE_FALSE(water.walls.empty());
            const WetFace& wall = water.walls.front();
            const auto& shape = model.blocks[static_cast<std::size_t>(wall.block)].shape;
            CHECK(shape.faceCentroid(static_cast<std::size_t>(wall.face)).x() ==
                  doctest::Approx(0.2 * what.fissures[i]));
        }
    }
}

TEST_CASE("the theory of the cases is the exact limit of the verification table") {
    const std::array<double, 21> expected{18.00, 19.50, 21.00, 5.60,  7.25,  8.92,  11.94,
                                          13.53, 15.13, 14.00, 15.56, 17.13, 15.01, 16.56,
                                          18.12, 15.62, 17.16, 18.70, 16.02, 17.55, 19.09};
    const auto cases = paperCases("vertex");
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(cases[i].name);
        CHECK(std::abs(degrees(cases[i].theory->critical_tilt) - expected[i]) < 0.006);
    }
    CHECK(std::abs(degrees(cases[21].theory->critical_tilt) - 17.83) < 0.006);
    CHECK(std::abs(degrees(cases[22].theory->critical_tilt) - 17.83) < 0.006);
}

TEST_CASE("a rule of contact points that is none is refused") {
    for (const char* rule : {"middle", "grid", "grid 0", "vertex\"\n[x]", ""}) {
        CAPTURE(rule);
        CHECK_THROWS_AS(paperCases(rule), BadInput);
    }
    CHECK(paperCases("grid 4").front().points == "grid 4");
}

TEST_CASE("runs are reported in the order of the cases, on one thread and on two") {
    for (const int threads : {1, 2}) {
        std::atomic<bool> stop{false};
        std::size_t last = 0;
        double fraction = 0;
        const auto runs =
            runCases(threeCases(), frictionAsAnswer, threads, stop, [&](const PaperProgress& progress) {
                CHECK(progress.done >= last);
                CHECK(progress.fraction >= fraction);
                last = progress.done;
                fraction = progress.fraction;
            });
        REQUIRE(runs.size() == 3);
        CHECK(last == 3);
        CHECK(fraction == doctest::Approx(1));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(*criticalDeg(runs[i]) == doctest::Approx(10.0 * static_cast<double>(i + 1)));
            CHECK(runs[i].search.steps == static_cast<std::int64_t>(i + 1));
        }
    }
}

TEST_CASE("costly cases begin first") {
    std::vector<std::size_t> begun;
    const std::atomic<bool> stop{false};
    runCases(threeCases(),
             [&](const Model& model, const Control& control) {
                 begun.push_back(model.blocks.size());
                 return frictionAsAnswer(model, control);
             },
             1, stop, {});
    CHECK(begun == std::vector<std::size_t>{3, 2, 1});
}

TEST_CASE("after a stop nothing new begins, and what was finished stays") {
    std::atomic<bool> stop{false};
    const auto runs = runCases(threeCases(),
                               [&](const Model& model, const Control& control) {
                                   auto result = frictionAsAnswer(model, control);
                                   stop = true;
                                   return result;
                               },
                               1, stop, {});
    CHECK(statusText(runs[0]) == "not_run");
    CHECK(statusText(runs[1]) == "not_run");
    CHECK(*criticalDeg(runs[2]) == doctest::Approx(30));
}

TEST_CASE("a case the engine refuses does not keep the others from being computed") {
    const std::atomic<bool> stop{false};
    const auto runs = runCases(threeCases(),
                               [](const Model& model, const Control& control) -> Result<SearchResult> {
                                   if (model.blocks.size() == 2) return Error{"stack[0]", "refused"};
                                   return frictionAsAnswer(model, control);
                               },
                               2, stop, {});
    CHECK(criticalDeg(runs[0]).has_value());
    CHECK(statusText(runs[1]) == "failed");
    REQUIRE(runs[1].errors.size() == 1);
    CHECK(runs[1].errors.front().field == "stack[0]");
    CHECK(criticalDeg(runs[2]).has_value());
}
