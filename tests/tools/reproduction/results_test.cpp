#include <doctest/doctest.h>

#include <numeric>

#include "reproduction/notes.h"
#include "reproduction/plots.h"
#include "tools/reproduction/samples.h"

using namespace talus;
using namespace talus::tools;

TEST_CASE("the laboratory's averages are those of its three tests") {
    for (const LaboratorySeries& series : kLaboratory) {
        CAPTURE(series.fissure);
        const double sum = std::accumulate(series.repeats_deg.begin(), series.repeats_deg.end(), 0.0);
        CHECK(std::abs(sum / 3 - series.average_deg) <= 0.05 + 1e-12);
    }
}

TEST_CASE("L/H is the fissure's distance from the toe over the water depth") {
    const auto ratio = [](std::vector<int> fissures) {
        return distanceOverDepth(samples::paperCase(PaperGroup::table, "", std::move(fissures), 19.5));
    };
    CHECK_FALSE(ratio({}).has_value());
    CHECK(*ratio({1}) == doctest::Approx(0.2 / 0.35));
    CHECK(*ratio({6}) == doctest::Approx(1.2 / 0.35));
    CHECK(*ratio({10, 7, 8, 9}) == doctest::Approx(4.0));
}

TEST_CASE("labels name the watered fissures") {
    const auto name = [](std::vector<int> fissures) {
        return label(samples::paperCase(PaperGroup::table, "", std::move(fissures), 19.5));
    };
    CHECK(name({}) == "dry");
    CHECK(name({3}) == "fissure 3");
    CHECK(name({7, 8, 9, 10}) == "fissures 7-10");
    CHECK(name({1, 3, 4}) == "fissures 1, 3-4");
}

TEST_CASE("moving blocks are summed up by columns and rows") {
    PaperRun run = samples::foundRun(samples::paperCase(PaperGroup::table, "", {3}, 19.5), 15);
    CHECK(movingText(run) == "columns 1-3 (15 blocks)");
    run.search.moving_blocks = {"c1r4s1", "c1r5s1"};
    CHECK(movingText(run) == "column 1, rows 4-5 (2 blocks)");
    run.search.moving_blocks = {"c12r1s1", "floor", "c1", "cxr1s1", "c1r2"};
    CHECK(movingText(run) == "column 12, row 1 (5 blocks)");
    run.search.moving_blocks.clear();
    CHECK(movingText(run) == "none");
}

TEST_CASE("a case without an answer has no angle, no differences and says why") {
    PaperRun run = samples::foundRun(samples::paperCase(PaperGroup::table, "", {3}, 19.5), 15);
    run.what.paper_deg = 15.4;
    CHECK(*criticalDeg(run) == doctest::Approx(15));
    CHECK(*lessPaper(run) == doctest::Approx(-0.4));
    CHECK(*lessTheory(run) == doctest::Approx(15 - 18.5));
    CHECK(answerText(run) == "fissure 3 phi 19.5: 15.00");
    SUBCASE("undecided") {
        run.search.status = SearchStatus::undecided;
        CHECK(statusText(run) == "undecided");
    }
    SUBCASE("interrupted") {
        run.search.status = SearchStatus::interrupted;
        CHECK(statusText(run) == "interrupted");
    }
    SUBCASE("never begun") {
        run.begun = false;
        CHECK(statusText(run) == "not_run");
    }
    SUBCASE("refused") {
        run.errors.push_back({"stack[0]", "bad"});
        CHECK(statusText(run) == "failed");
    }
    CHECK_FALSE(criticalDeg(run).has_value());
    CHECK_FALSE(lessPaper(run).has_value());
    CHECK_FALSE(lessTheory(run).has_value());
    CHECK(failureText(run).empty());
    CHECK(answerText(run) == "fissure 3 phi 19.5: " + statusText(run));
}

TEST_CASE("numbers are shown with sign, and nothing as a dash") {
    CHECK(shown(std::nullopt, 2) == "-");
    CHECK(shown(7.254, 2) == "7.25");
    CHECK(shownSigned(0.0126, 2) == "+0.01");
    CHECK(shownSigned(-0.0126, 2) == "-0.01");
    CHECK(shownSigned(-0.0004, 2) == "0.00");
    CHECK(*largest({0.1, std::nullopt, -0.3, 0.2}) == -0.3);
    CHECK_FALSE(largest({std::nullopt}).has_value());
}

TEST_CASE("costs are summed per group, costly groups and cases first") {
    PaperResults results = samples::results();
    results.runs.back().cpu_seconds = 100;
    results.runs.front().begun = false;
    const auto costs = groupCosts(results);
    REQUIRE(costs.size() == 4);
    CHECK(costs[0].group == PaperGroup::quarter_water);
    CHECK(costs[1].group == PaperGroup::table);
    CHECK(costs[1].cases == 20);
    CHECK(costs[1].steps == 20 * 1000);
    CHECK(costs[1].cpu_seconds == doctest::Approx(40));
    CHECK(costliest(results, 3).size() == 3);
    CHECK(costliest(results, 1).front() == &results.runs.back());
    CHECK(costliest(results, 1000).size() == results.runs.size() - 1);
}

TEST_CASE("friction and depth implied by a measured angle give that angle back") {
    const PaperCase what = samples::paperCase(PaperGroup::table, "", {1}, 19.5);
    theory::SlidingMass mass{0.2, 0.5, 2700, 1000, 0.35, radians(*impliedFrictionDeg(what, 4.5)), 0, 9.81};
    CHECK(degrees(theory::criticalTiltSliding(mass)) == doctest::Approx(4.5));
    mass.friction = radians(19.5);
    mass.water_depth = *impliedDepth(what, 4.5);
    CHECK(degrees(theory::criticalTiltSliding(mass)) == doctest::Approx(4.5));
    CHECK_FALSE(impliedDepth(what, 20).has_value());  // steeper than the friction angle: no water does that
    CHECK(*impliedFrictionDeg(samples::paperCase(PaperGroup::table, "", {}, 19.5), 18.4) == 18.4);
}

TEST_CASE("overturning about the outermost points of a grid") {
    CHECK(degrees(gridOverturning(0.2, 0.5, 2)) == doctest::Approx(11.31).epsilon(1e-3));
    CHECK(degrees(gridOverturning(0.2, 0.5, 4)) == doctest::Approx(16.70).epsilon(1e-3));
    CHECK(degrees(gridOverturning(0.2, 0.5, 1'000'000)) == doctest::Approx(21.80).epsilon(1e-3));
}

TEST_CASE("the main result counts what was found") {
    PaperResults results = samples::results();
    CHECK(mainResult(results).find("in all 23 cases") != std::string::npos);
    CHECK(mainResult(results).find("within 0.00\u00b0 of the laboratory") != std::string::npos);
    results.runs.front().begun = false;
    CHECK(mainResult(results).find("in 22 of the 23 cases") != std::string::npos);
    results.runs.clear();
    CHECK(mainResult(results) == "No case was completed.");
}
