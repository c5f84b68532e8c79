// Bodies of several convex parts: what they do in closed form, and what a convex block does that is cut in
// parts.

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "contacts/overlap.h"
#include "measure/measure.h"
#include "state/incidence.h"
#include "step/step.h"
#include "support/bodies.h"
#include "support/impacts.h"
#include "support/snapshots.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

SearchResult critical(const Model& model) {
    const auto result = criticalAngle(model);
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    return *result;
}

Model onFloor(Polyhedron shape, double friction_deg, double stiffness = 1e11) {
    Model model = floorModel(friction_deg, stiffness);
    model.analysis.start = 0;
    model.analysis.stop = radians(80);
    addBody(model, "body", std::move(shape));
    return model;
}

/// The same about the vertical: what was at the back is the toe.
Polyhedron turnedRound(Polyhedron shape) {
    return moved(std::move(shape), turnAbout(Vec3::UnitZ(), 180), {1, 0.5, 0});
}

void checkToppling(const std::vector<Corners>& boxes, const Polyhedron& shape, double toe) {
    CAPTURE(boxes.size());
    const Vec3 centroid = massProperties(shape).centroid;
    const double expected = degrees(std::atan2(centroid.x() - toe, centroid.z()));
    const SearchResult result = critical(onFloor(shape, 75));
    MESSAGE("overturns at " << degrees(result.answer) << " deg, expected " << expected);
    CHECK(std::abs(degrees(result.answer) - expected) < 0.025);
    CHECK((result.mode == FailureMode::toppling));
    CHECK(result.moving_blocks == std::vector<std::string>{"body"});
}

/// Where a run ends, of its last block.
struct End {
    Vec3 displacement, rotation;
    double kinetic, energy_gained;
};

End endOf(Model model, double seconds, double frames = 0.01) {
    model.run.duration = seconds;
    model.run.frame_interval = frames;
    model.run.start = RunSettings::Start::unstressed;
    const Recorded all = record(model);
    REQUIRE(all.result.ok());
    const LightFrame& first = all.lights.front();
    const LightFrame& last = all.lights.back();
    const auto energy = [](const LightFrame& f) {
        return f.kinetic_energy + f.elastic_energy + f.gravity_energy;
    };
    double gained = 0;
    for (const LightFrame& frame : all.lights) gained = std::max(gained, energy(frame) - energy(first));
    const auto get = [&](const VectorList<float>& list) {
        return Vec3(list.x.back(), list.y.back(), list.z.back());
    };
    return {get(last.displacement), get(last.rotation), last.kinetic_energy, gained};
}

/// A floor in parts: a middle strip between `low` and `high` along x, and what is left on either side.
Model floorInParts(double friction_deg, double stiffness, const std::vector<double>& seams) {
    Model model = floorModel(friction_deg, stiffness);
    std::vector<Corners> boxes;
    double from = -5;
    for (std::size_t k = 0; k <= seams.size(); ++k) {
        const double to = k < seams.size() ? seams[k] : 20;
        boxes.emplace_back(Vec3(from, -5, -1), Vec3(to, 5, 0));
        from = to;
    }
    model.blocks.clear();
    addBody(model, "floor", bodyOf(boxes), Motion::fixed);
    return model;
}

