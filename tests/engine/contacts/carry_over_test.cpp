// Forces, memory and energy of contact points before and after their patch is clipped again.

#include "contacts/carry_over.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "build/build.h"
#include "contacts/update.h"
#include "engine/geometry/random_shapes.h"
#include "measure/measure.h"
#include "state/incidence.h"
#include "state/point_layout.h"
#include "step/step.h"
#include "support/models.h"
#include "support/validated.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kStiffness = 1e9;  // [Pa/m]

/// A cube of 1 m that is pressed on the floor, `over` of it beyond the floor's end at x = 20.
State pressedCube(Model model, double over, double depth) {
    addBox(model, "cube", {19 + over, 0, 0}, {1, 1, 1});
    model.gravity.magnitude = 0;
    State state = *buildState(model, false);
    state.blocks.position[1].z -= depth;
    updateForces(state, false);
    return state;
}

Eigen::Vector2d shearForce(const State& state, std::size_t i) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const ContactPoint& point : contactPoints(state, i))
        sum += Eigen::Vector2d(point.force.shear_1, point.force.shear_2);
    return sum;
}

double normalForce(const State& state, std::size_t i) {
    double sum = 0;
    for (const ContactPoint& point : contactPoints(state, i)) sum += point.force.normal;
    return sum;
}

/// Slides that the contact points of an interface have left behind, at random, and what the law makes of
/// them.
void setRandomOffsets(State& state, Random& random, double most) {
    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
        for (std::size_t k = 0; k < state.interfaces.pointCount(i); ++k)
            state.points.setOffset(state.interfaces.pointSlot(i, k), random.uniform(-most, most),
                                   random.uniform(-most, most));
    updateForces(state, false);
}

/// As if the contact points of the first interface had slid along with their block.
void moveOffsets(State& state, const Vec3& slide) {
    const RelativePose pose = relativePose(state, 0);
    for (std::size_t k = 0; k < state.interfaces.pointCount(0); ++k) {
        const std::size_t slot = state.interfaces.pointSlot(0, k);
        const contact::PointMemory memory = state.points.memoryAt(slot);
        state.points.setOffset(slot, memory.offset_1 + slide.dot(pose.e1),
                               memory.offset_2 + slide.dot(pose.e2));
    }
}

void search(State& state) {
    findInterfaces(state, false, false);
    checkValid(state);
    updateForces(state, false);
    checkValid(state, true);
}

