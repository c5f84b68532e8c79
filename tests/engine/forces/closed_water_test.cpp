// The level of a closed volume follows from where its walls stand.

#include "forces/closed_water.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "build/build.h"
#include "checks/closed_volumes.h"
#include "forces/sum.h"
#include "forces/water.h"
#include "frame/frame.h"
#include "model/over_time.h"
#include "support/closed_fissure.h"
#include "support/relative.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr std::size_t kSlide = 1;

State begun(const Model& model) {
    State state = *buildState(model, false);
    beginClosedWater(state);
    updateWater(state);
    return state;
}

void move(State& state, std::size_t block, const Vec3& by) {
    state.blocks.position.set(block, state.blocks.position.get(block) + by);
}

/// Turns a block about a line along y through a point.
void turn(State& state, std::size_t block, const Vec3& through, double angle) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Vec3::UnitY()));
    const Quaternion o = state.blocks.orientation[block];
    const Eigen::Quaterniond turned = q * Eigen::Quaterniond(o.w, o.x, o.y, o.z);
    state.blocks.orientation[block] = {turned.w(), turned.x(), turned.y(), turned.z()};
    state.blocks.position.set(block, through + q * (state.blocks.position.get(block) - through));
}

/// Potential energy of the water: rho g (H V - integral of V(L) dL), along gravity above level 0.
double potential(State& state) {
    updateWater(state);
    constexpr int kParts = 4000;      // Simpson's rule
    constexpr double kEmpty = -0.02;  // [m] where a tilted table leaves the room behind the block dry, too
    const double level = state.closed.level[0], height = level - kEmpty;
    double sum = volumeBelow(state, 0, level);
    for (int k = 1; k < kParts; ++k)
        sum += (k % 2 == 0 ? 2 : 4) * volumeBelow(state, 0, kEmpty + height * k / kParts);
    const double integral = sum * height / (3 * kParts);
    return 1000 * 9.81 * std::cos(state.load.tilt) * (level * state.closed.volume[0] - integral);
}

}  // namespace

