#include "equilibrium/parting.h"

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

const Vec3 kSize(0.4, 0.6, 1.0);

/// Boxes one on the other on a floor.
State tower(int boxes) {
    Model model = floorModel(30);
    for (int k = 0; k < boxes; ++k) addBox(model, "b" + std::to_string(k), {0, 0, kSize.z() * k}, kSize);
    return *buildState(model, false);
}

Parting partingOf(const State& state) { return {state, makeBalance(state), posesOf(state)}; }

/// A block turned about a point.
void turn(Poses& poses, std::size_t block, const Eigen::Quaterniond& by, const Vec3& about) {
    poses.position.set(block, about + by * (poses.position.get(block) - about));
    poses.turn[block] = by.toRotationMatrix() * poses.turn[block];
}

void shift(Poses& poses, std::size_t block, const Vec3& by) {
    poses.position.set(block, poses.position.get(block) + by);
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("parting: nothing where nothing has moved, and the displacement of a block that shifts") {
        const State state = tower(1);
        const Parting since = partingOf(state);
        CHECK(since.now(since.poses()) == 0);
        for (const Vec3& by : {Vec3(1e-3, 0, 0), Vec3(0, 2e-3, 0), Vec3(0, 0, 5e-4), Vec3(0.3, -0.4, 0)}) {
            Poses poses = since.poses();
            shift(poses, 1, by);
            CHECK(since.now(poses) == doctest::Approx(by.norm()).epsilon(1e-12));
        }
    }

    TEST_CASE("parting: a block that only turns about an edge parts at the opposite one, 2 w sin(t / 2)") {
        const State state = tower(1);
        const Parting since = partingOf(state);
        for (const double angle_deg : {0.01, 0.1, 1.0, 10.0}) {
            CAPTURE(angle_deg);
            Poses poses = since.poses();
            turn(poses, 1, turnAbout(-Vec3::UnitY(), angle_deg), {0, 0, 0});
            const double expected = 2 * kSize.x() * std::sin(radians(angle_deg) / 2);
            CHECK(since.now(poses) == doctest::Approx(expected).epsilon(1e-9));
        }
    }

    TEST_CASE("parting: a block that turns about the normal of its base parts at the farthest corner") {
        const State state = tower(1);
        const Parting since = partingOf(state);
        Poses poses = since.poses();
        turn(poses, 1, turnAbout(Vec3::UnitZ(), 2), {kSize.x() / 2, kSize.y() / 2, 0});
        const double arm = std::hypot(kSize.x(), kSize.y()) / 2;
        CHECK(since.now(poses) == doctest::Approx(2 * arm * std::sin(radians(1))).epsilon(1e-9));
    }

    TEST_CASE("parting: neighbours that move together do not part from each other") {
        const State state = tower(3);
        const Parting since = partingOf(state);
        const Eigen::Quaterniond by = turnAbout(-Vec3::UnitY(), 1);
        Poses together = since.poses();
        for (const std::size_t b : {1, 2, 3}) turn(together, b, by, {0, 0, 0});
        const double base = 2 * kSize.x() * std::sin(radians(0.5));
        CHECK(since.now(together) == doctest::Approx(base).epsilon(1e-9));
        // The upper two by themselves: their joint has gone on, and only the one below them parts.
        Poses upper = since.poses();
        for (const std::size_t b : {2, 3}) shift(upper, b, {2e-3, 0, 0});
        CHECK(since.now(upper) == doctest::Approx(2e-3).epsilon(1e-9));
        Poses apart = upper;
        shift(apart, 3, {3e-3, 0, 0});
        CHECK(since.now(apart) == doctest::Approx(3e-3).epsilon(1e-9));
    }

    TEST_CASE("parting: a block that touches nothing parts from where it was") {
        Model model = floorModel(30);
        addBox(model, "hangs", {0, 0, 1}, {1, 1, 1});
        const State state = *buildState(model, false);
        const Parting since = partingOf(state);
        Poses fallen = since.poses();
        shift(fallen, 1, {0, 0, -0.4});
        CHECK(since.now(fallen) == doctest::Approx(0.4));
    }

    TEST_CASE("parting counts from the poses it was made at") {
        const State state = tower(1);
        const Balance balance = makeBalance(state);
        Poses moved = posesOf(state);
        shift(moved, 1, {1e-3, 0, 0});
        const Parting since(state, balance, moved);
        CHECK(since.now(moved) == 0);
        CHECK(since.now(posesOf(state)) == doctest::Approx(1e-3).epsilon(1e-9));
    }
}
