// One body on a plane: every answer in closed form.

#include <doctest/doctest.h>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/simulation.h"
#include "talus/theory.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kRockDensity = 26000 / 9.81;

Model bodyOnPlane(double friction_deg, const Vec3& size, double stiffness = 1e11, double density = 2700) {
    Model model = floorModel(friction_deg, stiffness);
    addBox(model, "body", {0, 0, 0}, size, density);
    model.analysis.start = 0;
    model.run.watch = {"body"};
    return model;
}

SearchResult critical(const Model& model) {
    const auto result = criticalAngle(model);
    REQUIRE(result.ok());
    CHECK((result->status == SearchStatus::found));
    CHECK(!result->moving_blocks.empty());
    return *result;
}

void checkAngle(const SearchResult& result, double expected_deg, FailureMode mode) {
    MESSAGE("critical angle " << degrees(result.answer) << ", expected " << expected_deg << ", "
                              << toString(result.mode));
    CHECK(std::abs(degrees(result.answer) - expected_deg) < 0.02 + 0.005);
    CHECK((result.mode == mode));
    CHECK(result.moving_blocks == std::vector<std::string>{"body"});
}

RunResult runFor(Model model, double seconds) {
    model.run.duration = seconds;
    const auto result = run(model, {}, {});
    REQUIRE(result.ok());
    return *result;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a block slides at its friction angle") {
        for (const double phi : {10.0, 19.5, 33.0})
            checkAngle(critical(bodyOnPlane(phi, {1, 1, 0.5})), phi, FailureMode::sliding);
    }

    TEST_CASE("on soft springs too: k = 10 MPa/m, the 3DEC manual's block") {
        checkAngle(critical(bodyOnPlane(40.1, {1, 1, 0.5}, 1e7, 2000)), 40.1, FailureMode::sliding);
        Model model = bodyOnPlane(40.1, {1, 1, 0.5}, 1e7, 2000);
        model.gravity.tilt = radians(40);
        model.analysis.start.reset();
        CHECK(criticalAngle(model)->low >= radians(40));
        model.joints[0].friction = model.joints[0].residual_friction = radians(39.9);
        CHECK((criticalAngle(model)->status == SearchStatus::unstable_at_start));
    }

    TEST_CASE("a block overturns at atan(b/h) when friction is larger") {
        checkAngle(critical(bodyOnPlane(45, {0.4, 1, 1})), 21.80, FailureMode::toppling);
        checkAngle(critical(bodyOnPlane(45, {0.5, 1, 1})), 26.57, FailureMode::toppling);
        checkAngle(critical(bodyOnPlane(30, {0.2, 0.1, 0.5}, 3.375e11)), 21.80, FailureMode::toppling);
    }

    TEST_CASE("water behind a block: sliding and overturning, half full and full") {
        struct Row {
            double b, h, phi, water, expected;
            FailureMode mode;
        };
        const Row rows[] = {
            {1, 1, 40, 0.0, 40.00, FailureMode::sliding},    {1, 1, 40, 0.5, 38.38, FailureMode::sliding},
            {1, 1, 40, 1.0, 33.04, FailureMode::sliding},    {1, 2, 40, 0.0, 26.57, FailureMode::toppling},
            {1, 2, 40, 1.0, 25.11, FailureMode::toppling},   {1, 2, 40, 2.0, 13.95, FailureMode::toppling},
            {0.5, 1, 30, 0.0, 26.57, FailureMode::toppling}, {0.5, 1, 30, 0.5, 25.11, FailureMode::toppling},
            {0.5, 1, 30, 1.0, 11.31, FailureMode::sliding}};
        for (const Row& row : rows) {
            Model model = bodyOnPlane(row.phi, {row.b, 1, row.h}, 1e11, kRockDensity);
            if (row.water > 0) model.waters = {waterOn(model, 1, Vec3::UnitX(), row.water)};
            CAPTURE(row.b);
            CAPTURE(row.water);
            checkAngle(critical(model), row.expected, row.mode);
        }
    }

    // The level stays where it is while the block is pushed up the slope, so the thrust falls as it goes:
    // each short load step has a rest a little farther on. The first slide is the answer, whatever the
    // joints' stiffness.
    TEST_CASE(
        "deep water behind a block on a plane that dips the other way: the first slide, on soft joints too") {
        for (const double stiffness : {1e10, 1e11, 1e12})
            for (const double height : {1.5, 2.7, 4.8})
                for (const double slenderness : {3.0, 4.0})
                    for (const double full : {0.75, 0.85}) {
                        const double width = height / slenderness, water = full * height, density = 2300;
                        const double overturns =
                            1 / slenderness -
                            1000 * std::pow(water, 3) / (3 * density * width * height * height);
                        if (overturns > -0.05) continue;
                        // Slides 0.3 to 0.8 degrees before it overturns.
                        const double slides =
                            std::tan(std::atan(overturns) - radians(0.8 - (full - 0.7) * 3));
                        const double thrust = 1000 * water * water / (2 * density * width * height);
                        const double friction = degrees(std::atan(slides + thrust));
                        CAPTURE(stiffness);
                        CAPTURE(height);
                        CAPTURE(slenderness);
                        CAPTURE(full);
                        Model model = bodyOnPlane(friction, {width, 1, height}, stiffness, density);
                        model.waters = {waterOn(model, 1, Vec3::UnitX(), water)};
                        model.analysis.start = std::atan(slides) - radians(2);
                        const SearchResult result = critical(model);
                        CHECK(std::abs(degrees(result.answer) - degrees(std::atan(slides))) < 0.03);
                    }
    }

    TEST_CASE("cohesion holds a block as limit equilibrium says, and the break is brittle") {
        // W sin(beta) = W cos(beta) tan(phi) + C A.
        // A flat block, so that its weight stays within the middle third of the base and no contact point
        // opens.
        Model model = bodyOnPlane(30, {1, 1, 0.2}, 1e10, 2000);
        const theory::SlidingMass mass{
            .length = 1, .height = 0.2, .density = 2000, .friction = radians(30), .cohesion = 800};
        model.joints[0].cohesion = model.joints[0].residual_cohesion = 800;
        checkAngle(critical(model), degrees(theory::criticalTiltSliding(mass)), FailureMode::sliding);
        // With no residual cohesion the contact points break one after the other: between friction alone and
        // full cohesion.
        model.joints[0].residual_cohesion = 0;
        const double brittle = degrees(critical(model).answer);
        MESSAGE("brittle: " << brittle);
        CHECK(brittle > 30);
        CHECK(brittle < degrees(theory::criticalTiltSliding(mass)) + 0.02);
    }

    TEST_CASE("a sliding block accelerates with g (sin beta - cos beta tan phi)") {
        Model model = bodyOnPlane(20, {1, 1, 0.5}, 1e9, 2000);
        model.gravity = {10.0, radians(40)};
        model.damping.contact = 1e-5;
        const RunResult result = runFor(model, 0.5);
        CHECK(-result.watch[0].velocity.x() / 0.5 == doctest::Approx(3.640).epsilon(1e-3));
        CHECK(-result.watch[0].displacement.x() == doctest::Approx(0.5 * 3.640 * 0.25).epsilon(2e-3));
        CHECK(std::abs(result.watch[0].displacement.z()) < 1e-4);
    }

    TEST_CASE("an elastic bounce returns its energy") {
        Model model = bodyOnPlane(30, {0.2, 0.2, 0.2}, 1e9);
        for (Vec3& v : model.blocks[1].shape.vertices) v.z() += 0.05;
        // Falls 0.05 m in 0.10096 s; after twice that and the short contact it is up again.
        const RunResult result = runFor(model, 0.2020);
        const double height = result.watch[0].position.z() - 0.1;
        const double energy = 9.81 * height + 0.5 * result.watch[0].velocity.squaredNorm();
        CHECK(energy == doctest::Approx(9.81 * 0.05).epsilon(1e-3));
        CHECK(height == doctest::Approx(0.05).epsilon(1e-2));
    }

    TEST_CASE("a damped bounce has the restitution of the law: spring and dashpot without tension") {
        // Schwager and Poeschel 2007: e = exp(-(beta/omega)(pi - atan(2 beta omega / (omega^2 - beta^2)))).
        Model model = bodyOnPlane(30, {0.2, 0.2, 0.2}, 1e8);
        for (Vec3& v : model.blocks[1].shape.vertices) v.z() += 0.01;
        model.gravity.magnitude = 0;
        model.blocks[1].velocity = {0, 0, -1};
        const double mass = 2700 * 0.008, omega_0 = std::sqrt(1e8 * 0.04 / mass), ratio = 0.2;
        model.damping.contact = 2 * ratio / omega_0;
        const double beta = ratio * omega_0, omega = omega_0 * std::sqrt(1 - ratio * ratio);
        const double expected =
            std::exp(-beta / omega * (M_PI - std::atan(2 * beta * omega / (omega * omega - beta * beta))));
        const RunResult result = runFor(model, 0.03);
        CHECK(result.watch[0].velocity.z() == doctest::Approx(expected).epsilon(2e-3));
    }

    TEST_CASE("factor of safety of a block: tan(phi) / tan(beta), with cohesion and with water") {
        Model model = bodyOnPlane(30, {1, 1, 0.5}, 1e10, 2000);
        model.gravity.tilt = radians(20);
        const auto factor = [&] {
            const auto result = safetyFactor(model);
            REQUIRE(result.ok());
            CHECK((result->status == SearchStatus::found));
            return result->answer;
        };
        CHECK(factor() == doctest::Approx(std::tan(radians(30)) / std::tan(radians(20))).epsilon(1e-3));
        model.joints[0].cohesion = model.joints[0].residual_cohesion = 1500;
        model.waters = {waterOn(model, 1, Vec3::UnitX(), 0.4)};
        const theory::SlidingMass mass{.length = 1,
                                       .height = 0.5,
                                       .density = 2000,
                                       .water_depth = 0.4,
                                       .friction = radians(30),
                                       .cohesion = 1500};
        CHECK(factor() == doctest::Approx(theory::factorOfSafetySliding(mass, radians(20))).epsilon(1e-3));
    }

    TEST_CASE("a start close below the critical angle is no start beyond it") {
        // Two blocks on one another, b/h = 0.25/1: weight laid on at 12 degrees sets off a rocking of many
        // periods.
        for (const double start : {0.0, 6.0, 12.0, 13.9}) {
            Model model = floorModel(40, 1e11);
            addBox(model, "lower", {0, 0, 0}, {0.25, 1.0, 0.5});
            addBox(model, "upper", {0, 0, 0.5}, {0.25, 1.0, 0.5});
            model.analysis.start = radians(start);
            const SearchResult result = critical(model);
            MESSAGE("started at " << start << ": " << degrees(result.answer) << ", expected 14.036");
            CHECK(std::abs(degrees(result.answer) - 14.036) < 0.025);
        }
    }

    // What soft joints give under weight is none of what blocks creep in the first short load steps.
    TEST_CASE(
        "an answer a few cells above the start, on joints so soft that they give more than that moves") {
        for (const double start : {-0.3, 0.0, 0.3, 2.0})
            for (const double above : {0.6, 0.9})
                for (const double tolerance : {0.2, 0.5}) {
                    CAPTURE(start);
                    CAPTURE(above);
                    CAPTURE(tolerance);
                    Model model = bodyOnPlane(start + above, {1, 1, 1}, 3e6);
                    model.analysis.start = radians(start);
                    model.analysis.tolerance = radians(tolerance);
                    const SearchResult result = critical(model);
                    CHECK(degrees(result.low) < start + above + 0.02);
                    CHECK(degrees(result.high) > start + above - 0.05);
                }
    }

    TEST_CASE("answers that are no angle: failing at the start, standing at the end") {
        Model model = bodyOnPlane(20, {1, 1, 0.5});
        model.analysis.start = radians(25);
        const SearchResult failing = *criticalAngle(model);
        CHECK((failing.status == SearchStatus::unstable_at_start));
        CHECK((failing.mode == FailureMode::sliding));
        CHECK(failing.low == -kInfinity);
        model.analysis.start = 0;
        model.analysis.stop = radians(15);
        const SearchResult standing = *criticalAngle(model);
        CHECK((standing.status == SearchStatus::stable_to_stop));
        CHECK((standing.mode == FailureMode::none));
        CHECK(standing.moving_blocks.empty());
    }

    TEST_CASE("a search that is stopped says so and keeps what it has") {
        const std::atomic<bool> stop = true;
        const SearchResult result = *criticalAngle(bodyOnPlane(20, {1, 1, 0.5}), {.stop = &stop});
        CHECK((result.status == SearchStatus::interrupted));
    }
}