TEST_SUITE("engine") {
    TEST_CASE("closed water: the level is held until the volume begins, and follows the walls from then on") {
        const ClosedFissure fissure;
        State state = *buildState(fissure.model(), false);
        move(state, kSlide, {-0.001, 0, 0});
        updateWater(state);
        CHECK(levelNow(state, 0, 0) == 0.35);
        CHECK(closedWaterReports(state).empty());

        state = begun(fissure.model());
        CHECK(state.closed.volume[0] == near(fissure.volume(), 1e-12));
        CHECK(state.closed.width[0] == near(fissure.width, 1e-12));
        for (const double d : {1e-5, 0.001, 0.01, 0.02}) {
            CAPTURE(d);
            State moved = state;
            move(moved, kSlide, {-d, 0, 0});
            updateWater(moved);
            const double h = moved.closed.level[0], t = std::tan(fissure.tilt());
            CHECK(fissure.opening * h + d * h + 0.5 * d * d * t ==
                  near(fissure.volume() / fissure.width, 1e-12));
            const double at_block = fissure.depthAtBlock(d);
            const double thrust =
                0.5 * 1000 * 9.81 * std::cos(fissure.tilt()) * at_block * at_block * fissure.width;
            CHECK(waterOn(moved, kSlide).force.x() == near(-thrust, 1e-9));
            CHECK(moved.closed.run_over[0] == 0);
        }
    }

    TEST_CASE("closed water: one volume spans all slices") {
        Model model = stackModel(2, 3, 3, 20);
        model.waters = {fissureAt(model, 0.2, 0.2)};
        model.waters[0].closed = true;
        model.waters[0].opening = 0.002;
        State state = begun(model);
        CHECK(state.closed.width[0] == near(0.3, 1e-12));
        // The middle slice of the front column opens by 3 mm, its upper blocks by 1 mm more.
        for (std::size_t b = 1; b < model.blocks.size(); ++b) {
            const std::string& name = model.blocks[b].name;
            if (!name.starts_with("c1") || !name.ends_with("s2")) continue;
            move(state, b, {name == "c1r1s2" ? -0.003 : -0.004, 0, 0});
        }
        updateWater(state);
        // b 0.3 H + 0.1 (0.003 * 0.1 + 0.004 (H - 0.1)) = b 0.3 * 0.2
        const double h = (0.002 * 0.3 * 0.2 - 0.1 * 0.1 * (0.003 - 0.004)) / (0.002 * 0.3 + 0.1 * 0.004);
        CHECK(state.closed.level[0] == near(h, 1e-12));
        CHECK(waterOn(state, 1).force.x() < 0);
    }

    TEST_CASE("closed water: how deep a model is cut into fixed rock changes nothing") {
        const ClosedFissure fissure;
        const auto levelAfter = [&](double depth_of_rock, double d) {
            Model model = fissure.model();
            model.blocks[0].shape = *makeBox({-5, -5, -depth_of_rock - 1}, {20, 5, -depth_of_rock});
            model.blocks.push_back(box("base", {0, 0, -depth_of_rock}, {0.6, 0.1, 0}, 2700, Motion::fixed));
            model.blocks.push_back(
                box("behind", {0.6, 0, -depth_of_rock}, {1.0, 0.1, 0}, 2700, Motion::fixed));
            Water water = fissureAt(model, fissure.length, fissure.filled);
            water.base = -kInfinity;
            water.closed = water.ends_at_free_blocks = true;
            water.opening = fissure.opening;
            water.leak_aperture = 1e-4;
            water.leak_length = 1;
            model.waters = {water};
            State state = begun(model);
            move(state, kSlide, {-d, 0, 0});
            updateWater(state);
            CHECK(state.closed.volume[0] == near(fissure.volume(), 1e-12));
            const double level = state.closed.level[0];
            state.load.time = 1e-4;
            updateWater(state);
            return std::pair(level, state.closed.leaked[0]);
        };
        const auto [level, leaked] = levelAfter(0.5, 0.003);
        const auto [level_above_deep_rock, leaked_above_deep_rock] = levelAfter(2.0, 0.003);
        CHECK(level == near(level_above_deep_rock, 1e-12));
        CHECK(level < 0.2);
        CHECK(leaked > 0);
        CHECK(leaked == near(leaked_above_deep_rock, 1e-9));
    }

    TEST_CASE("closed water: pressure is the derivative of the water's potential energy") {
        for (const double tilt_deg : {0.0, 16.0}) {
            ClosedFissure fissure;
            fissure.tilt_deg = tilt_deg;
            State state = begun(fissure.model());
            const Vec3 edge = Vec3(0.6, 0, 0) - state.geometry->origin;
            move(state, kSlide, {-0.004, 0, 0});
            turn(state, kSlide, edge - Vec3(0.004, 0, 0), -0.01);
            const auto difference = [&](const auto& displace, double step) {
                State ahead = state, behind = state;
                displace(ahead, step);
                displace(behind, -step);
                return -(potential(ahead) - potential(behind)) / (2 * step);
            };
            updateWater(state);
            const Wrench water = waterOn(state, kSlide);
            const double along = difference(
                [](State& moved, double step) {
                    move(moved, kSlide, {step, 0, 0});
                },
                1e-5);
            CHECK(along == near(water.force.x(), 2e-3));
            const Vec3 foot = edge - Vec3(0.004, 0, 0);
            const Vec3 arm = state.blocks.position.get(kSlide) - foot;
            const double moment = water.torque.y() + arm.cross(water.force).y();
            const double about =
                difference([&](State& moved, double step) { turn(moved, kSlide, foot, step); }, 1e-5);
            CHECK(about == near(moment, 5e-3));
        }
    }

    TEST_CASE("closed water: what closes again gives its level back, and what rises too high runs over") {
        ClosedFissure fissure;
        State state = begun(fissure.model());
        move(state, kSlide, {-0.01, 0, 0});
        updateWater(state);
        CHECK(state.closed.level[0] < 0.1);
        move(state, kSlide, {0.01, 0, 0});
        updateWater(state);
        CHECK(state.closed.level[0] == near(0.35, 1e-9));
        move(state, kSlide,
             {0.001, 0, 0});  // half of the opening: it would stand at 0.7 m, in walls of 0.5 m
        updateWater(state);
        CHECK(state.closed.level[0] == near(0.5, 1e-12));
        CHECK(state.closed.run_over[0] > 0);
        CHECK(state.closed.run_over[0] + state.closed.volume[0] == near(fissure.volume(), 1e-12));
        const double left = state.closed.volume[0];
        updateWater(state);
        CHECK(state.closed.volume[0] == left);
    }

    TEST_CASE("closed water: a frame brings volume and level back") {
        ClosedFissure fissure;
        Model model = fissure.model();
        model.waters[0].inflow = {{0.0, 1e-3}};
        State state = begun(model);
        move(state, kSlide, {-0.003, 0, 0});
        state.load.time = 0.01;
        updateWater(state);
        const FullFrame frame = fullFrameOf(state);
        REQUIRE(frame.memory.size() == 5);
        CHECK(frame.memory[0].name == "water.begun");
        State again = *buildState(model, false);
        REQUIRE(restoreFrame(frame, again).empty());
        CHECK(again.closed.level == state.closed.level);
        CHECK(again.closed.volume == state.closed.volume);
        CHECK(again.closed.time == state.closed.time);
        updateWater(again);
        CHECK(again.closed.volume == state.closed.volume);
        CHECK(lightFrameOf(again).water.level[0] == state.closed.level[0]);

        model.waters[0].leak_aperture = 1e-3;
        State leaking = begun(model);
        leaking.load.time = 0.01;
        updateWater(leaking);
        const FullFrame of_leak = fullFrameOf(leaking);
        REQUIRE(of_leak.memory.size() == 6);  // files without a leak stay readable
        State restored = *buildState(model, false);
        REQUIRE(restoreFrame(of_leak, restored).empty());
        CHECK(leaking.closed.leaked[0] > 0);
        CHECK(restored.closed.leaked == leaking.closed.leaked);

        model.waters[0].closed = false;  // nothing is remembered of a level that is held
        CHECK(fullFrameOf(*buildState(model, false)).memory.empty());
    }

    TEST_CASE("closed water: a fissure has to be bounded, and not too flat") {
        ClosedFissure fissure;
        Model model = fissure.model();
        CHECK(checks::openVolumes(*buildState(model, false)).empty());
        const auto fault = [](const Model& of, const char* text) {
            const auto errors = checks::openVolumes(*buildState(of, false));
            REQUIRE(errors.size() == 1);
            CHECK(errors[0].field == "water[0].volume");
            CAPTURE(errors[0].message);
            CHECK(errors[0].message.find(text) != std::string::npos);
        };
        Model open = model;  // without the wall behind
        open.waters[0].walls.pop_back();
        fault(open, "found a fissure that is not bounded: walls of 0.035 m2 on one side and of 0 m2");
        Model lower = model;
        lower.blocks[kSlide].shape = *makeBox({0, 0, 0}, {0.6, 0.1, 0.3});
        fault(lower, "below the level; allowed: a fissure with walls on both sides up to there");
        lower.waters[0].level[0].value = 0.3;
        CHECK(checks::openVolumes(*buildState(lower, false)).empty());
        lower.waters[0].overflow = 0.4;
        fault(lower, "below the overflow");
        Model flat = model;
        flat.gravity.tilt = radians(85);
        fault(flat, "dips by 5 deg, allowed: at least 10 deg");
        flat.is_remainder = true;
        CHECK(checks::openVolumes(*buildState(flat, false)).empty());
    }

    TEST_CASE("closed water: an opening with which the water is stiffer than the joints") {
        ClosedFissure fissure;
        const auto doubts = [&] {
            return checks::stiffVolumes(*buildState(fissure.model(1e8), false), false);
        };
        CHECK(doubts().empty());
        fissure.opening = 1e-7;
        const auto stiff = doubts();
        REQUIRE(stiff.size() == 1);
        CHECK(stiff[0].field == "water[0].opening");
        CHECK(stiff[0].message.find("nearly as stiff as the joints") != std::string::npos);
    }

    TEST_CASE("the integral of a table over time is exact, in parts as at once") {
        const std::vector<LevelPoint> table{{1, 2}, {2, 4}, {4, 0}};
        CHECK(integralOver(table, 0, 1) == 2);
        CHECK(integralOver(table, 1, 2) == 3);
        CHECK(integralOver(table, 0, 9) == near(2 + 3 + 4, 1e-12));
        CHECK(integralOver(table, 1.5, 3) == near(0.5 * 0.5 * (3 + 4) + 0.5 * (4 + 2), 1e-12));
        CHECK(integralOver({{0, 3}}, 2, 4) == 6);
        double sum = 0;
        for (int k = 0; k < 50; ++k) sum += integralOver(table, 0.1 * k, 0.1 * (k + 1));
        CHECK(sum == near(integralOver(table, 0, 5), 1e-14));
    }
}
