// A block that turns on an elastic joint without tension does so about a line inside its edge. Where the
// joint is closed over the length c at the edge, pressure is a triangle k u x / c, and its resultant N is c/3
// from the edge.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

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

/// A block of 1 m on an inclined bed. Its weight acts e = h/2 tan(tilt) off the bed's middle, outside the
/// middle third, so that a = 3 (b/2 - e) stay closed. With cohesion c on that part alone
/// F = (c a + N tan(phi)) / T, per metre of depth.
struct LeaningBlock {
    double height, tilt_deg, cohesion, friction_deg = 20;

    Model model(PointRule::Kind rule) const {
        Model model = floorModel(friction_deg, 1e11);
        model.points.kind = rule;
        model.gravity.tilt = radians(tilt_deg);
        model.joints[0].cohesion = model.joints[0].residual_cohesion = cohesion;
        addBox(model, "block", {0, 0, 0}, {1, 1, height});
        return model;
    }

    double factor(double closed) const {
        const double tilt = radians(tilt_deg), weight = 2700 * 9.81 * height;
        return (cohesion * closed + weight * std::cos(tilt) * std::tan(radians(friction_deg))) /
               (weight * std::sin(tilt));
    }
    double closed() const { return 3 * (0.5 - 0.5 * height * std::tan(radians(tilt_deg))); }
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

    TEST_CASE("cohesion acts on the closed part of a joint that is open in part") {
        for (const LeaningBlock& block : {LeaningBlock{1, 30, 10e3}, LeaningBlock{1.2, 28, 15e3},
                                          LeaningBlock{0.8, 35, 20e3}, LeaningBlock{1.5, 24, 12e3}}) {
            CAPTURE(block.height);
            REQUIRE(block.closed() < 0.9);
            const double exact = block.factor(block.closed());
            const auto distributed =
                safetyFactor(block.model(PointRule::Kind::distributed), {.interval = false});
            REQUIRE(distributed.ok());
            CHECK(distributed->answer == doctest::Approx(exact).epsilon(2e-3));
            // Its contact points are open or closed as a whole; the interval and a warning give the rest.
            const auto vertex = safetyFactor(block.model(PointRule::Kind::vertex));
            REQUIRE(vertex.ok());
            CHECK(vertex->answer > 1.01 * exact);
            CHECK(vertex->answer_interval->first == doctest::Approx(exact).epsilon(2e-3));
            CHECK(std::any_of(vertex->warnings.begin(), vertex->warnings.end(), [](const std::string& line) {
                return line.find("joints with cohesion are open in part") != std::string::npos;
            }));
        }
    }

    TEST_CASE("every result says where joints with cohesion are open in part") {
        const auto says = [](const std::vector<std::string>& warnings) {
            return std::any_of(warnings.begin(), warnings.end(), [](const std::string& line) {
                return line.find("joints with cohesion are open in part") != std::string::npos;
            });
        };
        const LeaningBlock block{1.5, 24, 12e3};
        const double exact = block.factor(block.closed());
        for (const PointRule::Kind rule : {PointRule::Kind::vertex, PointRule::Kind::corner}) {
            CAPTURE(static_cast<int>(rule));
            const auto alone = safetyFactor(block.model(rule), {.interval = false});
            REQUIRE(alone.ok());
            // Four corners bear its weight without opening; only another rule shows what is closed.
            CHECK(says(alone->warnings) == (rule == PointRule::Kind::vertex));
            Model beside = block.model(rule);  // a large block that stands by itself
            addBox(beside, "large", {3, 0, 0}, {15, 4, 1});
            const auto both = safetyFactor(beside);
            REQUIRE(both.ok());
            CHECK(says(both->warnings));
            CHECK(both->answer_interval->first == doctest::Approx(exact).epsilon(3e-3));
        }
        Model dilates = block.model(PointRule::Kind::distributed);
        dilates.joints[0].dilation = radians(0.1);
        const auto dilating = safetyFactor(dilates);
        REQUIRE(dilating.ok());
        CHECK(says(dilating->warnings));
        const auto closed = safetyFactor(LeaningBlock{0.5, 24, 12e3}.model(PointRule::Kind::vertex));
        REQUIRE(closed.ok());
        CHECK_FALSE(says(closed->warnings));
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
