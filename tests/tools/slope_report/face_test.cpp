// The face of a model: outer faces that are steep, not benches, joints and cut-off sides.

#include "slope_report/face.h"

#include <doctest/doctest.h>

#include "cli/text.h"
#include "support/rock_slopes.h"

using namespace talus;
using namespace talus::tools;
using test::RockSlope;
using test::scenarioOf;

namespace {

Model slopeOf(double height, double crest) {
    return scenarioOf(RockSlope{.height = height,
                                .crest = crest,
                                .back = 14,
                                .width = 8,
                                .normal_stiffness = 1e10,
                                .shear_stiffness = 1e9,
                                .friction_deg = 33,
                                .sets = {{38, 265, 2.3}, {68, 95, 3.1}, {80, 5, 2.9}}})
        .model;
}

}  // namespace

TEST_CASE("face: that of a slope which joints cut is its own") {
    for (const double crest : {2.0, 5.0, 9.0}) {
        const auto face = faceOf(slopeOf(10, crest));
        REQUIRE(face);
        CHECK(degrees(face->dip) == doctest::Approx(degrees(std::atan2(10, crest))).epsilon(1e-6));
        CHECK(degrees(face->dip_direction) == doctest::Approx(270).epsilon(1e-6));
    }
}

TEST_CASE("face: a turn about the vertical turns it, a tilt makes it steeper") {
    Model model = slopeOf(10, 5);
    const double dip = faceOf(model)->dip;
    Model tilted = model;
    tilted.gravity.tilt = radians(8);
    CHECK(faceOf(tilted)->dip == doctest::Approx(dip + radians(8)).epsilon(1e-6));
    for (Block& block : model.blocks)
        for (Vec3& v : block.shape.vertices) v = Vec3(v.y(), -v.x(), v.z());  // 90 degrees clockwise
    const auto face = faceOf(model);
    REQUIRE(face);
    CHECK(face->dip == doctest::Approx(dip).epsilon(1e-6));
    CHECK(degrees(face->dip_direction) == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("face: a box that was cut out of a rock mass has none") {
    Model model;
    model.blocks.resize(2);
    model.blocks[0].shape = *makeBox({0, 0, 0}, {1, 1, 1});
    model.blocks[1].shape = *makeBox({1, 0, 0}, {2, 1, 1});
    CHECK(!faceOf(model));
    CHECK(!faceOf(Model{}));
}
