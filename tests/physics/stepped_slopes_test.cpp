// Stepped slopes of columns, on joints soft and stiff: none fails before a column of it would by itself.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kWidth = 0.187, kHeight = 0.271;  // of a block [m]

Model stepped(const std::vector<int>& heights, double friction_deg, double stiffness) {
    std::string list;
    for (const int height : heights) list += (list.empty() ? "" : ", ") + std::to_string(height);
    const std::string k = std::to_string(stiffness);
    const auto scenario = formats::parseScenario(
        "[material.m]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = " + k +
            "\nshear_stiffness = " + k + "\nfriction_deg = " + std::to_string(friction_deg) +
            "\n[[stack]]\ncolumns = " + std::to_string(heights.size()) + "\nrows = " +
            std::to_string(*std::max_element(heights.begin(), heights.end())) + "\nslices = 1\nblock = [" +
            std::to_string(kWidth) + ", 0.251, " + std::to_string(kHeight) + "]\nheights = [" + list + "]\n",
        "stepped.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(formats::format(error));
    REQUIRE(scenario.ok());
    return scenario->model;
}

/// The angle of a single column [deg].
double aloneAt(int rows, double stiffness, PointRule::Kind rule = PointRule::Kind::vertex) {
    Model model = stepped({rows}, 35.235, stiffness);
    model.points.kind = rule;
    const SearchResult result = *criticalAngle(model, {.interval = false});
    REQUIRE((result.status == SearchStatus::found));
    return degrees(result.answer);
}

double overturns(int rows) { return degrees(std::atan(kWidth / (rows * kHeight))); }

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("stepped slopes whose first column is a tallest one topple where it does, whatever is behind") {
        const std::vector<std::vector<int>> shapes{{6, 6, 5, 2, 6}, {6, 2, 6}, {6, 5, 4, 3}, {5, 5, 5},
                                                   {4, 1, 4, 1},    {6, 6},    {7, 3, 5, 7}};
        for (const std::vector<int>& heights : shapes)
            for (const double stiffness : {3.2126e9, 3e10, 1e12}) {
                CAPTURE(heights.size());
                CAPTURE(heights.front());
                CAPTURE(stiffness);
                const double alone = aloneAt(heights.front(), stiffness);
                const SearchResult result = *criticalAngle(stepped(heights, 35.235, stiffness));
                REQUIRE((result.status == SearchStatus::found));
                // Friction behind it may hold the first column for a while, and on elastic joints it turns about a
                // pivot inside its edge; the interval says so.
                CHECK(degrees(result.answer) >= alone * (1 - 0.005));
                REQUIRE(result.answer_interval.has_value());
                const bool is_elastic = result.answer_interval_reasons.first.starts_with("pressure over");
                const double least =
                    is_elastic ? aloneAt(heights.front(), stiffness, PointRule::Kind::distributed) : alone;
                CHECK(degrees(result.answer_interval->first) == doctest::Approx(least).epsilon(0.005));
                CHECK((result.mode == FailureMode::toppling));
            }
    }

    // Near its limit a column stands on its toe, where joints give most: on soft ones it leans, and that
    // takes some of its angle.
    TEST_CASE("a column of blocks overturns at atan(b / h), on softer joints sooner") {
        for (const int rows : {4, 5, 6, 7}) {
            CAPTURE(rows);
            double before = overturns(rows) * (1 + 0.0005);
            for (const double stiffness : {1e12, 3e10, 3.2126e9}) {
                CAPTURE(stiffness);
                const double alone = aloneAt(rows, stiffness);
                MESSAGE(rows << " blocks on joints of " << stiffness << " Pa/m: " << alone);
                CHECK(alone <= before);
                if (stiffness > 1e11) CHECK(alone == doctest::Approx(overturns(rows)).epsilon(0.003));
                before = alone;
            }
        }
    }

    TEST_CASE("stepped slopes that rise to the back are stable up to the limit of their tallest column") {
        const std::vector<std::vector<int>> shapes{
            {1, 2, 3, 4}, {2, 3, 4, 5, 6}, {1, 6}, {3, 6, 6}, {2, 2, 5}};
        for (const std::vector<int>& heights : shapes)
            for (const double friction : {25.0, 35.0}) {
                CAPTURE(heights.size());
                CAPTURE(heights.back());
                CAPTURE(friction);
                const SearchResult result = *criticalAngle(stepped(heights, friction, 1e12));
                REQUIRE((result.status == SearchStatus::found));
                const double least = std::min(friction, overturns(heights.back()));
                const double most = std::min(friction, overturns(heights.front()));
                MESSAGE(heights.size() << " columns, the last of " << heights.back() << ": "
                                       << degrees(result.answer) << ", by itself " << least);
                CHECK(degrees(result.answer_interval->first) >= least * (1 - 0.005));
                CHECK(degrees(result.answer) <= most * (1 + 0.002));
            }
    }
}
