// The slope of block theory from a state.

#include "block_theory/slope.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "support/models.h"

using namespace talus;
using namespace talus::keyblocks;
using namespace talus::test;

namespace {

Slope slopeFrom(const Model& model) {
    State state = *buildState(model, false);
    return slopeOf(state);
}

}  // namespace

TEST_CASE("contacts have areas, joints and normals into the block that sees them") {
    Model model = stackModel(2, 1, 1, 30, {2, 1, 1});
    Joint side = joint(20);
    side.name = "side";
    model.joints.push_back(side);
    model.pair_joints = {{1, 2, 1}};
    const Slope slope = slopeFrom(model);
    REQUIRE(slope.size() == 3);
    CHECK(slope.free == std::vector<char>{0, 1, 1});
    CHECK(slope.volume[1] == doctest::Approx(2));
    CHECK(slope.mass[1] == doctest::Approx(5400));
    REQUIRE(slope.contactsOf(1).size() == 2);
    CHECK(slope.contactsOf(0).size() == 2);
    for (std::size_t block = 0; block < 3; ++block)
        for (const Contact& contact : slope.contactsOf(block)) {
            CHECK(contact.is_patch);
            const bool is_bed = block == 0 || contact.other == 0;
            CHECK(contact.area == doctest::Approx(is_bed ? 2 : 1));
            CHECK(contact.joint == (is_bed ? 0 : 1));
            const double towards = is_bed ? (block == 0 ? -1 : 1) * contact.normal.z()
                                          : (block == 1 ? -1 : 1) * contact.normal.x();
            CHECK(towards == doctest::Approx(1));
        }
}

TEST_CASE("a gap is no contact, and a vertex on a face is one without a patch") {
    Model model = floorModel(30);
    addBox(model, "apart", {0, 0, 0.01}, {1, 1, 1});
    addTurnedCube(model, "pointed", turnAbout({1, 1, 0}, 50), 3, 3, 0.0);
    const Slope slope = slopeFrom(model);
    CHECK(slope.contactsOf(1).empty());
    REQUIRE(slope.contactsOf(2).size() == 1);
    CHECK(!slope.contactsOf(2)[0].is_patch);
    CHECK(slope.contactsOf(2)[0].normal.z() == doctest::Approx(1));
}

TEST_CASE("the force on a block is all but its contacts; what ties two blocks cancels over both") {
    Model model = stackModel(1, 2, 1, 30, {1, 1, 1});
    model.gravity.tilt = radians(10);
    model.seismic.horizontal = 0.1;
    const Slope bare = slopeFrom(model);
    const double weight = 2700 * 9.81;
    CHECK((bare.force[1] - 2700 * bare.acceleration).norm() < 1e-9 * weight);
    CHECK(bare.acceleration.norm() == doctest::Approx(9.81 * std::hypot(1, 0.1)));
    Bolt bolt;
    bolt.name = "A";
    bolt.head = {0.5, 0.5, 1.9};
    bolt.end = {0.5, 0.5, 0.5};
    bolt.area = 1e-3;
    bolt.modulus = 2e11;
    bolt.yield_force = bolt.pretension = 1e4;
    bolt.field = "bolt[0]";
    model.bolts = {bolt};
    const Slope tied = slopeFrom(model);
    CHECK((tied.force[2] - bare.force[2] + 1e4 * Vec3::UnitZ()).norm() < 1e-6);
    CHECK((tied.force[1] + tied.force[2] - bare.force[1] - bare.force[2]).norm() < 1e-6);
}
