// The failing state of a search, and the run that continues it.

#include <doctest/doctest.h>

#include <cmath>

#include "support/snapshots.h"
#include "talus/analysis.h"
#include "talus/formats/failing.h"

using namespace talus;

namespace {

/// A block on a plane that slides at 20 deg.
Model slidingBlock() {
    return formats::parseScenario(
               "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n[run]\nduration_s = 20.0\nframe_interval_s = "
               "0.05\n"
               "[gravity]\ntilt_deg = 20.1\n[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2600.0\n"
               "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 20.0\n"
               "[[stack]]\ncolumns = 1\nrows = 1\nslices = 1\nblock = [1.0, 1.0, 0.5]\n",
               "slope.toml")
        ->model;
}

}  // namespace

TEST_CASE("a search that returns its failing state finds what it finds without") {
    const Model model = slidingBlock();
    const SearchResult plain = *criticalAngle(model);
    Control control;
    control.keep_failing_state = true;
    const SearchResult keeping = *criticalAngle(model, control);
    CHECK(plain.failing == nullptr);
    REQUIRE(keeping.failing != nullptr);
    CHECK(keeping.state_hash == plain.state_hash);
    CHECK(keeping.steps == plain.steps);
    CHECK(keeping.answer == plain.answer);
    CHECK(keeping.failing->load >= keeping.high);
    CHECK(keeping.failing->contact_damping > 0);
    CHECK(keeping.failing->block_size == doctest::Approx(0.5));
    CHECK(keeping.failing->state.state_hash == hashOf(keeping.failing->state));
}

TEST_CASE(
    "a failing run starts at rest, slides as Coulomb says, and ends at the first frame that is far enough") {
    const Model model = slidingBlock();
    Control control;
    control.keep_failing_state = true;
    const SearchResult search = *criticalAngle(model, control);
    REQUIRE(search.failing != nullptr);
    std::vector<LightFrame> lights;
    std::vector<FullFrame> fulls;
    RunOutput output;
    output.frames_per_full = 1000;
    output.light = [&](LightFrame&& frame) { lights.push_back(std::move(frame)); };
    output.full = [&](FullFrame&& frame) { fulls.push_back(std::move(frame)); };
    const auto result = runFailing(model, Control{}, output, *search.failing, 0.25);
    REQUIRE(result.ok());
    REQUIRE(lights.size() > 10);
    CHECK(lights.front().time == 0);
    CHECK(lights.front().step == 0);
    CHECK(lights.front().kinetic_energy == 0);
    const auto way = [&](const LightFrame& frame) {
        return -(frame.displacement.x[1] - lights.front().displacement.x[1]);
    };
    CHECK(way(lights.back()) >= 0.25);
    CHECK(way(lights[lights.size() - 2]) < 0.25);
    CHECK(fulls.size() == 2);  // at the start and at the end
    CHECK(fulls.back().step == lights.back().step);
    // a = g (sin(beta) - cos(beta) tan(phi)), from rest.
    constexpr double kDegree = 0.017453292519943295;
    const double a = 9.81 * (std::sin(20.1 * kDegree) - std::cos(20.1 * kDegree) * std::tan(20.0 * kDegree));
    const double t = lights.back().time;
    CHECK(way(lights.back()) == doctest::Approx(0.5 * a * t * t).epsilon(0.01));
}

TEST_CASE("a failing run of a slope with reduced strength slides with the strengths of the search") {
    // tan(phi) over the factor is not the tangent of an angle: the strengths are the state's own.
    constexpr double kDegree = 0.017453292519943295, kTilt = 10 * kDegree;
    Model model = slidingBlock();
    model.gravity.tilt = kTilt;
    Control control;
    control.keep_failing_state = true;
    const SearchResult search = *safetyFactor(model, control);
    REQUIRE(search.failing != nullptr);
    formats::FailingLoad weakened;
    weakened.varied = Varied::factor;
    weakened.value = search.failing->load;
    weakened.contact_damping = search.failing->contact_damping;
    weakened.duration = 200;
    weakened.frame_interval = 0.5;
    std::vector<LightFrame> lights;
    RunOutput output;
    output.light = [&](LightFrame&& frame) { lights.push_back(std::move(frame)); };
    const auto result =
        runFailing(formats::failingModel(model, weakened), Control{}, output, *search.failing, 0.02);
    REQUIRE(result.ok());
    REQUIRE(lights.size() > 3);
    const double a =
        9.81 * (std::sin(kTilt) - std::cos(kTilt) * std::tan(20 * kDegree) / search.failing->load);
    REQUIRE(a > 0);
    const double t = lights.back().time;
    const double slid = lights.front().displacement.x[1] - lights.back().displacement.x[1];
    CHECK(slid == doctest::Approx(0.5 * a * t * t).epsilon(0.02));
}

TEST_CASE("a damaged state is refused") {
    const Model model = slidingBlock();
    Control control;
    control.keep_failing_state = true;
    FailingState failing = *criticalAngle(model, control)->failing;
    failing.state.blocks.position.x[1] += 0.1;
    CHECK_FALSE(runFailing(model, Control{}, RunOutput{}, failing, 1).ok());
}
