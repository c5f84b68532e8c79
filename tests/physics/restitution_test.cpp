// Normal restitution: an impact gives back e of the normal speed, whatever mass, speed, stiffness and shape.

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "support/impacts.h"
#include "support/models.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

/// As near to a ball as `points` on it are (a spiral: evenly).
Block ball(const std::string& name, const Vec3& centre, double radius, int points = 300) {
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vec3> corners;
    for (int k = 0; k < points; ++k) {
        const double z = 1 - (2 * k + 1.0) / points, r = std::sqrt(1 - z * z);
        corners.push_back(centre + radius * Vec3(r * std::cos(golden * k), r * std::sin(golden * k), z));
    }
    return hullBlock(name, corners);
}

Model nothing(double restitution, double stiffness) {
    Model model;
    model.joints = {joint(0, stiffness)};
    model.joints[0].restitution_normal = restitution;
    model.gravity.magnitude = 0;
    model.run.frame_interval = 1e-3;
    return model;
}

// Of the speed: a step goes by with the force before it is seen that the block parts, 3 % of what there was
// at e = 0.
constexpr double kOfStep = 0.04;

/// Share of the kinetic energy at the start that is left at the end.
double energyLeft(const Model& model) {
    double first = -1, last = 0;
    const auto result = run(model, {.threads = 1}, [&](const HistoryRecord& r) {
        if (first < 0) first = r.kinetic_energy;
        last = r.kinetic_energy;
        REQUIRE(r.elastic_energy >= 0);
    });
    REQUIRE(result.ok());
    return last / first;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("restitution: a box that meets a floor with its face") {
        for (const double e : {0.0, 0.3, 0.7, 1.0})
            for (const double stiffness : {1e8, 1e10})
                for (const double speed : {0.3, 4.0}) {
                    CAPTURE(e);
                    CAPTURE(stiffness);
                    CAPTURE(speed);
                    Model model = nothing(e, stiffness);
                    model.blocks = {box("floor", {-5, -5, -1}, {5, 5, 0}, 2700, Motion::fixed),
                                    box("box", {0, 0, 0.01 * speed}, {0.5, 0.6, 0.4 + 0.01 * speed})};
                    model.blocks[1].velocity = {0, 0, -speed};
                    model.run.duration = 0.05;
                    const double left = std::sqrt(energyLeft(model));
                    CHECK(std::abs(left - e) < kOfStep);
                }
    }

    TEST_CASE("restitution: a ball, light and heavy, small and large, slow and fast") {
        // Where it rocks from facet to edge, edges press while others part.
        for (const double e : {0.5, 0.8})
            for (const double radius : {0.05, 0.5})
                for (const double speed : {0.5, 5.0}) {
                    CAPTURE(e);
                    CAPTURE(radius);
                    CAPTURE(speed);
                    Model model = nothing(e, 1e12);
                    model.blocks = {box("floor", {-5, -5, -1}, {5, 5, 0}, 2700, Motion::fixed),
                                    ball("ball", {0, 0, radius + 0.005 * speed}, radius)};
                    model.blocks[1].velocity = {0, 0, -speed};
                    model.run.duration = 0.06;
                    CHECK(std::abs(std::sqrt(energyLeft(model)) - e) < kOfStep);
                }
    }

    TEST_CASE("restitution: two balls in flight keep their momentum and part with e of their speed") {
        for (const double e : {0.5, 0.9})
            for (const double second : {0.1, 0.2}) {
                CAPTURE(e);
                CAPTURE(second);
                Model model = nothing(e, 1e12);
                model.blocks = {ball("one", {0, 0, 0}, 0.1), ball("two", {0.11 + second, 0, 0}, second)};
                model.blocks[0].velocity = {3, 0, 0};
                model.run.duration = 0.03;
                model.run.watch = {"one", "two"};
                std::vector<Vec3> velocity;
                REQUIRE(run(model, {.threads = 1}, [&](const HistoryRecord& r) {
                            velocity = {r.watch[0].velocity, r.watch[1].velocity};
                        }).ok());
                CHECK(std::abs((velocity[1] - velocity[0]).norm() / 3 - e) < 2 * kOfStep);
                const double one = massProperties(model.blocks[0].shape).volume,
                             two = massProperties(model.blocks[1].shape).volume;
                CHECK(one * velocity[0].x() + two * velocity[1].x() ==
                      doctest::Approx(3 * one).epsilon(1e-9));
            }
    }

    TEST_CASE("restitution: a bouncing block reaches equilibrium, as deep as its weight presses it") {
        for (const double e : {0.0, 0.3, 0.6}) {
            CAPTURE(e);
            Model model = nothing(e, 1e8);
            model.gravity.magnitude = 9.81;
            model.blocks = {box("floor", {-5, -5, -1}, {5, 5, 0}, 2700, Motion::fixed),
                            box("box", {0, 0, 0.02}, {0.5, 0.6, 0.42})};
            model.run.duration = 1.5;
            model.run.watch = {"box"};
            model.run.start = RunSettings::Start::unstressed;
            Vec3 first = Vec3::Zero(), last = Vec3::Zero();
            double kinetic = 0;
            bool begun = false;
            REQUIRE(run(model, {.threads = 1}, [&](const HistoryRecord& r) {
                        if (!std::exchange(begun, true)) first = r.watch[0].position;
                        last = r.watch[0].position;
                        kinetic = r.kinetic_energy;
                    }).ok());
            CHECK(kinetic < 1e-6 * 2700 * 0.12 * 9.81 * 0.02);
            // rho g h / k below the floor
            CHECK((last - first).z() + 0.02 == doctest::Approx(-2700 * 9.81 * 0.4 / 1e8).epsilon(0.05));
        }
    }
}
