// Derived quantities of contact points in frames: shares of the water's thrust, states, mobilised friction.

#include "frame/frame_readings.h"

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "engine/geometry/random_shapes.h"
#include "forces/contact_forces.h"
#include "forces/water.h"
#include "frame/frame.h"
#include "state/point_layout.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

double shareOf(const FullFrame& frame, std::size_t i) {
    double sum = 0;
    for (auto p = frame.interfaces.point_begin[i]; p < frame.interfaces.point_begin[i + 1]; ++p)
        sum += static_cast<double>(frame.points.water[static_cast<std::size_t>(p)]);
    return sum;
}

double shareOfAll(const FullFrame& frame) {
    double sum = 0;
    for (std::size_t i = 0; i < frame.interfaces.size(); ++i) sum += shareOf(frame, i);
    return sum;
}

/// Integral of rho g max(0, depth below the table) over a patch, by many small cells of its triangles.
double thrustBySampling(const State& state, std::size_t i, double table, double unit_weight) {
    const std::vector<Eigen::Vector2d> outline = patchOutline(state.interfaces, i);
    const RelativePose pose = relativePose(state, i);
    const Vec3 up(std::sin(state.load.tilt), 0, std::cos(state.load.tilt));
    constexpr int kCells = 60;
    double sum = 0;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        const Eigen::Vector2d a = outline[k] - outline[0], b = outline[k + 1] - outline[0];
        const double cell = 0.5 * (a.x() * b.y() - a.y() * b.x()) / (kCells * kCells);
        for (int u = 0; u < kCells; ++u)
            for (int v = 0; v < 2 * (kCells - u) - 1; ++v) {  // small triangles, upright and upside down
                const double s = u + (v % 2 == 0 ? 1.0 : 2.0) / 3.0,
                             t = v / 2 + (v % 2 == 0 ? 1.0 : 2.0) / 3.0;
                const Eigen::Vector2d at = outline[0] + (s * a + t * b) / kCells;
                const Vec3 x = pose.origin + at.x() * pose.e1 + at.y() * pose.e2;
                sum += cell * unit_weight * std::max(0.0, table - up.dot(x));
            }
    }
    return sum;
}

bool isVertical(const State& state, std::size_t i) { return std::abs(relativePose(state, i).e3.x()) > 0.999; }

}  // namespace

TEST_CASE(
    "addReadings: the shares of each interface add up to the water's thrust on its patch, partly wet or "
    "wholly") {
    Random random(95);
    for (int trial = 0; trial < 6; ++trial) {
        CAPTURE(trial);
        Model model = stackModel(2, 3, 1, 20);
        model.gravity.tilt = radians(random.uniform(0, 30));
        const double depth = random.uniform(0.02, 0.4);
        model.waters = {fissureAt(model, 0.2, depth)};
        for (const PointRule::Kind kind :
             {PointRule::Kind::vertex, PointRule::Kind::quarter, PointRule::Kind::corner}) {
            model.points = {kind, 0};
            State state = *buildState(model, false);
            updateForces(state, false);
            const FullFrame frame = fullFrameOf(state);
            const double table = lightFrameOf(state).water.table[0];
            double exact = 0;
            for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
                if (!isVertical(state, i)) {
                    CHECK(shareOf(frame, i) == 0);
                    continue;
                }
                const double thrust = thrustBySampling(state, i, table, 1000 * 9.81);
                CHECK(shareOf(frame, i) == doctest::Approx(thrust).epsilon(2e-3).scale(1));
                exact += thrust;
            }
            // Both walls have it, each row of blocks by itself; it counts once.
            double on_walls = 0;
            for (std::size_t w = 0; w < state.wet.size(); ++w) on_walls += state.wet.force.get(w).norm();
            CHECK(shareOfAll(frame) == within(1e-5, 0.5 * on_walls));
            CHECK(shareOfAll(frame) == doctest::Approx(exact).epsilon(2e-3).scale(1));
        }
    }
}

TEST_CASE("addReadings: two heads under a block are shared out to its base, and nowhere else") {
    Model model = stackModel(1, 2, 1, 20);
    Water water;
    water.kind = Water::Level::head;
    water.head = {0.3, 0.1};
    water.pair = {{0, 1}};
    water.field = "water[0]";
    model.waters = {water};
    State state = *buildState(model, false);
    updateForces(state, false);
    const FullFrame frame = fullFrameOf(state);
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        const bool base = std::min(state.interfaces.block_a[i], state.interfaces.block_b[i]) == 0;
        CHECK(shareOf(frame, i) ==
              doctest::Approx(base ? 1000 * 9.81 * 0.2 * 0.02 : 0.0).epsilon(1e-6).scale(1));
    }
}

TEST_CASE("addReadings: water shares follow the pressure, not the area alone") {
    Model model = stackModel(2, 1, 1, 20);
    model.waters = {fissureAt(model, 0.2, 0.1)};
    State state = *buildState(model, false);
    updateForces(state, false);
    const FullFrame frame = fullFrameOf(state);
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        if (!isVertical(state, i)) continue;
        const auto begin = static_cast<std::size_t>(frame.interfaces.point_begin[i]);
        const std::vector<ContactPoint> points = contactPoints(state, i);
        const RelativePose pose = relativePose(state, i);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double z =
                (pose.origin + points[k].position.x() * pose.e1 + points[k].position.y() * pose.e2).z();
            const double pressure = 1000 * 9.81 * std::max(0.0, 0.1 - z);
            // Sampled at the points the pressure adds up to the thrust: the vertex rule is exact for it.
            CHECK(static_cast<double>(frame.points.water[begin + k]) ==
                  doctest::Approx(points[k].area * pressure).epsilon(1e-5).scale(0.1));
        }
    }
}

TEST_CASE("addReadings: a point is open, sticks or slips, and says how much of its strength it uses") {
    Model model = floorModel(30, 1e9);
    addBox(model, "box", {0, 0, 0}, {1, 1, 1});
    model.gravity.magnitude = 0;
    State state = *buildState(model, false);
    const auto readAt = [&](double lift, double slide, double tilt) {
        State moved = state;
        moved.blocks.position[1].z += lift;
        moved.blocks.position[1].x += slide;
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(moved.blocks.orientation[1].w, moved.blocks.orientation[1].x,
                               moved.blocks.orientation[1].y, moved.blocks.orientation[1].z);
        const Eigen::Quaterniond now = turnAbout(Vec3::UnitY(), degrees(tilt)) * turn;
        moved.blocks.orientation[1] = {now.w(), now.x(), now.y(), now.z()};
        updateForces(moved, false);
        return fullFrameOf(moved).points;
    };
    const FramePoints open = readAt(1e-5, 0, 0), sticks = readAt(-1e-5, 2e-6, 0),
                      slips = readAt(-1e-5, 1e-4, 0), half = readAt(0, 0, 1e-5);
    REQUIRE(open.size() == 9);
    std::size_t open_halves = 0;
    for (std::size_t p = 0; p < 9; ++p) {
        CHECK((open.state[p] == PointState::open));
        CHECK(open.mobilised[p] == 0);
        CHECK((sticks.state[p] == PointState::sticking));
        CHECK(static_cast<double>(sticks.mobilised[p]) ==
              doctest::Approx(0.2 / std::tan(radians(30))).epsilon(1e-5));
        CHECK((slips.state[p] == PointState::slipping));
        CHECK(slips.mobilised[p] == doctest::Approx(1.0));
        CHECK(slips.water[p] == 0);
        open_halves += half.state[p] == PointState::open;
    }
    CHECK(open_halves >= 3);  // the side that was lifted
    CHECK(open_halves <= 6);
}