/// Carries everything over to the same interfaces with new points.
CarriedPoints handOnInPlace(State& state) {
    const OldInterfaces old = takeInterfaces(state);
    state.interfaces = old.interfaces;
    makePoints(state);
    return carryOver(old, state, 0);
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE("carryOver: the same patches again carry and remember the same") {
        Random random(81);
        Model model = stackModel(3, 3, 1, 30, {0.2, 0.1, 0.1}, kStiffness);
        addTurnedCube(model, "cube", turnAbout({1, 0.3, 0.2}, 40), 1.2, 0.05, 0.00005, 0.1);
        model.joints[0].cohesion = 1000;
        model.joints[0].tensile_strength = 100;
        model.joints[0].dilation = radians(3);
        State state = *buildState(model, false);
        for (std::size_t b = 1; b < state.blocks.size(); ++b)
            state.blocks.position[b].z -= 1e-6 * random.uniform(1, 2);
        search(state);  // the slides begin anew from here
        setRandomOffsets(state, random, 1e-6);
        for (std::size_t i = 0; i < state.interfaces.size(); i += 2)
            state.points.setBond(state.interfaces.pointSlot(i, 0), 0.25);
        for (int k = 0; k < 3; ++k) updateForces(state, false);  // until nothing slips that dilates
        const State before = state;
        CHECK(handOnInPlace(state).empty());
        CHECK(state.shear_lost == before.shear_lost);
        CHECK(state.interfaces.frames == before.interfaces.frames);
        for (std::size_t i = 0; i < state.interfaces.size(); ++i)
            for (std::size_t k = 0; k < state.interfaces.pointCount(i); ++k) {
                const std::size_t slot = state.interfaces.pointSlot(i, k);
                const contact::PointMemory was = before.points.memoryAt(slot),
                                           is = state.points.memoryAt(slot);
                CHECK(is.bond == was.bond);
                CHECK(is.dilation == was.dilation);
                if (isVertexEdge(state.interfaces, i)) {  // to the bit
                    CHECK(is.offset_1 == was.offset_1);
                    CHECK(is.offset_2 == was.offset_2);
                }
            }
        CHECK(elasticEnergy(state) == within(1e-9, elasticEnergy(before)));
        updateForces(state, false);
        for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
            const Vec3 was = before.interfaces.wrench(i).force, is = state.interfaces.wrench(i).force;
            CHECK((is - was).norm() <= 1e-9 * was.norm());
        }
    }

    TEST_CASE("carryOver: random slides over a whole face lose nothing, and no energy comes about") {
        Random random(82);
        for (int trial = 0; trial < 50; ++trial) {
            CAPTURE(trial);
            State state = pressedCube(floorModel(35, kStiffness), -2, 1e-4);
            search(state);
            setRandomOffsets(state, random, trial % 2 == 0 ? 5e-5 : 5e-4);
            state.blocks.position[1].x += random.uniform(-1e-3, 1e-3);
            state.blocks.position[1].y += random.uniform(-1e-3, 1e-3);
            updateForces(state, false);
            const Eigen::Vector2d shear = shearForce(state, 0);
            const double normal = normalForce(state, 0), energy = elasticEnergy(state);
            search(state);
            CHECK((shearForce(state, 0) - shear).norm() <= 1e-9 * shear.norm());
            CHECK(normalForce(state, 0) == within(1e-9, normal));
            CHECK(elasticEnergy(state) <= energy * (1 + 1e-9));
            CHECK(state.shear_lost == 0);
        }
    }

    TEST_CASE(
        "carryOver: a patch that shrinks keeps its shear force as far as Coulomb allows, and makes no "
        "energy") {
        Random random(83);
        int kept = 0, cut = 0;
        for (int trial = 0; trial < 60; ++trial) {
            CAPTURE(trial);
            const double over = random.uniform(0.2, 0.7);
            State state = pressedCube(floorModel(35, kStiffness), over, 1e-4);
            search(state);
            if (trial % 2 == 0) {
                setRandomOffsets(state, random, random.uniform(1e-5, 2e-4));
            } else {  // the same all over, within the strength
                for (std::size_t k = 0; k < state.interfaces.pointCount(0); ++k)
                    state.points.setOffset(state.interfaces.pointSlot(0, k), 3e-5, -2e-5);
            }
            const double area = state.interfaces.area[0], friction = std::tan(radians(35));
            // A slide as it is, or one in which the offsets go along and nothing slips.
            const double slide = random.uniform(1e-3, 8e-3);
            state.blocks.position[1].x += slide;
            if (trial % 2 == 1) moveOffsets(state, {slide, 0, 0});
            updateForces(state, false);
            const Eigen::Vector2d shear = shearForce(state, 0);
            const double energy = elasticEnergy(state);
            search(state);
            REQUIRE(state.interfaces.area[0] < area);
            const double strength = friction * normalForce(state, 0);
            CHECK(shearForce(state, 0).norm() <= shear.norm() * (1 + 1e-9));
            CHECK(shearForce(state, 0).norm() <= strength * (1 + 1e-9));
            CHECK(elasticEnergy(state) <= energy * (1 + 1e-9));
            CHECK(state.shear_lost == 0);
            bool slips = false;
            for (const ContactPoint& point : contactPoints(state, 0))
                slips = slips || std::hypot(point.force.shear_1, point.force.shear_2) >
                                     (1 - 1e-9) * friction * point.force.normal;
            ++(slips ? cut : kept);
            if (!slips) CHECK((shearForce(state, 0) - shear).norm() <= 1e-9 * shear.norm());
        }
        CHECK(kept > 5);
        CHECK(cut > 5);
    }

    TEST_CASE("carryOver: what finds no closed contact point any more is counted as lost") {
        Random random(84);
        for (const double lift : {2e-4, 0.5}) {  // open, and out of reach
            State state = pressedCube(floorModel(35, kStiffness), -2, 1e-4);
            search(state);
            setRandomOffsets(state, random, 2e-5);
            const Eigen::Vector2d whole = shearForce(state, 0);
            double by_points = 0;
            for (const ContactPoint& point : contactPoints(state, 0))
                by_points += std::hypot(point.force.shear_1, point.force.shear_2);
            REQUIRE(whole.norm() > 0);
            // The forces remain without the block, as after a step that moved it away.
            const OldInterfaces old = [&] {
                State taken = state;
                return takeInterfaces(taken);
            }();
            State after = state;
            after.interfaces = {};
            after.points = {};
            if (lift < 0.1) {
                after.interfaces = state.interfaces;
                makePoints(after);
                after.blocks.position[1].z += lift;
            } else {
                makePoints(after);
            }
            const CarriedPoints carried = carryOver(old, after, 0);
            if (lift < 0.1) {
                CHECK(after.shear_lost ==
                      0);  // nothing was carried there either: the point's forces follow the pose
                CHECK(carried.empty());
            } else {
                CHECK(after.shear_lost == within(1e-9, by_points));
                REQUIRE(carried.size() == 1);
                CHECK(carried.begin()->second.size() == state.interfaces.pointCount(0));
            }
        }
    }

    TEST_CASE("carryOver: each new contact point has the bond and the dilation of the nearest old one") {
        Model model = floorModel(30, kStiffness);
        model.joints[0].cohesion = 1e6;
        model.joints[0].tensile_strength = 1e5;
        model.joints[0].dilation = radians(5);
        State state = pressedCube(model, 0.4, 1e-5);
        const Interfaces& f = state.interfaces;
        for (std::size_t k = 0; k < f.pointCount(0); ++k)
            state.points.setMemory(f.pointSlot(0, k), {.bond = 0.05 * static_cast<double>(k + 1),
                                                       .dilation = -1e-6 * static_cast<double>(k)});
        const std::vector<ContactPoint> old = contactPoints(state, 0);
        const Vec3 origin = relativePose(state, 0).origin;
        state.blocks.position[1].x += 0.03;
        findInterfaces(state, false, false);
        checkValid(state);
        const RelativePose pose = relativePose(state, 0);
        for (const ContactPoint& point : contactPoints(state, 0)) {
            const Vec3 place =
                pose.origin + point.position.x() * pose.e1 + point.position.y() * pose.e2 - origin;
            const auto nearest = std::min_element(old.begin(), old.end(), [&](const auto& p, const auto& q) {
                const Eigen::Vector2d at(place.dot(pose.e1), place.dot(pose.e2));
                return (p.position - at).norm() < (q.position - at).norm();
            });
            CHECK(point.memory.bond == nearest->memory.bond);
            CHECK(point.memory.dilation == nearest->memory.dilation);
        }
    }

    TEST_CASE(
        "carryOver: what is found overlapping for the first time holds no energy, faces, edges and vertices "
        "alike") {
        Random random(85);
        for (int trial = 0; trial < 40; ++trial) {
            CAPTURE(trial);
            Model model = floorModel(30, kStiffness);
            model.gravity.magnitude = 0;
            const Eigen::Quaterniond turn = trial % 4 == 0
                                                ? Eigen::Quaterniond::Identity()
                                                : turnAbout(random.direction(), random.uniform(0, 180));
            addTurnedCube(model, "cube", turn, 3, 0, 1.0, 0.5);
            State state = *buildState(model, false);
            REQUIRE(state.interfaces.size() == 0);
            const double depth = random.uniform(1e-4, 1e-2);
            state.blocks.position[1].z -= 1.0 + depth;
            search(state);
            REQUIRE(state.interfaces.size() > 0);
            // As if pressed in by 1e-6 of the block's size all over; its overlap would hold as much with
            // `depth`.
            const double of_size = 0.5 * kStiffness * 0.25 * 0.5e-6 * 0.5e-6;
            CHECK(elasticEnergy(state) <= of_size);
        }
    }
}
