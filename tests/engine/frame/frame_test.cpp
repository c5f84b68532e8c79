// Frames of a state: their content, and refusal of damaged frames.

#include "frame/frame.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "build/build.h"
#include "support/models.h"
#include "support/snapshots.h"

using namespace talus;
using namespace talus::test;

TEST_CASE("shares of the water's thrust add up to the exact thrust on the patch") {
    for (const double depth : {0.03, 0.05, 0.1, 0.25, 0.4}) {
        CAPTURE(depth);
        Model model = stackModel(2, 3, 1, 20);
        model.gravity.tilt = radians(10);
        model.waters = {fissureAt(model, 0.2, depth)};
        model.run.duration = 1e-6;
        const FullFrame full = record(model).fulls.front();
        // eq 16 over the three joints of 0.1 m x 0.1 m, from the lower to the higher end of each.
        double total = 0;
        for (const float share : full.points.water) total += static_cast<double>(share);
        const double wet = std::min(depth, 0.3);
        const double exact = 1000 * 9.81 * std::cos(radians(10)) * (depth * wet - 0.5 * wet * wet) * 0.1;
        CHECK(total == doctest::Approx(exact).epsilon(1e-6));
        for (std::size_t i = 0; i < full.interfaces.size(); ++i) {
            const bool vertical = std::abs(full.interfaces.origin_a.z[i]) < 1e-9;
            double share = 0;
            for (auto p = full.interfaces.point_begin[i]; p < full.interfaces.point_begin[i + 1]; ++p)
                share += static_cast<double>(full.points.water[static_cast<std::size_t>(p)]);
            if (!vertical) CHECK(share == 0);
        }
    }
}

TEST_CASE("rotation vectors give back the turn, small or large") {
    Model model = floorModel(20);
    addBox(model, "box", {0, 0, 1}, {0.2, 0.3, 0.4});
    State state = *buildState(model, false);
    for (const double angle : {1e-9, 0.3, 3.0, -2.0}) {
        const Vec3 axis = Vec3(1, -2, 0.5).normalized();
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, axis));
        const QuaternionArray& start = state.geometry->initial_orientation;
        const Eigen::Quaterniond now =
            turn * Eigen::Quaterniond(start[1].w, start[1].x, start[1].y, start[1].z);
        state.blocks.orientation[1].w = now.w(), state.blocks.orientation[1].x = now.x();
        state.blocks.orientation[1].y = now.y(), state.blocks.orientation[1].z = now.z();
        const LightFrame frame = lightFrameOf(state);
        const Vec3 read(frame.rotation.x[1], frame.rotation.y[1], frame.rotation.z[1]);
        CHECK((read - angle * axis).norm() < 1e-6 * std::abs(angle));
    }
}

TEST_CASE("the water table lies where the level says") {
    Model model = stackModel(2, 3, 1, 20);
    model.gravity.tilt = radians(10);
    model.waters = {fissureAt(model, 0.2, 0.25)};
    const LightFrame frame = lightFrameOf(*buildState(model, false));
    const Vec3 up(std::sin(radians(10)), 0, std::cos(radians(10)));
    // The joint's lowest wet point is (0.2, y, 0); the level is measured up along z, the joint's steepest
    // line.
    CHECK(frame.water.table[0] == doctest::Approx(up.dot(Vec3(0.2, 0, 0.25))));
    CHECK(frame.water.level[0] == 0.25);
    CHECK(frame.water.drained[0] == 0);
}

TEST_CASE("a frame that does not fit or is damaged is refused, and named") {
    const Model model = formats::parseScenario(runScenarioText("0.002"), "test.toml")->model;
    const FullFrame sound = record(model).fulls.back();
    const double nan = std::nan("");
    const std::vector<std::function<void(FullFrame&)>> damages = {
        [](FullFrame& f) { f.blocks.position.x.pop_back(); },
        [&](FullFrame& f) { f.blocks.position.x[2] = nan; },
        [&](FullFrame& f) { f.blocks.velocity.y[2] += 1e-6; },
        [](FullFrame& f) { f.interfaces.block_a[0] = 999; },
        [](FullFrame& f) { f.interfaces.block_b[0] = -1; },
        [](FullFrame& f) { f.interfaces.face_a[0] = 6; },
        [](FullFrame& f) { f.interfaces.joint[0] = 7; },
        [](FullFrame& f) { f.interfaces.area[0] = 0; },
        [](FullFrame& f) { f.interfaces.point_begin[1] = 1000000; },
        [](FullFrame& f) { f.interfaces.point_begin.clear(); },
        [](FullFrame& f) { f.interfaces.patch_begin[1] = 2; },
        [](FullFrame& f) { f.interfaces.patch_xi.pop_back(); },
        [](FullFrame& f) { f.points.area[0] = -1; },
        [](FullFrame& f) { f.points.bond.clear(); },
        [](FullFrame& f) { f.points.dilation.clear(); },
        [](FullFrame& f) { f.wet.block[0] = 55; },
        [](FullFrame& f) { f.wet.water[0] = 1; },
        [](FullFrame& f) { f.wet.water_begin.back() = 77; },
        [](FullFrame& f) { f.wet.vertex_begin[1] = 1; },
        [](FullFrame& f) { f.wet.vertex_x.assign(f.wet.vertex_x.size(), 1.0); },
        [&](FullFrame& f) { f.wet.vertex_y[0] = nan; },
        [](FullFrame& f) { f.waters.p0.push_back(0); },
        [](FullFrame& f) { f.waters.drained.clear(); },
        [](FullFrame& f) { f.laws.of(&Joint::cohesion).clear(); },
        [&](FullFrame& f) { f.laws.of(&Joint::cohesion)[0] = nan; },
        [](FullFrame& f) { f.search_position.z.clear(); },
        [](FullFrame& f) { f.search_margin = 0; },
        [](FullFrame& f) { f.progress.time_step = 0; },
        [&](FullFrame& f) { f.progress.next_frame = nan; },
        [](FullFrame& f) { f.loads.release = 0; },
        [](FullFrame& f) { f.state_hash ^= 1; },
    };
    CHECK(record(model, 10, &sound).result.ok());
    for (std::size_t k = 0; k < damages.size(); ++k) {
        CAPTURE(k);
        FullFrame damaged = sound;
        damages[k](damaged);
        const auto result = record(model, 10, &damaged).result;
        REQUIRE_FALSE(result.ok());
        CHECK(result.errors()[0].field.starts_with("full"));
    }
    Model other = model;
    other.blocks.pop_back();
    other.waters.clear();
    CHECK_FALSE(record(other, 10, &sound).result.ok());
}
