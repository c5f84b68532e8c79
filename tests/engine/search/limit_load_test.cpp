// The load at which blocks that slide as one body are in limit equilibrium, against closed formulas.

#include "search/limit_load.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/flows.h"
#include "support/models.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::search;
using namespace talus::test;

namespace {

constexpr double kFriction = 20, kTilt = 8;  // [deg]
const Control kPlain{.threads = 1};

LoadAxis axisOf(const Model& model, Varied varied) {
    const SearchRules rules;
    return varied == Varied::tilt ? tiltAxis(model, rules) : accelerationAxis(model, rules);
}

/// The limit by a search's axis, wherever the search's own answer lies.
double limitOf(const Model& model, Varied varied, double answer) {
    const LoadAxis axis = axisOf(model, varied);
    const auto limit = limitEquilibriumOf({model, varied, 0, kPlain}, axis, answer);
    REQUIRE(limit.has_value());
    return limit->value;
}

/// A box on a tilted plane; its base has cohesion, and keeps it.
Model cohesiveSlope(double cohesion) {
    Model model = floorModel(kFriction);
    model.joints[0].cohesion = model.joints[0].residual_cohesion = cohesion;
    addBox(model, "box", {0, 0, 0}, {1, 2, 0.3}, 2500);
    model.gravity.tilt = radians(kTilt);
    model.analysis.start = 0;
    return model;
}

/// A prism in a groove along x whose sides dip at 45 degrees.
Model grooveModel() {
    Model model;
    model.joints = {joint(kFriction)};
    for (const double side : {-1.0, 1.0}) {
        std::vector<Vec3> points;
        for (const double x : {-2.0, 4.0})
            for (const Vec3& at : {Vec3(x, 0, 0), Vec3(x, side, 1), Vec3(x, side, -1), Vec3(x, 0, -1)})
                points.push_back(at);
        Block block = box(side < 0 ? "left" : "right", {0, 0, 0}, {1, 1, 1}, 2700, Motion::fixed);
        block.shape = *convexHull(points);
        model.blocks.push_back(block);
    }
    Block wedge = box("wedge", {0, 0, 0}, {1, 1, 1});
    wedge.shape =
        *convexHull({{0, 0, 0}, {0, -0.5, 0.5}, {0, 0.5, 0.5}, {1, 0, 0}, {1, -0.5, 0.5}, {1, 0.5, 0.5}});
    model.blocks.push_back(wedge);
    return model;
}

/// A box on a floor, between walls and under a lid.
Model pitModel() {
    Model model = floorModel(kFriction);
    addBox(model, "box", {0, 0, 0}, {1, 1, 1});
    const auto wall = [&](const char* name, const Vec3& min, const Vec3& max) {
        model.blocks.push_back(box(name, min, max, 2700, Motion::fixed));
    };
    wall("front", {-1, 0, 0}, {0, 1, 1});
    wall("back", {1, 0, 0}, {2, 1, 1});
    wall("left", {0, -1, 0}, {1, 0, 1});
    wall("right", {0, 1, 0}, {1, 2, 1});
    wall("lid", {0, 0, 1}, {1, 1, 2});
    return model;
}

std::string whyOf(const Model& model) {
    return nothingCanSlide({model, Varied::factor, 0, kPlain}, 1).value_or("");
}

}  // namespace