/// The same of blocks that lie side by side.
Model floorOfBlocks(double friction_deg, double stiffness, const std::vector<double>& seams) {
    Model model = floorInParts(friction_deg, stiffness, seams);
    const std::vector<Polyhedron> parts = partsOf(model.blocks[0].shape);
    model.blocks.clear();
    for (const Polyhedron& part : parts)
        addBody(model, "floor" + std::to_string(model.blocks.size()), part, Motion::fixed);
    return model;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("bodies of several parts slide at their friction angle") {
        for (const auto& boxes : {angle(), channel()}) {
            const SearchResult result = critical(onFloor(bodyOf(boxes), 15));
            CHECK(std::abs(degrees(result.answer) - 15) < 0.015);
            CHECK((result.mode == FailureMode::sliding));
        }
    }

    TEST_CASE("an angle and a channel overturn where their weight leaves their base") {
        checkToppling(angle(), bodyOf(angle()), 0);
        checkToppling(angle(), turnedRound(bodyOf(angle())), 0);
        checkToppling(channel(), bodyOf(channel()), 0);
        // Upside down, on the end of its upright.
        const Polyhedron gallows = moved(bodyOf(angle()), turnAbout(Vec3::UnitX(), 180), {0, 0.4, 0.8});
        const Vec3 centroid = massProperties(gallows).centroid;
        CHECK(centroid.x() > 0.2);  // it falls to the other side by itself
        const auto result = criticalAngle(onFloor(gallows, 60));
        REQUIRE(result.ok());
        CHECK((result->status == SearchStatus::unstable_at_start));
    }

    TEST_CASE("limit analysis has the same ceilings") {
        const Polyhedron shape = bodyOf(angle());
        const Vec3 centroid = massProperties(shape).centroid;
        const auto limit = limitAnalysis(onFloor(shape, 75), Varied::tilt);
        REQUIRE(limit.ok());
        CHECK(limit->upper == doctest::Approx(std::atan2(centroid.x(), centroid.z())).epsilon(1e-4));
        CHECK(limit->blocks == 1);
    }

    TEST_CASE("a block in eight parts slides and overturns as the whole one") {
        for (const double friction : {20.0, 60.0}) {
            const Vec3 low(0, 0, 0), high(0.3, 0.4, 0.7);
            const SearchResult whole = critical(onFloor(*makeBox(low, high), friction)),
                               parts = critical(onFloor(inEight(low, high), friction));
            MESSAGE(degrees(whole.answer) << " and " << degrees(parts.answer) << " deg");
            CHECK(std::abs(degrees(whole.answer) - degrees(parts.answer)) < 0.011);
            CHECK((whole.mode == parts.mode));
        }
    }

    TEST_CASE("a channel straddles a fixed beam without touching its sides, and rests on its top") {
        // The beam is higher than the channel's legs: it hangs on the inner side of its own beam.
        Model model = floorModel(30, 1e9);
        model.blocks.push_back(box("beam", {0.25, -1, 0}, {0.75, 1, 0.5}, 2700, Motion::fixed));
        addBody(model, "channel", moved(bodyOf(channel()), {0, 0, 0.1}));
        const Result<State> state = buildState(model, false);
        REQUIRE(state.ok());
        double on_beam = 0;
        for (std::size_t i = 0; i < state->interfaces.size(); ++i)
            if (!isVertexEdge(state->interfaces, i) && state->interfaces.block_a[i] == 1 &&
                std::abs(state->interfaces.frame(i).e1_a.cross(state->interfaces.frame(i).e2_a).z()) > 0.99)
                on_beam += state->interfaces.area[i];
        CHECK(on_beam == doctest::Approx(0.5 * 0.3));
        model.damping.mass = 50;
        const End end = endOf(model, 0.5, 0.1);
        const double weight = 2700 * 9.81 * massProperties(bodyOf(channel())).volume;
        CHECK(end.displacement.z() == doctest::Approx(-weight / (1e9 * 0.15)).epsilon(1e-3));
    }

    TEST_CASE("inner faces make no interface, nor do faces of one body with each other") {
        Model model = floorModel(30, 1e9);
        addBody(model, "body", inEight({0, 0, 0}, {1, 0.6, 0.4}));
        const Result<State> state = buildState(model, false);
        REQUIRE(state.ok());
        CHECK(state->blocks.size() == 2);
        std::size_t faces = 0;
        double area = 0;
        for (std::size_t i = 0; i < state->interfaces.size(); ++i) {
            if (isVertexEdge(state->interfaces, i)) continue;
            ++faces;
            area += state->interfaces.area[i];
        }
        CHECK(faces == 4);
        CHECK(area == doctest::Approx(0.6));
        CHECK(greatestOverlap(*state) < 1e-12);
    }

    TEST_CASE("a block slides over seams of its floor as over one face") {
        const auto slide = [](Model model) {
            addBox(model, "body", {0.5, 0, 0}, {0.4, 0.4, 0.2});
            model.gravity.tilt = radians(30);
            model.damping.contact = 1e-4;
            return endOf(std::move(model), 0.3);
        };
        const std::vector<double> seams{0.1, 0.35, 0.47, 0.7};
        const End whole = slide(floorModel(20, 1e9)), parts = slide(floorInParts(20, 1e9, seams)),
                  blocks = slide(floorOfBlocks(20, 1e9, seams));
        const double expected = -0.5 * 9.81 * (0.5 - std::tan(radians(20)) * std::sqrt(0.75)) * 0.09;
        MESSAGE("way " << expected << ", " << whole.displacement.x() << ", " << parts.displacement.x()
                       << " and " << blocks.displacement.x() << " m");
        // It drops onto its springs first, which is what makes it go 0.2 % farther.
        for (const End& end : {whole, parts, blocks})
            CHECK(end.displacement.x() == doctest::Approx(expected).epsilon(3e-3));
        CHECK((parts.displacement - blocks.displacement).norm() < 1e-4 * std::abs(expected));
        CHECK(parts.rotation.norm() < 1e-4);
    }

    TEST_CASE(
        "a cube that lands on a corner beside a seam, or on an edge across it, bounces as from one face") {
        for (const double turn : {0.0, 45.0})
            for (const double beside : {2e-5, 5e-4, 0.03}) {
                CAPTURE(turn);
                CAPTURE(beside);
                const auto bounce = [&](Model model) {
                    const auto corner = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ());
                    addTurnedCube(model, "cube", turn == 0 ? corner : turnAbout(Vec3::UnitX(), turn), 0, 0,
                                  0.02);
                    return endOf(std::move(model), 0.12);
                };
                // The lowest corner is below the middle; of the edge, which lies along x, both ends are over
                // other parts.
                const End whole = bounce(floorModel(30, 1e8)),
                          parts = bounce(floorInParts(30, 1e8, {beside}));
                CHECK(whole.displacement.z() > -0.02);
                CHECK((whole.displacement - parts.displacement).norm() < 1e-4);
                CHECK((whole.rotation - parts.rotation).norm() < 1e-2);
                CHECK(parts.energy_gained < 1e-6 * parts.kinetic + 1e-9);
            }
    }

    TEST_CASE("a cross in free flight keeps its energy and its angular momentum") {
        Model model = floorModel(30);
        model.gravity.magnitude = 0;
        addBody(model, "cross", moved(bodyOf(cross()), turnAbout({1, 2, 3}, 40), {0, 0, 5}));
        Result<State> state = buildState(model, false);
        REQUIRE(state.ok());
        setSpin(*state, {Vec3::Zero(), Vec3(3, -2, 5)});
        const Vec3 momentum = state->blocks.angular_momentum.get(1);
        const double energy = kineticEnergy(*state);
        CHECK(energy > 1);
        for (int k = 0; k < 200; ++k) {
            advance(*state, {1e-4, false}, 20, [](int) {});
            CHECK((state->blocks.angular_momentum.get(1) - momentum).norm() == 0);
            CHECK(std::abs(kineticEnergy(*state) - energy) < 1e-6 * energy);
        }
    }
}

