// The water bag on the paper's page, on a slope of two columns.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cli/json.h"
#include "reproduction/bag.h"
#include "reproduction/bag_page.h"
#include "reproduction/results.h"
#include "support/files.h"
#include "tools/reproduction/samples.h"

using namespace talus;
using namespace talus::tools;
using test::contentOf;
using test::TemporaryFolder;

namespace {

constexpr double kLength = 0.2, kHeight = 0.1, kDensity = 2700, kDepth = 0.07, kOpening = 0.005;

const char* const kSlope =
    "[analysis]\nstart_deg = 0.0\n[material.rock]\ndensity = 2700.0\n"
    "[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 19.5\n"
    "[[stack]]\ncolumns = 2\nrows = 1\nslices = 2\nblock = [0.2, 0.1, 0.1]\n"
    "[[water]]\nfissure = 1\ndepth = 0.07\n";

/// Limit equilibrium of the column in front: tan(tilt) = tan(phi) - rho_w H^2 / (2 rho x h).
double limitDeg() {
    return degrees(
        std::atan(std::tan(radians(19.5)) - 1000 * kDepth * kDepth / (2 * kDensity * kLength * kHeight)));
}

Common quiet() {
    Common common;
    common.quiet = true;
    return common;
}

}  // namespace

TEST_CASE("a held level drives the slope on; a bag empties into the fissure and lets it stop") {
    const TemporaryFolder folder;
    std::vector<BagRun> runs = bagRuns(kSlope, 1, limitDeg() + 0.3);
    REQUIRE(runs.size() == 3);
    for (BagRun& bag : runs) {
        bag.file = folder / (bag.id + ".mcap");
        playBagRun(bag, quiet(), {});
        CHECK(bag.run.slides == std::vector<std::string>{"c1r1s1"});
        CHECK(bag.run.stays == std::vector<std::string>{"c2r1s1"});
        CHECK(bag.history.front().level == doctest::Approx(kDepth));
    }
    const auto [held, bag, supply] =
        std::array{runs[0].history.back(), runs[1].history.back(), runs[2].history.back()};
    CHECK(held.level == kDepth);
    CHECK(held.speed > 0.01);
    CHECK(bag.speed < 1e-6);
    // The volume is kept: H (opening + gap) = H0 opening, where the gap is the displacement.
    CHECK(bag.level == doctest::Approx(kDepth * kOpening / (kOpening + bag.displacement)).epsilon(1e-3));
    CHECK(bag.displacement < 0.2 * supply.displacement);
    CHECK(supply.displacement < held.displacement);
}

TEST_CASE("the page has plots, ends and links of the water bag, or says how to get them") {
    PaperResults results = samples::results();
    CHECK(bagSection(results)["blocks"][0]["text"].get<std::string>().find("--keep-run") !=
          std::string::npos);
    CHECK(bagJson(results.bag).empty());
    results.bag = bagRuns(kSlope, 1, 10.0);
    for (BagRun& bag : results.bag)
        bag.history = {{0, 0.35, 0, 0}, {1, 0.30, 1e-3, 2e-3}, {2, 0.32, 1.2e-3, 0}};
    CHECK(bagJson(results.bag)[1]["lowest_level_m"] == 0.30);
    CHECK(bagCsv(results.bag, "").find("supply,1,0.3,0.001,0.002\n") != std::string::npos);
    CHECK(plotBagLevel(results.bag).series.size() == 3);
    CHECK(plotBagDisplacement(results.bag).series[2].rows[1][1] == doctest::Approx(1.0));
}
