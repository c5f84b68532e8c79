#include "build/build.h"

#include <doctest/doctest.h>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A column with water behind it up to an elevation, all of it moved by `shift`.
Model wetColumn(const Vec3& shift) {
    Model model = stackModel(1, 3, 1, 30, {0.2, 0.1, 0.1});
    for (Block& block : model.blocks)
        for (Vec3& v : block.shape.vertices) v += shift;
    Water water;
    water.kind = Water::Level::elevation;
    water.level = {{0.0, 0.2 + shift.z()}};
    for (std::size_t b = 1; b < model.blocks.size(); ++b)
        water.walls.push_back({static_cast<std::int32_t>(b), faceTowards(model, b, {1, 0, 0})});
    model.waters = {water};
    return model;
}

}  // namespace

TEST_SUITE("build") {
    TEST_CASE("survey coordinates: a slope a thousand kilometres from its origin fails like one at it") {
        const Vec3 shift(512000, 4'321'000, 1250);
        State near = *buildState(wetColumn(Vec3::Zero()), false), far = *buildState(wetColumn(shift), false);
        CHECK(far.geometry->origin.norm() > 1e6);
        CHECK(near.geometry->origin == Vec3::Zero());
        CHECK(far.wet.force.get(0).norm() == doctest::Approx(near.wet.force.get(0).norm()));

        Model dry = stackModel(1, 3, 1, 30, {0.2, 0.1, 0.1});
        dry.analysis.start = 0;
        Model moved = dry;
        for (Block& block : moved.blocks)
            for (Vec3& v : block.shape.vertices) v += shift;
        CHECK(degrees(criticalAngle(moved)->answer) ==
              doctest::Approx(degrees(criticalAngle(dry)->answer)).epsilon(0.0005));
        moved.run = {.duration = 0.001, .time_step = {}, .frame_interval = 0.001, .watch = {"c1r1s1"}};
        const RunResult result = *run(moved, Control{}, {});
        CHECK((result.watch[0].position - shift - Vec3(0.1, 0.05, 0.05)).norm() < 1e-5);
    }
}