TEST_SUITE("search") {
    TEST_CASE("limitEquilibriumOf: a plane with cohesion, by tilt and by horizontal acceleration") {
        constexpr double kCohesion = 500;
        const Model model = cohesiveSlope(kCohesion);
        const double weight = 2500 * 0.6 * model.gravity.magnitude;
        const double c = kCohesion * 2.0 / weight, phi = radians(kFriction), t = radians(kTilt);
        // sin(b) = c + cos(b) tan(phi)
        const double tilt = phi + std::asin(c * std::cos(phi));
        // sin(t) + k cos(t) = c + (cos(t) - k sin(t)) tan(phi)
        const double k =
            (c + std::cos(t) * std::tan(phi) - std::sin(t)) / (std::cos(t) + std::sin(t) * std::tan(phi));
        for (const double off : {0.4, 1.0, 1.5}) {
            CAPTURE(off);
            CHECK(limitOf(model, Varied::tilt, off * tilt) == doctest::Approx(tilt).epsilon(1e-5));
            CHECK(limitOf(model, Varied::horizontal, off * k) == doctest::Approx(k).epsilon(1e-5));
        }
    }

    TEST_CASE("limitEquilibriumOf: a search's answer just below the limit, or just above") {
        const Model model = cohesiveSlope(0);
        const double phi = radians(kFriction), tilt = radians(kTilt);
        for (const double cells : {0.001, 0.003, 0.005, 0.0075, 0.0099, 0.0101, 0.015, 0.02, 0.03}) {
            for (const double side : {-1.0, 1.0}) {
                CAPTURE(cells);
                CAPTURE(side);
                for (const Varied varied : {Varied::tilt, Varied::horizontal}) {
                    const double exact = varied == Varied::tilt ? phi : std::tan(phi - tilt);
                    const double answer = exact + side * cells * axisOf(model, varied).loading.cell;
                    CHECK(limitOf(model, varied, answer) == doctest::Approx(exact).epsilon(1e-6));
                }
            }
        }
    }

    TEST_CASE("limitEquilibriumOf: a limit beyond which the next load tried is almost upright") {
        Model model = cohesiveSlope(0);
        model.analysis.stop = radians(89.99);
        for (Joint& each : model.joints) each.friction = each.residual_friction = radians(46);
        const double cell = axisOf(model, Varied::tilt).loading.cell;
        const double found = limitOf(model, Varied::tilt, radians(46) - 0.005 * cell);
        CHECK(found == doctest::Approx(radians(46)).epsilon(1e-6));
    }

    TEST_CASE("limitEquilibriumOf: a wedge in a groove is held by both sides") {
        const Model model = grooveModel();
        // Each side carries W cos(b) / (2 cos 45 deg).
        const double tilt = std::atan(std::tan(radians(kFriction)) / std::cos(radians(45)));
        CHECK(limitOf(model, Varied::tilt, 0.9 * tilt) == doctest::Approx(tilt).epsilon(1e-5));
        CHECK(limitOf(model, Varied::horizontal, 0.5) == doctest::Approx(std::tan(tilt)).epsilon(1e-5));
        const auto limit =
            limitEquilibriumOf({model, Varied::tilt, 0, kPlain}, tiltAxis(model, SearchRules{}), tilt);
        REQUIRE(limit.has_value());
        CHECK(limit->kind == "sliding along two planes");
        CHECK(limit->blocks == std::vector<std::string>{"wedge"});
    }

    TEST_CASE("limitEquilibriumOf: nothing where a block slides at the start, or none slides to the end") {
        Model model = cohesiveSlope(0);
        model.analysis.start = radians(kFriction + 5);
        CHECK_FALSE(limitEquilibriumOf({model, Varied::tilt, 0, kPlain}, tiltAxis(model, SearchRules{}),
                                       radians(kFriction + 6))
                        .has_value());
        model.analysis.start = 0;
        model.analysis.stop = radians(kFriction - 5);
        CHECK_FALSE(limitEquilibriumOf({model, Varied::tilt, 0, kPlain}, tiltAxis(model, SearchRules{}),
                                       radians(kFriction - 6))
                        .has_value());
    }

    TEST_CASE("limitEquilibriumOf: a row of columns topples sooner than blocks slide") {
        // Two columns side by side: the upper one pushes at the top of their contact.
        Model model = floorModel(45);
        addBox(model, "toe", {0, 0, 0}, {1, 1, 1});
        addBox(model, "tall", {1, 0, 0}, {0.5, 1, 4});
        model.gravity.tilt = 0;
        model.analysis.start = 0;
        // By moments about each pivot, weights W and 2 W. Friction f drags the toe column down at x = 1 and
        // acts through the tall column's pivot: P = 2 W (2 s - 0.25 c), P (1 - f) + W (0.5 s - 0.5 c) = 0.
        // With f = 1 the toe column does not topple. It slides with P (1 - f f) + W (s - f c) = 0.
        for (const double friction : {20.0, 30.0, 45.0}) {
            CAPTURE(friction);
            for (Joint& each : model.joints) each.friction = each.residual_friction = radians(friction);
            const double f = std::tan(radians(friction));
            const double topples = std::atan((0.5 + 0.5 * (1 - f)) / (0.5 + 4 * (1 - f)));
            const double slides = std::atan((f + 0.5 * (1 - f * f)) / (1 + 4 * (1 - f * f)));
            const double limit = std::max(std::atan(0.125), std::min(topples, slides));
            CHECK(limitOf(model, Varied::tilt, limit) == doctest::Approx(limit).epsilon(1e-6));
        }
    }

    TEST_CASE("nothingCanSlide: a block that is held in, one that nothing pushes, and one that slides") {
        CHECK(whyOf(pitModel()).find("no block can leave") != std::string::npos);
        Model level = cohesiveSlope(0);
        level.gravity.tilt = 0;
        CHECK(whyOf(level).find("no block can slide or fall") != std::string::npos);
        CHECK(whyOf(cohesiveSlope(0)).empty());
    }

    TEST_CASE("a search that ends without a failure says that no block can leave") {
        const SearchResult result = *safetyFactor(pitModel(), kPlain);
        REQUIRE((result.status == SearchStatus::stable_to_stop));
        const bool told = std::any_of(result.warnings.begin(), result.warnings.end(), [](const auto& text) {
            return text.find("no block can leave") != std::string::npos;
        });
        CHECK(told);
    }

    TEST_CASE("a search over tilt has no limit equilibrium beside flow, which keeps the scenario's tilt") {
        Model model = floorModel(kFriction);
        addBox(model, "box", {0, 0, 0}, {4, 1, 1});
        model.flow = flowAlongX(1e-4, 0, 1);
        const SearchResult tilted = *criticalAngle(model, kPlain);
        REQUIRE((tilted.status == SearchStatus::found));
        CHECK_FALSE(tilted.limit_equilibrium.has_value());
        // k g M = (g M - U) tan(phi), with uplift that falls from 1 m of water to none
        const double g = model.gravity.magnitude, mass = 2700 * 4;
        const double uplift = 0.5 * model.flow->density * g * 4;
        const double k = (1 - uplift / (g * mass)) * std::tan(radians(kFriction));
        const SearchResult pushed = *criticalAcceleration(model, kPlain);
        REQUIRE(pushed.limit_equilibrium.has_value());
        CHECK(pushed.limit_equilibrium->value == doctest::Approx(k).epsilon(1e-5));
    }

    TEST_CASE("the result of each search has the limit equilibrium of its own load") {
        const Model model = cohesiveSlope(500);
        for (const LoadSearch& search : loadSearches()) {
            CAPTURE(search.name);
            const SearchResult result = *search.find(model, kPlain, {});
            REQUIRE((result.status == SearchStatus::found));
            REQUIRE(result.limit_equilibrium.has_value());
            CHECK(result.limit_equilibrium->value == doctest::Approx(result.answer).epsilon(0.01));
        }
    }
}
