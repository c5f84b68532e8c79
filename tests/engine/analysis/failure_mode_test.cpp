// The continuation of a failing state, on bodies whose motion is known.

#include "analysis/failure_mode.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasi_static.h"
#include "build/build.h"
#include "contacts/update.h"
#include "state/incidence.h"
#include "step/step.h"
#include "support/models.h"
#include "support/slower.h"
#include "support/validated.h"

using namespace talus;
using namespace talus::test;
using analysis::Failure;

namespace {

constexpr double kGravity = 9.81, kDensity = 2700;

/// A box of width x height on the floor, tilted, under its weight at once.
State tiltedBox(double width, double height, double tilt_deg, double friction_deg) {
    Model model = floorModel(friction_deg, 1e8);
    addBox(model, "box", {0, 0, 0}, {width, 1, height}, kDensity);
    model.gravity.tilt = radians(tilt_deg);
    return *buildState(model, false);
}

/// What its weight presses a box into the floor [m].
double deflection(double height) { return kDensity * kGravity * height / 1e8; }

Failure continued(State& state, double height, const Control& control = {}) {
    Failure failure = analysis::continueFailure(
        state, {.deflection = deflection(height), .share = 2e-4, .most_steps = 400'000}, control, false);
    checkValid(state);
    return failure;
}

}  // namespace

TEST_SUITE("analysis") {
    TEST_CASE(
        "continueFailure: a flat box beyond its friction angle slides, as far and as fast as Coulomb lets "
        "it") {
        State state = tiltedBox(1, 0.3, 30, 20);
        const Failure failure = continued(state, 0.3);
        CHECK((failure.mode == FailureMode::sliding));
        CHECK(failure.confirmed);
        CHECK_FALSE(failure.at_rest);
        CHECK(failure.moving_blocks == std::vector<std::string>{"box"});
        REQUIRE(failure.motions.size() == 1);
        const BlockMotion& motion = failure.motions[0];
        CHECK(motion.moving);
        CHECK((motion.mode == FailureMode::sliding));
        CHECK(motion.translation.x() < 0);
        CHECK(motion.rotation_share < 0.2);
        CHECK(motion.mobilised_friction > 0.9);
        CHECK(failure.motion >= 10 * deflection(0.3));
        // From rest, at least until it has gone ten deflections: g (sin - cos tan) t^2 / 2, less what settling takes.
        const double a = kGravity * (std::sin(radians(30)) - std::cos(radians(30)) * std::tan(radians(20)));
        CHECK(-motion.translation.x() ==
              doctest::Approx(0.5 * a * failure.seconds * failure.seconds).epsilon(0.15));
        CHECK(failure.seconds == doctest::Approx(static_cast<double>(failure.steps) * failure.time_step));
    }

    TEST_CASE("continueFailure: a slender column beyond its toe topples, about that toe") {
        State state = tiltedBox(0.3, 1, 25, 50);  // atan(0.3) = 16.7 degrees
        const Failure failure = continued(state, 1);
        CHECK((failure.mode == FailureMode::toppling));
        CHECK(failure.confirmed);
        REQUIRE(failure.motions.size() == 1);
        CHECK((failure.motions[0].mode == FailureMode::toppling));
        CHECK(failure.motions[0].rotation_share > 0.4);
        CHECK(failure.motions[0].open_share > 0.25);  // the upper third at least
        // The lower edge x = 0 stays where it is: the centroid's way is the turn times its distance from there.
        const double arm = std::hypot(0.15, 0.5);
        CHECK(failure.motions[0].translation.norm() ==
              doctest::Approx(arm * failure.motions[0].rotation).epsilon(0.1));
    }

    TEST_CASE(
        "continueFailure: a stack whose weight is laid on at once is not seen to fail where it stands, if "
        "nothing else says that it does") {
        // Without damping friction shakes the dry slope of the paper loose at 19 degrees: it stands to 19.5.
        for (const std::pair<int, int>& size : {std::pair{3, 3}, {7, 5}, {12, 5}})
            for (const double beyond : {-1.5, -0.5, 0.5, 1.5}) {
                const auto columns = size.first, rows = size.second;
                if (kTriesFew && columns * rows > 9) continue;
                CAPTURE(columns);
                CAPTURE(beyond);
                Model model = stackModel(columns, rows, 1, 19.5);
                model.gravity.tilt = radians(19.5 + beyond);
                State state = *buildState(model, false);
                const Failure failure = analysis::continueFailure(
                    state, {.deflection = 0, .share = 0.01, .most_steps = 100'000, .alone = true}, {}, false);
                CHECK(failure.confirmed == (beyond > 0));
                CHECK(failure.at_rest == (beyond < 0));
            }
    }

    TEST_CASE("continueFailure: what only settles comes to rest, and is no failure") {
        State state = tiltedBox(1, 0.3, 10, 30);
        const Failure failure = continued(state, 0.3);
        CHECK(failure.at_rest);
        CHECK_FALSE(failure.confirmed);
        CHECK(failure.motion < 5 * deflection(0.3));
        CHECK((failure.mode == FailureMode::none));
        CHECK(failure.moving_blocks.empty());
        REQUIRE(failure.motions.size() == 1);
        CHECK_FALSE(failure.motions[0].moving);
    }

    TEST_CASE("continueFailure: what is not borne out for long is asked for rest, once") {
        constexpr std::int64_t kDoubtedAfter = 3'000;
        struct Case {
            double tilt;
            bool is_held, stands;  // the others held at first; what is answered
            int asked;
        };
        for (const Case& c : {Case{10, false, false, 1},
                              {10, false, true, 1},
                              {10, true, false, 1},
                              {10, true, true, 1},
                              {33, false, true, 0},
                              {33, true, true, 0}}) {
            CAPTURE(c.tilt);
            CAPTURE(c.is_held);
            CAPTURE(c.stands);
            Model model = floorModel(30, 1e8);
            for (int k = 0; k < 5; ++k)
                addBox(model, "box" + std::to_string(k), {3.0 * k, 0, 0}, {1, 1, 0.3}, kDensity);
            model.gravity.tilt = radians(c.tilt);
            State state = *buildState(model, false);
            int asked = 0;
            const Failure failure = analysis::continueFailure(
                state,
                {.deflection = deflection(0.3),
                 .share = 2e-4,
                 .most_steps = 400'000,
                 .doubted_after = kDoubtedAfter,
                 .rests = [&] { return ++asked, c.stands; }},
                {}, false, c.is_held ? std::vector<std::size_t>{1} : std::vector<std::size_t>{});
            CHECK(asked == c.asked);
            CHECK(failure.is_doubted == (c.asked > 0));
            CHECK(failure.stands == (c.asked > 0 && c.stands));
            CHECK(failure.confirmed == (c.asked == 0));
            CHECK(failure.at_rest == (c.asked > 0 && !c.stands));
            if (failure.stands) CHECK(failure.steps == kDoubtedAfter);
        }
    }

    TEST_CASE("continueFailure: of two boxes only the one that slides is named, and the mode is its own") {
        Model model = floorModel(35, 1e8);
        model.joints.push_back(joint(15, 1e8));
        addBox(model, "stays", {3, 0, 0}, {1, 1, 0.3}, kDensity);
        addBox(model, "slides", {0, 0, 0}, {1, 1, 0.3}, kDensity);
        model.blocks[2].face_joint.assign(6, 1);
        model.gravity.tilt = radians(25);
        State state = *buildState(model, false);
        const Failure failure = continued(state, 0.3);
        CHECK((failure.mode == FailureMode::sliding));
        CHECK(failure.moving_blocks == std::vector<std::string>{"slides"});
        REQUIRE(failure.motions.size() == 2);
        CHECK_FALSE(failure.motions[0].moving);
        CHECK((failure.motions[0].mode == FailureMode::none));
        CHECK((failure.motions[1].mode == FailureMode::sliding));
    }

    TEST_CASE("continueFailure: a slide of all that moves is read at ten deflections, another at twenty") {
        for (const double friction : {10.0, 25.0, 40.0})
            for (const double width : {0.5, 1.0, 3.0})
                for (const double slower : {0.0, 0.2, 0.8}) {
                    CAPTURE(friction);
                    CAPTURE(width);
                    CAPTURE(slower);
                    // Just beyond its friction angle; a second box, or none, on a joint that leaves it this share of the acceleration.
                    const double tilt = radians(friction + 0.02), tan = std::tan(radians(friction));
                    const double of_second = std::tan(tilt) - slower * (std::tan(tilt) - tan);
                    Model model = floorModel(std::atan(of_second) * 180 / M_PI, 1e8);
                    model.joints.push_back(joint(friction, 1e8));
                    addBox(model, "first", {0, 0, 0}, {width, 1, 0.3}, kDensity);
                    model.blocks[1].face_joint.assign(6, 1);
                    if (slower > 0) addBox(model, "second", {5, 0, 0}, {width, 1, 0.3}, kDensity);
                    model.gravity.tilt = radians(friction - 0.02);
                    State state = *buildState(model, false);
                    const Control control;
                    analysis::QuasiStaticWork work = analysis::prepare(state, {}, control, 1e-5, false);
                    REQUIRE(
                        (analysis::bringOn(state, work, [](State&, double) {}).verdict == Verdict::stable));
                    state.load.tilt = tilt;
                    const Failure failure = continued(state, 0.3);
                    CHECK(failure.confirmed);
                    CHECK((failure.mode == FailureMode::sliding));
                    CHECK(failure.moving_blocks.size() == (slower > 0 ? 2 : 1));
                    const double deflections = failure.motion / deflection(0.3);
                    CAPTURE(failure.steps);
                    CAPTURE(deflections);
                    if (slower == 0.2)  // it has gone less than half as far, or stands
                        CHECK((deflections >= 20 && deflections < 25));
                    else
                        CHECK((deflections >= 10 && deflections < 13));
                }
    }

    TEST_CASE(
        "continueFailure: splinters on a sliding row cost no steps, and change neither mode nor names") {
        const auto rowWith = [](double splinter) {
            Model model = floorModel(20, 1e8);
            for (int k = 0; k < 5; ++k)
                addBox(model, "b" + std::to_string(k), {0.5 + 2.0 * k, 0, 0}, {1, 1, 0.3}, kDensity);
            if (splinter > 0) addBox(model, "splinter", {12, 0, 0}, Vec3(1, 1, 0.3) * splinter, kDensity);
            model.gravity.tilt = radians(30);
            State state = *buildState(model, false);
            return continued(state, 0.3);
        };
        const Failure without = rowWith(0);
        CHECK(without.confirmed);
        for (const double splinter : {1e-1, 1e-2, 1e-3}) {
            CAPTURE(splinter);
            const Failure with = rowWith(splinter);
            CHECK(with.confirmed);
            CHECK((with.mode == FailureMode::sliding));
            for (int k = 0; k < 5; ++k) {
                const std::string name = "b" + std::to_string(k);
                CHECK(std::count(with.moving_blocks.begin(), with.moving_blocks.end(), name) == 1);
            }
            // A box of that size has a frequency 1/sqrt(size) times as high: up to 32 times.
            CHECK(with.time_step > 0.2 * without.time_step);
            CHECK(with.steps < 6 * without.steps);
        }
    }

    TEST_CASE("continueFailure: a column that topples beside a block that slides is mixed") {
        Model model = floorModel(50, 1e8);
        model.joints.push_back(joint(10, 1e8));
        addBox(model, "topples", {3, 0, 0}, {0.3, 1, 1}, kDensity);
        addBox(model, "slides", {0, 0, 0}, {1, 1, 0.3}, kDensity);
        model.blocks[2].face_joint.assign(6, 1);
        model.gravity.tilt = radians(25);
        State state = *buildState(model, false);
        const Failure failure = continued(state, 1);
        CHECK((failure.mode == FailureMode::mixed));
        REQUIRE(failure.motions.size() == 2);
        CHECK((failure.motions[0].mode == FailureMode::toppling));
        CHECK((failure.motions[1].mode == FailureMode::sliding));
    }

    TEST_CASE("continueFailure: an interrupted one says how far it came") {
        const std::atomic<bool> stop{true};
        State state = tiltedBox(1, 0.3, 30, 20);
        const Failure failure = continued(state, 0.3, Control{.stop = &stop});
        CHECK(failure.steps == 0);
        CHECK(failure.motion == 0);
        CHECK_FALSE(failure.confirmed);
        CHECK((failure.mode == FailureMode::none));
    }

    TEST_CASE(
        "continueFailure: with all held that is far from what is known to leave, the same blocks move in the "
        "same way") {
        // Columns of boxes side by side, the boxes of one on a slick joint or high and narrow; each stands or fails by itself.
        struct Kind {
            Vec3 size;        // of a box of the column that fails [m]
            double friction;  // on its joints [deg]
            FailureMode mode;
        };
        for (const Kind& kind :
             {Kind{{1, 1, 0.3}, 15, FailureMode::sliding}, Kind{{0.8, 1, 0.2}, 10, FailureMode::sliding},
              Kind{{0.3, 1, 0.5}, 60, FailureMode::toppling}})
            for (const int high : {1, 3}) {
                CAPTURE(kind.friction);
                CAPTURE(high);
                Model model = floorModel(35, 1e8);
                model.joints.push_back(joint(kind.friction, 1e8));
                for (int column = 0; column < 6; ++column)
                    for (int k = 0; k < high; ++k) {
                        const bool fails = column == 2;
                        const Vec3 size = fails ? kind.size : Vec3(1, 1, 0.3);
                        addBox(model, "b" + std::to_string(column) + std::to_string(k),
                               {0.5 + 1.5 * column, 0, size.z() * k}, size, kDensity);
                        if (fails) model.blocks.back().face_joint.assign(6, 1);
                    }
                model.gravity.tilt = radians(25);
                const State state = *buildState(model, false);
                State all = state, part = state;
                const analysis::Evidence wanted{
                    .deflection = 2 * deflection(0.9), .share = 2e-4, .most_steps = 400'000};
                const Failure whole = analysis::continueFailure(all, wanted, {}, false);
                const Failure alone = analysis::continueFailure(part, wanted, {}, false,
                                                                {static_cast<std::size_t>(1 + 2 * high)});
                checkValid(part);
                CHECK(whole.confirmed);
                CHECK(alone.confirmed);
                if (high == 1) CHECK((whole.mode == kind.mode));
                CHECK((alone.mode == kind.mode));
                std::vector<std::string> column;
                for (int k = 0; k < high; ++k) column.push_back("b2" + std::to_string(k));
                CHECK(alone.moving_blocks == column);
                // Weight laid on at once sets all columns rocking, and the high ones enough to be named with it.
                if (high == 1) CHECK(whole.moving_blocks == column);
                CHECK(alone.motions.size() == model.blocks.size() - 1);
                CHECK(alone.time_step == whole.time_step);
                std::size_t rests = 0;
                for (const BlockMotion& motion : alone.motions) rests += motion.translation.isZero() ? 1 : 0;
                CHECK(rests == static_cast<std::size_t>(5 * high));
                CHECK(part.blocks.motion == state.blocks.motion);  // all are free again
                CHECK(countContacts(part.interfaces).interfaces > static_cast<std::size_t>(5 * high));
            }
    }

    TEST_CASE("continueFailure: where what moves touches what is held, all go on") {
        // A row on a slick floor, pushed by its upper end: held but for the four next to the end, it would not move as one.
        Model model = floorModel(10, 1e8);
        const int boxes = 24;
        for (int k = 0; k < boxes; ++k)
            addBox(model, "b" + std::to_string(k), {1.0 * k - 4, 0, 0}, {1, 1, 0.3}, kDensity);
        model.gravity.tilt = radians(20);
        const State state = *buildState(model, false);
        State all = state, part = state;
        const Failure whole = continued(all, 0.3);
        const Failure asked = analysis::continueFailure(
            part, {.deflection = deflection(0.3), .share = 2e-4, .most_steps = 400'000}, {}, false, {1});
        CHECK(whole.confirmed);
        CHECK(asked.confirmed);
        CHECK(asked.moving_blocks.size() == static_cast<std::size_t>(boxes));
        CHECK(asked.moving_blocks == whole.moving_blocks);
        CHECK(asked.motion == whole.motion);
        CHECK(asked.steps > whole.steps);  // those of the part are counted
        CHECK(part.blocks.position == all.blocks.position);
    }
}
