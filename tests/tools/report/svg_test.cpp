// Plots as files: axes that end at ticks.

#include "report/svg.h"

#include <doctest/doctest.h>

using namespace talus::tools;

TEST_CASE("an axis ends at ticks that are round numbers, with as many decimals as they need") {
    const PlotAxis axis = axisOver("tilt", 0, 17.4, 8);
    CHECK(axis.step == doctest::Approx(2));
    CHECK(axis.domain.front() == doctest::Approx(0));
    CHECK(axis.domain.back() == doctest::Approx(18));
    CHECK(axis.decimals == 0);
    const PlotAxis fine = axisOver("k", 0.0512, 0.0534, 5);
    CHECK(fine.decimals == 4);
    CHECK(fine.domain.front() <= 0.0512);
    CHECK(fine.domain.back() >= 0.0534);
}

TEST_CASE("an axis over one value has a length") {
    CHECK(axisOver("k", 3, 3, 5).domain.back() > 3);
    CHECK(axisOver("k", 0, 0, 5).domain.back() > 0);
}

TEST_CASE("words beside an upright line near the right end stand on its left") {
    Plot plot{"id", "title", "", {"x", {0, 10}, 1, 0}, {"y", {0, 1}, 0.5, 1}};
    plot.references.push_back({'x', 9.5, {}, "dots", "", "late"});
    CHECK(svgFile(plot).find("text-anchor=\"end\" class=\"small\">late<") != std::string::npos);
    plot.references.front().at = 1;
    CHECK(svgFile(plot).find("text-anchor=\"start\" class=\"small\">late<") != std::string::npos);
}
