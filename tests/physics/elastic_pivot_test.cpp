// A block that turns on an elastic joint without tension does so about a line inside its edge. Where the
// joint is closed over the length c at the edge, pressure is a triangle k u x / c, and its resultant N is c/3
// from the edge.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/models.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Column {
    double width = 0.2, height = 1, depth = 0.1, density = 2700, stiffness = 1e10;

    Model model(PointRule::Kind rule) const {
        Model model = floorModel(40, stiffness);
        model.points.kind = rule;
        // On joints so soft it leans by more than the default before it overturns.
        model.analysis.failure_displacement = 3e-3;
        addBox(model, "column", {0, 0, 0}, {width, depth, height}, density);
        return model;
    }

    /// The tilt at which it overturns [rad]: moments about the middle of the closed part's resultant, with
    /// the lean u/c = 2 N / (k c^2), N the weight normal to the bed per metre of depth. The greatest over c.
    double overturns() const {
        double greatest = 0, tilt = 0;
        for (int pass = 0; pass < 60; ++pass) {  // N follows the tilt
            const double normal = density * 9.81 * width * height * std::cos(tilt);
            greatest = 0;
            for (int k = 1; k <= 200000; ++k) {
                const double closed = width * k / 200000;
                greatest = std::max(greatest, (width / 2 - closed / 3) / (height / 2) -
                                                  2 * normal / (stiffness * closed * closed));
            }
            tilt = std::atan(greatest);
        }
        return tilt;
    }
};

double answerOf(const Model& model, bool interval, std::pair<double, double>* between = nullptr) {
    const auto answer = criticalAngle(model, {.interval = interval, .upper_bound = Beside::never});
    REQUIRE(answer.ok());
    REQUIRE((answer->status == SearchStatus::found));
    if (between != nullptr) *between = *answer->answer_interval;
    return answer->answer;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a column on an elastic joint overturns where the joint without tension has it") {
        for (const double stiffness : {1e9, 1e10, 1e11, 1e12}) {
            const Column column{.stiffness = stiffness};
            CAPTURE(stiffness);
            CHECK(std::abs(degrees(answerOf(column.model(PointRule::Kind::distributed), false) -
                                   column.overturns())) < 0.01);
        }
        for (const Column& column : {Column{.width = 0.3, .height = 2, .depth = 0.3, .stiffness = 3e9},
                                     Column{.width = 1, .height = 6, .depth = 2, .stiffness = 2e10}})
            CHECK(std::abs(degrees(answerOf(column.model(PointRule::Kind::distributed), false) -
                                   column.overturns())) < 0.01);
    }

    TEST_CASE("where a block topples, the interval includes its elastic pivot") {
        const Column soft{.stiffness = 1e10};
        std::pair<double, double> between;
        const double answer = answerOf(soft.model(PointRule::Kind::vertex), true, &between);
        CHECK(degrees(answer) > 11.2);
        CHECK(std::abs(degrees(between.first - soft.overturns())) < 0.01);
        const Column stiff{.stiffness = 1e13};
        const double rigid = answerOf(stiff.model(PointRule::Kind::vertex), true, &between);
        CHECK(between.first == rigid);
    }
}