TEST_SUITE("determinism") {
    TEST_CASE("restart: bodies of several parts that fall on each other end in the same bits") {
        Model model = floorInParts(30, 1e8, {0.3});
        addBody(model, "angle", moved(bodyOf(angle()), turnAbout({1, 1, 0}, 25), {0, 0, 0.4}));
        addBody(model, "channel", moved(bodyOf(channel()), turnAbout({0, 1, 0.3}, 70), {0.6, 0.1, 1.6}));
        addBody(model, "cross", moved(bodyOf(cross()), turnAbout({0, 1, 1}, 30), {1.4, 0.1, 0.6}));
        model.damping.contact = 1e-4;
        model.run.duration = 0.5;
        model.run.frame_interval = 0.02;
        const Recorded whole = record(model, 6);
        for (const Error& error : whole.result.errors()) FAIL_CHECK(error.message);
        REQUIRE(whole.result.ok());
        REQUIRE(whole.fulls.size() >= 3);
        for (const FullFrame& from : whole.fulls)
            for (const int threads : {1, 3}) {
                const Recorded resumed = record(model, 6, &from, {.threads = threads});
                REQUIRE(resumed.result.ok());
                CHECK(resumed.result->state_hash == whole.result->state_hash);
            }
        REQUIRE(whole.geometry.face_part.size() == whole.geometry.face_joint.size());
        CHECK(whole.geometry.isInner(0) == false);
        double gained = 0, most = 0;
        const auto energy = [](const LightFrame& f) {
            return f.kinetic_energy + f.elastic_energy + f.gravity_energy;
        };
        for (const LightFrame& frame : whole.lights) {
            gained = std::max(gained, energy(frame) - energy(whole.lights.front()));
            most = std::max(most, frame.kinetic_energy);
        }
        CHECK(gained < 1e-6 * most);
    }
}
