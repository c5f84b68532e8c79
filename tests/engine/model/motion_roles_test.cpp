// Roles of moving blocks: a block that turns about a pivot topples, one without a pivot slides.

#include "talus/motion_roles.h"

#include <doctest/doctest.h>

using namespace talus;

namespace {

/// A block that turns about one of its lower edges.
BlockDisplacement aboutItsEdge(double rotation) {
    return {.position = Vec3::Zero(), .radius = 1, .translation = rotation, .rotation = rotation, .mass = 1};
}

}  // namespace

TEST_SUITE("model") {
    TEST_CASE("motion roles: a block that turns about an edge topples, unless no point of it is a pivot") {
        BlockDisplacement block = aboutItsEdge(0.1);
        CHECK((motionRoles({block}, 1e-5)[0] == FailureMode::toppling));
        block.least_against_others = 0.6 * block.ofFarthestCorner();
        CHECK((motionRoles({block}, 1e-5)[0] == FailureMode::sliding));
    }

    TEST_CASE("motion roles: a turn about the normal of its joint opens nothing") {
        BlockDisplacement block = aboutItsEdge(0.1);
        block.spin = block.rotation;
        CHECK((motionRoles({block}, 1e-5)[0] == FailureMode::sliding));
    }

    TEST_CASE("motion roles: displacements below the elastic deflection are no motion") {
        CHECK((motionRoles({aboutItsEdge(1e-4)}, 1e-3)[0] == FailureMode::none));
    }
}
