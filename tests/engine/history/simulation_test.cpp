// A time history step by step: the bits of run(), views of its arrays, and interruptions.

#include <doctest/doctest.h>

#include <atomic>
#include <memory>

#include "support/models.h"
#include "support/snapshots.h"
#include "talus/formats/scenario.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

std::shared_ptr<const Model> modelOf(const std::string& text) {
    return std::make_shared<const Model>(formats::parseScenario(text, "test.toml")->model);
}

/// A cube that falls from half its size: flight, an impact, flight.
std::shared_ptr<const Model> fallingCube() {
    Model model = floorModel(30, 1e8);
    addTurnedCube(model, "cube", turnAbout({1, 2, 3}, 20), 0, 0, 0.05);
    model.run.duration = 0.2;
    model.run.frame_interval = 0.02;
    return std::make_shared<const Model>(model);
}

}  // namespace

TEST_CASE("Simulation: the bits of run() at every frame, on one thread and on two") {
    for (const auto& model : {modelOf(runScenarioText()), fallingCube()})
        for (const int threads : {1, 2}) {
            const Recorded whole = record(*model, 1);
            REQUIRE(whole.result.ok());
            auto simulation = Simulation::begin(model, {.threads = threads});
            REQUIRE(simulation.ok());
            for (const LightFrame& frame : whole.lights) {
                REQUIRE(simulation->step(frame.step - simulation->steps(), {.threads = threads}).empty());
                CHECK(simulation->stateHash() == frame.state_hash);
                CHECK(simulation->time() == frame.time);
            }
            CHECK((simulation->startedFrom() == whole.result->start));
        }
}

TEST_CASE("Simulation: continues beyond the duration of a run") {
    const auto model = fallingCube();
    auto simulation = Simulation::begin(model);
    REQUIRE(simulation.ok());
    const double fall = 2700 * 0.008 * 9.81 * 0.05;  // [J]
    while (simulation->time() < 0.5) REQUIRE(simulation->step(1000).empty());
    const HistoryRecord record = simulation->record();
    CHECK(record.time == simulation->time());
    CHECK(record.kinetic_energy + record.elastic_energy + record.gravity_energy < 1e-3 * fall);
}

TEST_CASE("Simulation: the view of its blocks shows the latest step") {
    auto simulation = Simulation::begin(fallingCube());
    REQUIRE(simulation.ok());
    const BlockView view = simulation->blocks();
    REQUIRE(view.size == 2);
    const double before = view.position[4 + 2];
    REQUIRE(simulation->step(100).empty());
    const double t = simulation->time();
    CHECK(view.position[4 + 2] - before == doctest::Approx(-0.5 * 9.81 * t * t));
    CHECK(view.velocity[2][1] == doctest::Approx(-9.81 * t));
    CHECK(view.quaternion[4] * view.quaternion[4] <= 1);
}

TEST_CASE("Simulation: can be interrupted and continued") {
    auto simulation = Simulation::begin(fallingCube());
    REQUIRE(simulation.ok());
    std::atomic<bool> stop = true;
    REQUIRE(simulation->step(1000, {.stop = &stop}).empty());
    CHECK(simulation->steps() < 1000);
    stop = false;
    const std::int64_t before = simulation->steps();
    REQUIRE(simulation->step(30, {.stop = &stop}).empty());
    CHECK(simulation->steps() == before + 30);
}

TEST_CASE("Simulation: a model that cannot be built is an error") {
    auto model = std::make_shared<Model>(*fallingCube());
    model->blocks.push_back(model->blocks.back());
    model->blocks.back().name = "inside";
    CHECK_FALSE(Simulation::begin(model).ok());
}
