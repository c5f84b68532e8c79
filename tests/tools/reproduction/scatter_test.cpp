// The laboratory's scatter: what is computed, and what the page says of it.

#include "reproduction/scatter.h"

#include <doctest/doctest.h>

#include "cli/json.h"
#include "support/files.h"

namespace talus::tools {

namespace {

Scatter madeUp() {
    Scatter scatter;
    scatter.samples = 3;
    scatter.complete = true;
    scatter.cases.push_back({0, {18.9, 18.3, 18.1}, 3, 0, {18.0, 18.2, 18.4}});
    scatter.cases.push_back({1, {4.5, 4.6, 4.3}, 3, 3, {}});
    return scatter;
}

}  // namespace

TEST_CASE("scatter: table and JSON count the laboratory tests within the samples") {
    const Json blocks = scatterSection(madeUp())["blocks"];
    CHECK(blocks.back()["rows"][0].back() == "2 of 3");  // 18.3 and 18.1 lie between 18.02 and 18.38
    CHECK(blocks.back()["rows"][1].back().is_null());
    const Plot plot = plotScatter(madeUp());
    REQUIRE(plot.series[0].rows.size() == 1);  // fissure 1 has no answers
    CHECK(plot.series[0].rows[0][3] == doctest::Approx(18.2));
    CHECK(plot.series[1].rows.size() == 6);
    const Json json = scatterJson(madeUp());
    CHECK(json["cases"][0]["mean_deg"] == doctest::Approx(18.2));
    CHECK(json["cases"][0]["fissure"].is_null());
    CHECK(json["cases"][1]["mean_deg"].is_null());
    CHECK(json["cases"][1]["without_answer"] == 3);
}

TEST_SUITE("slow: paper") {
    TEST_CASE("one sample of the laboratory's scatter lies between the limits of 18 and 21 deg") {
        const test::TemporaryFolder folder;
        Common common;
        common.quiet = true;
        const Scatter scatter = computeScatter(1, folder / "scatter", common);
        REQUIRE(scatter.complete);
        REQUIRE(scatter.cases.size() == 7);
        for (const ScatterCase& one : scatter.cases) {
            CAPTURE(one.fissure);
            REQUIRE(one.angles_deg.size() == 1);
            CHECK(one.angles_deg[0] > 5.4);  // fissure 1 at 18 deg, limit equilibrium 5.49 deg
            CHECK(one.angles_deg[0] < 21);
        }
        CHECK(scatter.cases[0].angles_deg[0] >= 18);
        CHECK(scatter.cases[1].angles_deg[0] < scatter.cases[2].angles_deg[0]);
        // Called again it computes nothing: the processor time is that of the rows there are.
        CHECK(computeScatter(1, folder / "scatter", common).cpu_seconds == scatter.cpu_seconds);
    }
}

}  // namespace talus::tools
