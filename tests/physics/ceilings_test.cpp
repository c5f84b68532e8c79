// Limit analysis of the scenarios under bench/verification beside the figures of the literature: exact where
// blocks hinge or slide on their base, an upper bound where they lean on each other.

#include <doctest/doctest.h>

#include <string>

#include "support/models.h"
#include "support/verification.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

LimitResult limitOf(const std::string& name, Varied load) {
    CAPTURE(name);
    const auto scenario = formats::readScenario(TALUS_SOURCE_DIR "/bench/verification/" + name + ".toml");
    REQUIRE(scenario.ok());
    const auto result = limitAnalysis(scenario->model, load);
    REQUIRE(result.ok());
    return *result;
}

/// A figure [deg, or none] within a share of what is published.
void checkFigure(const std::string& name, Varied load, double published, double share) {
    const LimitResult result = limitOf(name, load);
    const double unit = load == Varied::tilt ? radians(1) : 1;
    MESSAGE(name << ": " << result.lower / unit << " to " << result.upper / unit << ", published "
                 << published);
    CHECK((result.status == SearchStatus::found));
    CHECK(result.lower / unit == doctest::Approx(published).epsilon(share));
    CHECK(result.upper / unit == doctest::Approx(published).epsilon(share));
}

/// At or above what a non-associated analysis found, and not by more than a share.
void checkCeiling(const std::string& name, Varied load, double published, double share) {
    const LimitResult result = limitOf(name, load);
    const double unit = load == Varied::tilt ? radians(1) : 1;
    MESSAGE(name << ": ceiling " << result.upper / unit << ", published " << published);
    CHECK((result.status == SearchStatus::found));
    CHECK(result.upper / unit >= published);
    CHECK(result.lower / unit <= published * (1 + share));
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("limit analysis: arches, walls, single columns, slabs") {
        checkFigure("arch-27-1.1m", Varied::tilt, 0.70, 0.01);
        checkFigure("arch-27-1.5m", Varied::tilt, 8.27, 1e-3);
        CHECK((limitOf("arch-27-1.05m", Varied::tilt).status == SearchStatus::unstable_at_start));
        checkFigure("brick-wall-1", Varied::horizontal, 0.6429, 1e-4);
        checkFigure("brick-wall-2", Varied::horizontal, 0.5800, 1e-4);
        checkFigure("column-10", Varied::tilt, degrees(std::atan(0.2)), 1e-6);
        checkFigure("column-20", Varied::tilt, degrees(std::atan(0.1)), 1e-6);
        checkFigure("column-40", Varied::tilt, degrees(std::atan(0.05)), 1e-6);
        checkFigure("alejano-slab-50", Varied::factor, 1.2148, 2e-4);
        checkFigure("alejano-slab-55", Varied::factor, 1.0002, 2e-3);
        checkFigure("parallel-slabs", Varied::factor, 1.008, 1e-3);
        checkFigure("goodman-bray-slice-38.15", Varied::factor, 1.19, 2e-3);
    }

    TEST_CASE("limit analysis: no analysis of real joints is above it") {
        checkCeiling("column-40-10-deep", Varied::tilt, degrees(std::atan(0.05)), 1.0);
        checkCeiling("goodman-bray-slice-38.6598", Varied::factor, 1.0185, 0.25);
        checkCeiling("alejano-alonso", Varied::factor, 0.87, 0.3);
        checkCeiling("barla-table", Varied::tilt, 11, 1.0);
        checkCeiling("bilinear-slab", Varied::factor, 1.03, 0.02);
        checkCeiling("forward-toppling", Varied::factor, 1.13, 0.4);
        checkCeiling("backward-toppling", Varied::factor, 1.80, 0.02);
        checkCeiling("wedge-hoek-bray", Varied::factor, 1.7407, 0.15);
        checkCeiling("wedge-phi-40", Varied::factor, 1.275, 0.15);
    }

    TEST_CASE("limit analysis beside an answer counts the scenario's earthquake and its water") {
        for (const char* name : {"sau-mau-ping-dry", "sau-mau-ping-wet", "sau-mau-ping-dry-shaken",
                                 "sau-mau-ping-wet-shaken", "hoek-bray-crack-0m-shaken"}) {
            CAPTURE(name);
            const auto found = safetyFactor(verification(name));
            REQUIRE(found.ok());
            REQUIRE((found->status == SearchStatus::found));
            REQUIRE(found->upper_bound.value.has_value());
            // A plane without dilation: the slide is the mechanism of both.
            CHECK(*found->upper_bound.value == doctest::Approx(found->answer).epsilon(2e-3));
        }
    }
}
