// Earthquakes, gravity of any direction and loads against balances with an exact answer.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/models.h"
#include "support/snapshots.h"
#include "support/verification.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A flat block of 1 x 1 x 0.2 m on a plane of 30 degrees of friction at a tilt; it slides before it topples.
Model flatBlock(double tilt_deg) {
    Model model = floorModel(30);
    model.gravity.tilt = radians(tilt_deg);
    addBox(model, "key", {0, 0, 0}, {1, 1, 0.2});
    return model;
}

const double kTanPhi = std::tan(radians(30));
const double kWeight = 2700 * 0.2 * 9.81;

double factorOf(const Model& model) {
    const auto found = safetyFactor(model);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    return found->answer;
}

double accelerationOf(const Model& model) {
    const auto found = criticalAcceleration(model);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    return found->answer;
}

void checkPublished(const std::string& name, double found, double published) {
    MESSAGE(name, ": ", found, ", published ", published);
    CHECK(found == doctest::Approx(published).epsilon(0.01));
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE(
        "pseudo-static earthquake: factor of safety of a block on a plane, W((1 - k_v) cos - k_h sin) "
        "tan(phi) / ...") {
        const double b = radians(10);
        for (const auto& [k_h, k_v] : {std::pair{0.1, 0.0}, {0.2, 0.15}, {0.15, -0.2}}) {
            Model model = flatBlock(10);
            model.seismic.horizontal = k_h;
            model.seismic.vertical = k_v;
            const double normal = (1 - k_v) * std::cos(b) - k_h * std::sin(b);
            const double driving = (1 - k_v) * std::sin(b) + k_h * std::cos(b);
            const double exact = kTanPhi * normal / driving;
            CHECK(factorOf(model) == doctest::Approx(exact).epsilon(0.001));
            const auto ceiling = limitAnalysis(model, Varied::factor);
            REQUIRE(ceiling.ok());
            CHECK(ceiling->upper == doctest::Approx(exact).epsilon(2e-4));
        }
    }

    TEST_CASE("critical acceleration of a block on a plane: tan(phi - beta), times 1 - k_v") {
        for (const auto& [tilt, k_v] : {std::pair{0.0, 0.0}, {12.0, 0.0}, {12.0, 0.3}}) {
            Model model = flatBlock(tilt);
            model.seismic.vertical = k_v;
            const double exact = (1 - k_v) * std::tan(radians(30 - tilt));
            CHECK(std::abs(accelerationOf(model) - exact) < 2e-4);
            const auto ceiling = limitAnalysis(model, Varied::horizontal);
            REQUIRE(ceiling.ok());
            CHECK(ceiling->upper == doctest::Approx(exact).epsilon(1e-4));
            const auto theory = loadSearch("critical-acceleration")->theory(model, nullptr);
            REQUIRE(theory.has_value());
            CHECK(theory->value == doctest::Approx(exact).epsilon(1e-12));
        }
    }

    TEST_CASE("critical acceleration uphill and across; unstable at the start") {
        Model model = flatBlock(12);
        model.seismic.azimuth = radians(90);  // against the slope: k = tan(phi + beta)
        CHECK(std::abs(accelerationOf(model) - std::tan(radians(42))) < 2e-4);
        // Across: (k W)^2 + (W sin)^2 = (W cos tan(phi))^2
        model.seismic.azimuth = 0;
        const double across =
            std::sqrt(std::pow(std::cos(radians(12)) * kTanPhi, 2) - std::pow(std::sin(radians(12)), 2));
        CHECK(std::abs(accelerationOf(model) - across) < 3e-4);
        const auto ceiling = limitAnalysis(model, Varied::horizontal);
        REQUIRE(ceiling.ok());
        CHECK(ceiling->upper == doctest::Approx(across).epsilon(1e-3));
        model.seismic = {.horizontal = 0.5};
        CHECK((criticalAcceleration(model)->status == SearchStatus::unstable_at_start));
    }

    TEST_CASE(
        "gravity of a direction: the same answers as of the tilt that gives it, and across the model's "
        "axes") {
        Model model = flatBlock(0);
        const double b = radians(12);
        for (const double azimuth : {0.0, 50.0, 180.0}) {
            const Vec3 level(std::cos(radians(azimuth)), std::sin(radians(azimuth)), 0);
            model.gravity.direction = 3 * (std::sin(b) * level - std::cos(b) * Vec3::UnitZ());
            CHECK(factorOf(model) == doctest::Approx(kTanPhi / std::tan(b)).epsilon(0.002));
        }
        // Tilting turns it further about y.
        model.gravity.direction = Vec3(-std::sin(b), 0, -std::cos(b));
        const auto angle = criticalAngle(model);
        REQUIRE((angle->status == SearchStatus::found));
        CHECK(std::abs(degrees(angle->answer) - 18) < 0.01);
    }

    TEST_CASE("loads: a push down the slope, a surcharge in a box, and both in limit analysis") {
        const double b = radians(10);
        Model model = flatBlock(10);
        const Vec3 push(-2000, 0, 0);
        model.loads = {{.kind = AppliedLoad::Kind::force, .block = 1, .force = push, .field = "load[0]"}};
        const double normal = kWeight * std::cos(b), driving = kWeight * std::sin(b);
        double exact = kTanPhi * normal / (driving + 2000);
        CHECK(factorOf(model) == doctest::Approx(exact).epsilon(0.001));
        CHECK(limitAnalysis(model, Varied::factor)->upper == doctest::Approx(exact).epsilon(2e-4));
        model.loads.push_back({.kind = AppliedLoad::Kind::box,
                               .pressure = 4000,
                               .box_min = {0, 0, 0},
                               .box_max = {0.5, 1, 1},
                               .field = "load[1]"});
        exact = kTanPhi * (normal + 2000) / (driving + 2000);
        CHECK(factorOf(model) == doctest::Approx(exact).epsilon(0.001));
        CHECK(limitAnalysis(model, Varied::factor)->upper == doctest::Approx(exact).epsilon(2e-4));
        // k W cos + W sin + 2000 = (W cos - k W sin + 2000) tan(phi)
        const double k =
            (kTanPhi * (normal + 2000) - driving - 2000) / (kWeight * (std::cos(b) + kTanPhi * std::sin(b)));
        CHECK(std::abs(accelerationOf(model) - k) < 3e-4);
    }

    TEST_CASE(
        "a column pushed at its top overturns when the push times its height is the weight times its lever") {
        Model model = floorModel(60, 1e12);
        addBox(model, "column", {0, 0, 0}, {0.2, 0.2, 1.0});
        const double weight = 2700 * 0.04 * 9.81, limit = weight * 0.1 / 1.0;
        for (const auto& [share, stands] : {std::pair{0.99, true}, {1.01, false}}) {
            model.loads = {{.kind = AppliedLoad::Kind::force,
                            .block = 1,
                            .force = {-share * limit, 0, 0},
                            .point = Vec3(0.1, 0.1, 1.0),
                            .field = "load[0]"}};
            const auto found = criticalAngle(model);
            REQUIRE(found.ok());
            CHECK((found->status == SearchStatus::unstable_at_start) == !stands);
            if (!stands) CHECK((found->mode == FailureMode::toppling));
        }
    }

    TEST_CASE(
        "a load's work is in the energy balance: a block on a soft floor under a force that comes at once") {
        Model model = floorModel(30, 1e7);
        model.joints[0].cohesion = model.joints[0].tensile_strength = 1e9;  // no slip that would take energy
        addBox(model, "key", {0, 0, 0}, {1, 1, 0.2});
        model.loads = {{.kind = AppliedLoad::Kind::force,
                        .block = 1,
                        .force = {0, 300, -4000},
                        .point = Vec3(0.6, 0.4, 0.2),
                        .field = "load[0]"}};
        model.run.start = RunSettings::Start::unstressed;
        model.run.time_step = 1e-5;
        model.run.duration = 0.1;
        model.run.frame_interval = 0.001;
        const Recorded recorded = record(model);
        REQUIRE(recorded.result.ok());
        double moved = 0;
        for (const LightFrame& frame : recorded.lights) {
            const double total = frame.kinetic_energy + frame.elastic_energy + frame.gravity_energy;
            moved = std::max(moved, frame.elastic_energy);
            CHECK(std::abs(total) <= 1e-4 * moved);
        }
        CHECK(moved > 1e-3);
    }
}

TEST_SUITE("slow: earthquakes") {
    TEST_CASE("the Hoek-Bray slope with k_h = 0.08, dry and with 2 m of water") {
        for (const auto& [name, factor, critical] : {std::tuple{"hoek-bray-crack-0m-shaken", 1.332, 0.2496},
                                                     {"hoek-bray-crack-2m-shaken", 1.173, 0.1703}}) {
            const Model model = verification(name);
            checkPublished(name, factorOf(model), factor);
            checkPublished(name, accelerationOf(model), critical);
            CHECK(limitAnalysis(model, Varied::horizontal)->upper >= critical * (1 - 0.005));
        }
    }

    TEST_CASE("a wedge shaken along the trend of its line of intersection") {
        checkPublished("k 0.05", factorOf(verification("wedge-phi-40-shaken-0.05")), 1.150);
        checkPublished("k 0.1", factorOf(verification("wedge-phi-40-shaken-0.1")), 1.041);
        checkPublished("k 0.2", factorOf(verification("wedge-phi-40-shaken-0.2")), 0.856);
    }
}
