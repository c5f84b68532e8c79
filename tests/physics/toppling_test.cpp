// Toppling, leaning and arching assemblies are decided, with the expected answer.

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "support/models.h"
#include "support/structures.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Found, with its bracket in degrees.
SearchResult tilted(const Model& model, const std::string& name) {
    const SearchResult result = *criticalAngle(model, {.interval = false, .upper_bound = Beside::never});
    MESSAGE(name << ": " << degrees(result.low) << " to " << degrees(result.high) << ", " << result.steps
                 << " steps, " << result.factors << " factorisations");
    REQUIRE((result.status == SearchStatus::found));
    return result;
}

/// A slope 12 m high of columns a metre thick that dip into it, on bedding that dips out of it.
Model leaningColumns(double dip_deg) {
    const std::string text =
        "[material.rock]\ndensity = 2633\n[joint.default]\nnormal_stiffness = 3e10\nshear_stiffness = "
        "2.89e9\n"
        "friction_deg = 41.23\ncohesion = 1417\n[rock_mass]\nregion = { profile = [[-3.66, -2.44], "
        "[15.46, -2.44], [15.46, 12.22], [3.87, 12.22], [0, 0], [-3.66, 0]], y = [0, 11.57] }\n"
        "min_thickness = 0.073\nfixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }]\n"
        "[[joint_set]]\nname = \"columns\"\ndip_deg = " +
        std::to_string(dip_deg) +
        "\ndip_direction_deg = 90\nspacing = 1.02\n[[joint_set]]\nname = \"beds\"\ndip_deg = 8.2\n"
        "dip_direction_deg = 270\nspacing = 3.44\n";
    auto scenario = formats::parseScenario(text, "columns.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(formats::format(error));
    REQUIRE(scenario.ok());
    return std::move(scenario->model);
}

/// Columns of 40 blocks 0.2 m long and 0.1 m high, one behind the other.
Model deepStack(int columns) {
    auto scenario = formats::parseScenario(
        "[material.rock]\ndensity = 2548.42\n[joint.default]\nnormal_stiffness = 1e11\nshear_stiffness = "
        "1e10\nfriction_deg = 35\n[[stack]]\ncolumns = " +
            std::to_string(columns) + "\nrows = 40\nslices = 1\nblock = [0.2, 1.0, 0.1]\n",
        "stack.toml");
    REQUIRE(scenario.ok());
    return std::move(scenario->model);
}

}  // namespace

TEST_SUITE("slow: physics") {
    TEST_CASE("columns that lean on each other overturn when the first one does, however many they are") {
        const SearchResult one = tilted(deepStack(1), "1 column");
        for (const int columns : {3, 24}) {
            const SearchResult result = tilted(deepStack(columns), std::to_string(columns) + " columns");
            CHECK(result.answer >= one.low);
            CHECK(result.answer <= one.high);
            CHECK((result.mode == FailureMode::toppling));
        }
    }

    TEST_CASE("columns overturn at atan(0.2 / h), less what their joints give") {
        for (const auto& [rows, exact] : {std::pair{10, 11.310}, {20, 5.711}}) {
            const Model model = stackModel(1, rows, 1, 35, {0.2, 1.0, 0.1}, 1e12);
            const double found = degrees(tilted(model, std::to_string(rows) + " blocks").answer);
            CHECK(found < exact + 0.02);
            CHECK(found > exact - 0.02);
        }
    }

    TEST_CASE("arches are stable at the start, and fail by hinges when tilted") {
        const double found = degrees(tilted(archModel(27, 10, 1.5, 35, 1e12), "1.5 m").answer);
        CHECK(found < 8.27 + 0.01);
        CHECK(found > 8.27 - 0.05);
        CHECK((criticalAngle(archModel(27, 10, 1.0, 35, 1e12))->status == SearchStatus::unstable_at_start));
    }

    TEST_CASE(
        "columns that yield before they fall have failed: they are not followed beyond the upper bound") {
        for (const double dip_deg : {50.0, 55.7, 61.0}) {
            const Model model = leaningColumns(dip_deg);
            const SearchResult result =
                *safetyFactor(model, {.interval = false, .upper_bound = Beside::never});
            const LimitResult limit = *limitAnalysis(model, Varied::factor);
            MESSAGE(dip_deg << " degrees: " << result.low << " to " << result.high << ", ceiling "
                            << limit.upper);
            REQUIRE((result.status == SearchStatus::found));
            CHECK(result.low < limit.upper);
            CHECK(result.high > 0.95 * limit.lower);
        }
    }
}
