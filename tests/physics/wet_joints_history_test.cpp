// Time histories of a block on a plane that is wet in part: how fast it slides, where the energy goes, files and
// restarts, and failures that a search has found.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/files.h"
#include "support/snapshots.h"
#include "support/wet_slab.h"
#include "talus/analysis.h"
#include "talus/formats/failing.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kMass = 0.5 * 2700;  // of the block [kg]

/// Too steep for its wet joint, but not for a dry one. Its water is so light that it has no pressure.
WetSlab slidingSlab() { return {.tilt_deg = 30, .friction_deg = 33, .cohesion = 0}; }

Model slidingModel() {
    Model model = slidingSlab().byDepth();
    model.waters[0].density = 1e-6;
    model.run.duration = 0.2;
    model.run.frame_interval = 0.01;
    return model;
}

double tanFriction() { return slidingSlab().strength() * std::tan(radians(33)); }

/// g (sin(beta) - m tan(phi) cos(beta)).
double acceleration() {
    const double beta = slidingSlab().beta();
    return 9.81 * (std::sin(beta) - tanFriction() * std::cos(beta));
}

double slid(const LightFrame& from, const LightFrame& to) {
    return from.displacement.x[1] - to.displacement.x[1];
}

Recorded recorded(const Model& model, const FullFrame* resume = nullptr, int threads = 1) {
    Recorded all = record(model, 8, resume, {.threads = threads});
    for (const Error& error : all.result.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(all.result.ok());
    return all;
}

/// Continues the failure that a search has found; how far the block has slid at its end, and when that was.
std::pair<double, double> playFailure(const Model& model, const SearchResult& found, Varied varied) {
    formats::FailingLoad load;
    load.varied = varied;
    load.value = found.failing->load;
    load.contact_damping = found.failing->contact_damping;
    load.duration = 200;
    load.frame_interval = 0.5;
    std::vector<LightFrame> lights;
    RunOutput output;
    output.light = [&](LightFrame&& frame) { lights.push_back(std::move(frame)); };
    const auto result = runFailing(formats::failingModel(model, load), {}, output, *found.failing, 0.02);
    for (const Error& error : result.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(result.ok());
    REQUIRE(lights.size() > 3);
    return {slid(lights.front(), lights.back()), lights.back().time};
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("wet joints: a block slides with the friction of the wet and the dry part by their areas") {
        const Recorded run = recorded(slidingModel());
        const LightFrame &first = run.lights.front(), &last = run.lights.back();
        CHECK(acceleration() > 0);
        CHECK(-last.velocity.x[1] == doctest::Approx(acceleration() * last.time).epsilon(2e-3));
        CHECK(slid(first, last) ==
              doctest::Approx(0.5 * acceleration() * last.time * last.time).epsilon(2e-3));

        Model dry = slidingModel();
        dry.joints[0].wet_strength_factor = 1;
        CHECK(std::abs(recorded(dry).lights.back().velocity.x[1]) < 1e-6);
    }

    TEST_CASE("wet joints: what the weight does becomes motion, and friction of the weakened joint") {
        const Recorded run = recorded(slidingModel());
        const LightFrame &first = run.lights.front(), &last = run.lights.back();
        const auto energy = [](const LightFrame& frame) {
            return frame.kinetic_energy + frame.elastic_energy + frame.gravity_energy;
        };
        const double normal = kMass * 9.81 * std::cos(slidingSlab().beta());
        const double friction = tanFriction() * normal * slid(first, last);
        CHECK(energy(first) - energy(last) == doctest::Approx(friction).epsilon(2e-3));
    }

    TEST_CASE("wet joints: the uplift of the water counts beside the weaker joint") {
        Model model = slidingModel();
        model.waters[0].density = 1000;
        model.run.duration = 0.05;  // the wet part grows as the block slides
        const WetSlab slab = slidingSlab();
        const Recorded run = recorded(model);
        const double uplift = 0.5 * kWaterWeight * slab.share * slab.level() / kMass;
        const double expected =
            9.81 * std::sin(slab.beta()) - tanFriction() * (9.81 * std::cos(slab.beta()) - uplift);
        const LightFrame& last = run.lights.back();
        CHECK(-last.velocity.x[1] == doctest::Approx(expected * last.time).epsilon(1e-2));
    }

    TEST_CASE("wet joints: a history goes on from each full frame to the same bits") {
        const Recorded whole = recorded(slidingModel());
        REQUIRE(whole.fulls.size() >= 3);
        for (const FullFrame& from : whole.fulls)
            for (const int threads : {1, 3})
                CHECK(recorded(slidingModel(), &from, threads).result->state_hash ==
                      whole.result->state_hash);
    }

    TEST_CASE("wet joints: a file holds the joints of wet interfaces, and a run goes on from it") {
        formats::Scenario scenario;
        scenario.model = slidingModel();
        scenario.path = "slab.toml";
        const Recorded run = recorded(scenario.model);
        REQUIRE(run.geometry.wet_joints.size() == 1);
        const TemporaryFolder folder;
        REQUIRE(writeFile(folder / "a.mcap", scenario, run).empty());
        auto reader = formats::SnapshotReader::open(folder / "a.mcap");
        REQUIRE(reader.ok());
        CHECK(reader->verify().empty());
        REQUIRE(reader->header().joints.size() == 2);
        CHECK(reader->header().joints[0].name == "default");
        CHECK(reader->header().joints[1].name == "default@0.4wet");
        CHECK(std::tan(reader->header().joints[1].friction) == doctest::Approx(tanFriction()).epsilon(1e-12));
        const auto full = reader->full(1);
        REQUIRE(full.ok());
        CHECK(full->interfaces.joint.at(0) == 1);
        CHECK(recorded(scenario.model, &*full).result->state_hash == run.result->state_hash);
    }

    TEST_CASE("wet joints: steps by hand are those of a run") {
        const Model model = slidingModel();
        auto steps = Simulation::begin(std::make_shared<const Model>(model));
        REQUIRE(steps.ok());
        CHECK(steps->step(recorded(model).result->steps).empty());
        CHECK(steps->stateHash() == recorded(model).result->state_hash);
    }

    TEST_CASE(
        "wet joints: levels that change in a history leave the joints as wet as at its start, with a "
        "warning") {
        constexpr const char* kWarning =
            "joint.default.wet_strength_factor: joints stay as wet as at time 0, while the level of water[0] "
            "changes; talus storm takes what is wet at each level";
        const auto warned = [&](const Model& model) {
            const std::vector<std::string> warnings = recorded(model).result->warnings;
            return std::count(warnings.begin(), warnings.end(), kWarning);
        };
        Model model = slidingModel();
        CHECK(warned(model) == 0);
        model.waters[0].level = {{0, 0.4}, {1, 0.9}};
        CHECK(warned(model) == 1);
        model.joints[0].wet_strength_factor = 1;
        CHECK(warned(model) == 0);
    }

    TEST_CASE("wet joints: a failure that a search has found goes on with the strength of the search") {
        Control control;
        control.keep_failing_state = true;
        control.interval = false;
        WetSlab slab = slidingSlab();
        slab.tilt_deg = 15;
        Model model = slab.byDepth();
        model.waters[0].density = 1e-6;
        const auto weaker = safetyFactor(model, control);
        REQUIRE(weaker.ok());
        REQUIRE(weaker->failing != nullptr);
        const auto [way, time] = playFailure(model, *weaker, Varied::factor);
        const double beta = slab.beta(), divided = tanFriction() / weaker->failing->load;
        CHECK(way == doctest::Approx(0.5 * 9.81 * (std::sin(beta) - divided * std::cos(beta)) * time * time)
                         .epsilon(2e-2));
    }

    TEST_CASE("wet joints: a failure at a critical angle goes on as wet as the slope is there") {
        Control control;
        control.keep_failing_state = true;
        control.interval = false;
        WetSlab slab = slidingSlab();
        slab.tilt_deg = 15;
        Model model = slab.model();  // dries as it is tilted
        model.waters[0].density = 1e-6;
        const auto steeper = criticalAngle(model, control);
        REQUIRE(steeper.ok());
        REQUIRE(steeper->failing != nullptr);
        const double tilt = steeper->failing->load;
        CHECK(tilt > steeper->high);
        slab.share = std::round(1000 * slab.level() / std::sin(tilt)) / 1000;
        const auto [way, time] = playFailure(model, *steeper, Varied::tilt);
        const double tan_friction = slab.strength() * std::tan(radians(33));
        const double a = 9.81 * (std::sin(tilt) - tan_friction * std::cos(tilt));
        CHECK(a > 0);
        CHECK(way == doctest::Approx(0.5 * a * time * time).epsilon(2e-2));
    }
}
