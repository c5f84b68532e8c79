// Blocks that hit thin plates: they are thrown back, and whoever gets more than half way through is named.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/models.h"
#include "talus/frame.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kSide = 0.3;  // of the cube [m]

struct Impact {
    double thickness;  ///< of the plate, top at z = 0 [m]
    double speed;      ///< downwards [m/s]
    double sideways;   ///< of the speed, along x
    Eigen::Quaterniond turn;
    Motion plate = Motion::fixed;
    bool in_parts = false;  ///< the plate is of eight parts
};

Model modelOf(const Impact& impact) {
    constexpr double kStiffness = 1e10, kAbove = 0.05;
    Model model = floorModel(30, kStiffness);
    model.joints[0].restitution_normal = 0.3;
    model.blocks.clear();
    const Vec3 low(-4, -4, -impact.thickness), high(5, 5, 0);
    if (impact.in_parts) {
        // Cut at 0.45 of its length and breadth.
        std::vector<Corners> parts;
        for (const double x : {0.0, 0.45})
            for (const double y : {0.0, 0.45}) {
                const Vec3 from(low.x() + 9 * x, low.y() + 9 * y, low.z());
                parts.emplace_back(from,
                                   Vec3(x > 0 ? 5 : low.x() + 9 * 0.45, y > 0 ? 5 : low.y() + 9 * 0.45, 0));
            }
        addBody(model, "plate", bodyOf(parts), impact.plate);
    } else {
        addBody(model, "plate", *makeBox(low, high), impact.plate);
    }
    addTurnedCube(model, "cube", impact.turn, 0.3, 0.4, kAbove, kSide);
    model.blocks[1].velocity = {impact.sideways * impact.speed, 0, -impact.speed};
    model.gravity.magnitude = 9.81;
    model.run.duration = 1.0;
    return model;
}

struct Outcome {
    double deepest = 0;   ///< lowest vertex below the plate's top, at any look [m]
    double share = 0;     ///< of the plate's thickness, or of the cube's height there if that is less
    bool passed = false;  ///< its centre came out below the plate
    double speed = 0;     ///< at the end, upwards [m/s]
    std::vector<std::string> warnings{};
};

/// Where the cube is against the plate, looked at as often as the history looks at contacts.
Outcome play(const Impact& impact) {
    const auto model = std::make_shared<const Model>(modelOf(impact));
    auto simulation = *Simulation::begin(model, {.threads = 1});
    const auto place = [&](std::size_t b) {
        const BlockView view = simulation.blocks();
        const double *p = view.position + 4 * b, *q = view.quaternion + 4 * b;
        return std::pair(Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
                         Vec3(view.origin + Vec3(p[0], p[1], p[2])));
    };
    const auto [first_turn, first_place] = place(1);
    const double plate_first = place(0).second.z();
    Outcome outcome;
    const double until = 5 * (0.05 + impact.thickness) / impact.speed + 4e-3;
    while (simulation.time() < until) {
        REQUIRE(simulation.step(10).empty());
        const auto [turn, at] = place(1);
        const double top = place(0).second.z() - plate_first;
        double lowest = kInfinity, highest = -kInfinity;
        for (const Vec3& v : model->blocks[1].shape.vertices) {
            const double height = (at + turn * (first_turn.inverse() * (v - first_place))).z() - top;
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
        outcome.deepest = std::max(outcome.deepest, -lowest);
        outcome.share = std::max(outcome.share, -lowest / std::min(impact.thickness, highest - lowest));
        outcome.passed = outcome.passed || at.z() - top < -impact.thickness;
    }
    outcome.speed = simulation.blocks().velocity[2][1];
    for (const std::string& warning : simulation.frame().warnings)
        if (warning.find("overlap by") != std::string::npos) outcome.warnings.push_back(warning);
    return outcome;
}

std::vector<Eigen::Quaterniond> turns() {
    return {Eigen::Quaterniond::Identity(), turnAbout({0, 1, 0}, 2), turnAbout({1, 0.3, 0}, 20),
            turnAbout({0, 1, 0}, 45), Eigen::Quaterniond::FromTwoVectors(Vec3::Ones(), -Vec3::UnitZ())};
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a fast cube does not fall through a plate of two centimetres, and both are named") {
        const Outcome flat = play({0.02, 60, 0, Eigen::Quaterniond::Identity()});
        CHECK_FALSE(flat.passed);
        // As by a plate that is thick enough.
        const Outcome thick = play({0.06, 60, 0, Eigen::Quaterniond::Identity()});
        CHECK(thick.warnings.empty());
        CHECK(flat.speed == doctest::Approx(thick.speed).epsilon(0.005));
        CHECK(flat.speed > 0.3 * 60);
        // v sqrt(m / k A): the energy of the impact in the springs of the whole face.
        CHECK(flat.deepest == doctest::Approx(60 * std::sqrt(2700 * kSide / 1e10)).epsilon(0.02));
        REQUIRE(flat.warnings.size() == 1);
        CHECK(flat.warnings[0].find("blocks \"plate\" and \"cube\" overlap by 0.01") == 0);
        CHECK(flat.warnings[0].find("thickness of \"plate\" there, 0.02 m") != std::string::npos);
        CHECK(flat.warnings[0].find(" at t = 0.00") != std::string::npos);
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE(
        "whatever the plate, the speed and the angle: what gets half way through is named, and nothing "
        "else") {
        int played = 0, passed = 0, warned = 0, thrown_back = 0;
        for (const Motion plate : {Motion::fixed, Motion::free})
            for (const bool in_parts : {false, true})
                for (const double thickness : {0.005, 0.02, 0.1, 0.5})
                    for (const double speed : {1.0, 10.0, 60.0, 300.0})
                        for (const double sideways : {0.0, 0.7})
                            for (const Eigen::Quaterniond& turn : turns()) {
                                if (in_parts && sideways > 0) continue;
                                const Impact impact{thickness, speed, sideways, turn, plate, in_parts};
                                CAPTURE(thickness);
                                CAPTURE(speed);
                                CAPTURE(sideways);
                                CAPTURE(turn.coeffs().transpose());
                                CAPTURE(static_cast<int>(plate));
                                CAPTURE(in_parts);
                                const Outcome outcome = play(impact);
                                CAPTURE(outcome.share);
                                CHECK(outcome.warnings.size() <= 1);
                                const bool named = !outcome.warnings.empty();
                                if (outcome.passed) CHECK(named);
                                if (outcome.share > 0.55) CHECK(named);
                                if (outcome.share < 0.45) CHECK_FALSE(named);
                                ++played;
                                passed += outcome.passed;
                                warned += named;
                                thrown_back += named && !outcome.passed;
                            }
        MESSAGE(played << " impacts: " << warned << " warned of, " << passed << " passed, " << thrown_back
                       << " of those warned of thrown back");
        CHECK(warned > played / 10);
        CHECK(warned < played * 9 / 10);
        CHECK(passed < warned / 4);
    }
}
