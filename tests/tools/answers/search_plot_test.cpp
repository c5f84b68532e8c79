// The curve of a search as a plot: its units, its ticks, and what is marked on it.

#include "answers/search_plot.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "cli/text.h"
#include "report/svg.h"

using namespace talus;
using namespace talus::tools;

namespace {

SearchResult found(std::vector<PathPoint> path, double answer) {
    SearchResult result;
    result.status = SearchStatus::found;
    result.answer = answer;
    result.low = 0.999 * answer;
    result.high = 1.001 * answer;
    result.probes.resize(path.size());
    for (Probe& probe : result.probes) probe.verdict = Verdict::stable;
    if (!path.empty()) result.probes.back().verdict = Verdict::failing;
    result.path = std::move(path);
    return result;
}

const Series* seriesOf(const Plot& plot, const std::string& role, const std::string& type) {
    const auto at = std::find_if(plot.series.begin(), plot.series.end(), [&](const Series& series) {
        return series.role == role && series.type == type;
    });
    return at == plot.series.end() ? nullptr : &*at;
}

const Reference* referenceOf(const Plot& plot, const std::string& role) {
    const auto at = std::find_if(plot.references.begin(), plot.references.end(),
                                 [&](const Reference& reference) { return reference.role == role; });
    return at == plot.references.end() ? nullptr : &*at;
}

const LoadSearch& angle() { return *loadSearch("critical-angle"); }
const LoadSearch& factor() { return *loadSearch("safety-factor"); }

}  // namespace

TEST_CASE("a curve is drawn in degrees and millimetres, with answer, bracket and failure displacement") {
    const SearchResult result =
        found({{0, 0}, {radians(10), 1e-3}, {radians(20), 4e-3}, {radians(20), 9e-3}}, radians(20));
    const Plot plot = searchPlot(angle(), result, "folder/slope.toml", 5e-4);
    CHECK(plot.title == "slope.toml: critical angle 20.000 deg");
    const Series* curve = seriesOf(plot, "path", "line");
    REQUIRE(curve != nullptr);
    REQUIRE(curve->rows.size() == 4);
    CHECK(curve->rows[1][0] == doctest::Approx(1));
    CHECK(curve->rows[1][1] == doctest::Approx(10));
    CHECK(plot.x.title.ends_with("(mm)"));
    CHECK(plot.x.domain == std::vector<double>{0, 10});
    CHECK(plot.y.domain.front() == 0);
    CHECK(plot.y.domain.back() > 20);
    REQUIRE(referenceOf(plot, "answer") != nullptr);
    CHECK(referenceOf(plot, "answer")->at == doctest::Approx(20));
    CHECK(referenceOf(plot, "answer")->text ==
          "critical angle 20.000 deg: stands at 19.980, fails at 20.020");
    REQUIRE(referenceOf(plot, "dots") != nullptr);
    CHECK(referenceOf(plot, "dots")->at == doctest::Approx(0.5));
    REQUIRE(seriesOf(plot, "dem-open", "points") != nullptr);
    CHECK(seriesOf(plot, "dem-open", "points")->rows.front()[0] == doctest::Approx(9));
    const std::string svg = svgFile(plot, true);
    CHECK(svg.find(">slope.toml: critical angle 20.000 deg</text>") != std::string::npos);
    CHECK(svgFile(plot).find(">slope.toml: critical angle 20.000 deg</text>") == std::string::npos);
}

TEST_CASE("displacements of metres and of micrometres have their own units") {
    CHECK(searchPlot(angle(), found({{0, 0}, {0.1, 2.0}}, 0.1), "s", 0).x.title.ends_with("(m)"));
    CHECK(searchPlot(angle(), found({{0, 0}, {0.1, 2e-6}}, 0.1), "s", 0).x.title.ends_with("(\u00b5m)"));
}

TEST_CASE("what comes down from a greater strength is drawn apart") {
    const Plot plot =
        searchPlot(factor(), found({{0.5, 0}, {0.8, 1e-3}, {1, 2e-3}, {1, 0}, {1.1, 1e-3}, {1.2, 6e-3}}, 1.2),
                   "s.toml", 0);
    REQUIRE(seriesOf(plot, "rule", "line") != nullptr);
    CHECK(seriesOf(plot, "rule", "line")->rows.size() == 3);
    CHECK(seriesOf(plot, "path", "line")->rows.size() == 3);
    CHECK(plot.title == "s.toml: factor of safety 1.2000");
    CHECK(plot.y.title == "strengths divided by");
}

TEST_CASE(
    "the largest load at which the slope stands is marked, also where the curve has come down from it") {
    const Plot plot =
        searchPlot(factor(), found({{1, 0}, {1.5, 1e-3}, {1.4, 2e-3}, {1.3, 3e-3}}, 1.5), "s.toml", 0);
    const auto stands = std::find_if(plot.series.begin(), plot.series.end(), [](const Series& series) {
        return series.name == "largest load at which the slope stands";
    });
    REQUIRE(stands != plot.series.end());
    CHECK(stands->rows.front()[1] == doctest::Approx(1.5));
}

TEST_CASE("an interval of answers is a band; without an answer there is neither") {
    SearchResult result = found({{0, 0}, {1.2, 1e-3}}, 1.2);
    result.answer_interval = std::pair(1.1, 1.2);
    const Plot plot = searchPlot(factor(), result, "s.toml", 0);
    REQUIRE(referenceOf(plot, "band") != nullptr);
    CHECK(*referenceOf(plot, "band")->to == doctest::Approx(1.2));
    result.status = SearchStatus::stable_to_stop;
    result.answer_interval.reset();
    const Plot stands = searchPlot(factor(), result, "s.toml", 0);
    CHECK(referenceOf(stands, "band") == nullptr);
    CHECK(referenceOf(stands, "answer") == nullptr);
    CHECK(stands.title == "s.toml: factor of safety, none found");
}

TEST_CASE("the failure displacement is a share of the median block") {
    Model model;
    for (const double size : {0.1, 0.4, 2.0}) {
        Block block;
        block.shape = *makeBox(Vec3::Zero(), Vec3(3, 3, size));
        model.blocks.push_back(block);
    }
    SearchResult result;
    result.failure_displacement = 1e-3;
    CHECK(failureDisplacement(result, model) == doctest::Approx(4e-4));
}
