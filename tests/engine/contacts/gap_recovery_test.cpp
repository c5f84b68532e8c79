#include "contacts/gap_recovery.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "forces/contact_forces.h"
#include "measure/measure.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kLate = 0.01;  // [m]

/// Two boxes face to face in weightlessness, pressed together by 1e-4 m, with an overlap of kLate that does
/// not count.
State lateState() {
    Model model = floorModel(30, 1e8);
    model.gravity.magnitude = 0;
    addBox(model, "a", {0, 0, 2}, {1, 1, 1});
    addBox(model, "b", {0, 0.1, 3}, {1, 0.8, 1});
    State state = *buildState(model, false);
    REQUIRE(state.interfaces.size() == 1);
    state.blocks.position[2].z -= kLate + 1e-4;
    state.interfaces.referenceGap(0, 0) -= kLate;
    state.search_position = state.blocks.position;  // as a search leaves them
    updateForces(state, false);
    REQUIRE(relativePose(state, 0).gap.x() == doctest::Approx(-1e-4));
    return state;
}

double energy(const State& state) { return kineticEnergy(state) + elasticEnergy(state); }

Vec3 momentum(const State& state) {
    return state.blocks.mass[1] * state.blocks.velocity.get(1) +
           state.blocks.mass[2] * state.blocks.velocity.get(2);
}

Vec3 angularMomentum(const State& state) {
    Vec3 sum = Vec3::Zero();
    for (const std::size_t b : {1, 2})
        sum += state.blocks.angular_momentum.get(b) +
               state.blocks.position.get(b).cross(state.blocks.mass[b] * state.blocks.velocity.get(b));
    return sum;
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE(
        "a contact found with an overlap recovers its gap by the motion of its blocks, and no energy is "
        "made") {
        State state = lateState();
        state.blocks.velocity.set(1, {0.3, -0.2, 0.4});
        state.blocks.velocity.set(2, {-0.1, 0.5, 0.1});
        state.blocks.angular_momentum.set(2, {10, 20, -30});
        double before = energy(state), late = state.interfaces.referenceGap(0, 0);
        const Vec3 p = momentum(state), l = angularMomentum(state);
        for (int k = 0; k < 20; ++k) {
            recoverGaps(state);
            CHECK(state.interfaces.referenceGap(0, 0) > late);
            CHECK(energy(state) <= before * (1 + 1e-14));
            CHECK(energy(state) > 0.9 * before);
            before = energy(state);
            late = state.interfaces.referenceGap(0, 0);
        }
        CHECK((momentum(state) - p).norm() < 1e-12 * p.norm());
        CHECK((angularMomentum(state) - l).norm() < 1e-12 * l.norm());
    }

    TEST_CASE("a contact of blocks without velocity stays as it is") {
        State state = lateState();
        const double late = state.interfaces.referenceGap(0, 0);
        recoverGaps(state);
        CHECK(state.interfaces.referenceGap(0, 0) == late);
    }

    TEST_CASE("one that opens has as much less to recover") {
        State state = lateState();
        state.blocks.position[2].z += 1e-4 + 0.4 * kLate;
        const double late = state.interfaces.referenceGap(0, 0);
        recoverGaps(state);
        CHECK(state.interfaces.referenceGap(0, 0) == doctest::Approx(late + 0.4 * kLate));
        CHECK(relativePose(state, 0).gap.x() == doctest::Approx(0).scale(1e-9));
    }

    TEST_CASE("an overlap at the start within the closed gap still counts as closed") {
        Model model = floorModel(30, 1e8);
        addBox(model, "a", {0, 0, -0.9e-4}, {1, 1, 1});
        State state = *buildState(model, false);
        state.blocks.velocity.set(1, {1, 0, -1});
        const double reference = state.interfaces.referenceGap(0, 0);
        CHECK(reference == doctest::Approx(-0.9e-4));
        recoverGaps(state);
        CHECK(state.interfaces.referenceGap(0, 0) == reference);
    }
}
