// The validator itself: sound states of every kind pass, and each fault is found and named.

#include "validate/validate.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "build/build.h"
#include "contacts/update.h"
#include "forces/contact_forces.h"
#include "state/incidence.h"
#include "state/point_layout.h"
#include "step/step.h"
#include "support/models.h"
#include "support/validated.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A wall that leans on its floor, with a cube that comes down on a vertex, water behind the first column,
/// and bonds.
Model everyKind(PointRule rule = {}) {
    Model model = stackModel(3, 2, 1, 20, {0.2, 0.1, 0.1}, 1e9);
    addTurnedCube(model, "cube", turnAbout({1, 0.3, 0.2}, 40), 1.2, 0.05, 0.00005, 0.1);
    model.points = rule;
    model.gravity.tilt = radians(25);
    model.joints[0].cohesion = 500;
    model.joints[0].tensile_strength = 100;
    model.waters = {fissureAt(model, 0.2, 0.15)};
    return model;
}

State movedState(const Model& model, int steps) {
    State state = *buildState(model, false);
    state.damping.local = 0.5;
    constexpr double kStep = 2e-6;
    for (int k = 0; k < steps; k += 20) {
        advance(state, {kStep, false}, 20);
        refreshInterfaces(state, false, 20 * kStep);
    }
    updateForces(state, false);
    return state;
}

std::size_t firstPlace(const State& state) {
    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
        if (isVertexEdge(state.interfaces, i)) return i;
    FAIL("no place for a vertex or edge");
    return 0;
}

/// A place where a vertex is.
std::size_t vertexContact(const State& state) {
    for (std::size_t i = firstPlace(state); i < state.interfaces.size(); ++i)
        if (isVertexEdge(state.interfaces, i) && !isIdle(state.interfaces, i)) return i;
    FAIL("no vertex touches");
    return 0;
}

std::size_t firstPatch(const State& state) {
    std::size_t i = 0;
    while (isVertexEdge(state.interfaces, i)) ++i;
    return i;
}

struct Damage {
    const char* said;  ///< part of the finding
    std::function<void(State&)> make;
};

/// Each is found with its own text, and not before.
void checkFound(const State& sound, const std::vector<Damage>& damages,
                const std::function<std::vector<std::string>(const State&)>& look) {
    REQUIRE(look(sound).empty());
    for (const Damage& damage : damages) {
        CAPTURE(std::string(damage.said));
        State state = sound;
        damage.make(state);
        const std::vector<std::string> findings = look(state);
        REQUIRE_FALSE(findings.empty());
        CAPTURE(findings.front());
        CHECK(findings.front().find(damage.said) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("validate: sound states of every rule of contact points pass, at the start and in motion") {
    for (const PointRule::Kind kind :
         {PointRule::Kind::vertex, PointRule::Kind::distributed, PointRule::Kind::corner,
          PointRule::Kind::quarter, PointRule::Kind::grid}) {
        CAPTURE(static_cast<int>(kind));
        const State state = movedState(everyKind({kind, 3}), 400);
        checkValid(state, true);
        vertexContact(state);
        CHECK(state.wet.size() > 0);
        CHECK(state.points.remembers());
    }
}

TEST_CASE("validate: whatever is wrong in a state is found") {
    const State sound = movedState(everyKind(), 400);
    const std::size_t patch = firstPatch(sound), place = firstPlace(sound), vertex = vertexContact(sound);
    const std::size_t last = sound.interfaces.size() - 1;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Damage> damages{
        {"arrays of blocks", [](State& s) { s.blocks.torque.y.pop_back(); }},
        {"fewer laws", [](State& s) { s.laws.pop_back(); }},
        {"last search", [](State& s) { s.search_orientation.pop_back(); }},
        {"no margin", [](State& s) { s.search_margin = 0; }},
        {"block 2: its quaternion", [](State& s) { s.blocks.orientation[2].w += 1e-6; }},
        {"block 1: its mass", [](State& s) { s.blocks.mass[1] = 0; }},
        {"block 1: its mass", [](State& s) { s.blocks.inertia.z[1] = -1; }},
        {"block 0: the kernels", [](State& s) { s.blocks.free[0] = 1; }},
        {"block 0: the inertia", [](State& s) { s.blocks.inverse_mass[0] = 1; }},
        {"block 3: the inertia", [](State& s) { s.blocks.inverse_inertia.x[3] = 0; }},
        {"arrays of interfaces", [](State& s) { s.interfaces.joint.pop_back(); }},
        {"group 1: it does not begin", [](State& s) { ++s.interfaces.groups[1].begin; }},
        {"group 1: it does not begin", [](State& s) { s.interfaces.groups[1].first_point += 8; }},
        {"group 0: no interfaces", [](State& s) { s.interfaces.groups[0].size = 0; }},
        {"hold all interfaces", [](State& s) { s.interfaces.groups.pop_back(); }},
        {"frames or wrenches", [](State& s) { s.interfaces.wrenches.pop_back(); }},
        {"corners have not", [](State& s) { s.interfaces.corners.grow(s.interfaces.corners.slots() + 8); }},
        {"its slot", [](State& s) { std::swap(s.interfaces.slot[0], s.interfaces.slot[1]); }},
        {"count of contact points", [](State& s) { ++s.points.count; }},
        {"points' memory has", [](State& s) { s.points.memory.grow(s.points.memory.slots() + 8); }},
        {"do not remember",
         [](State& s) {
             LaneArray without(kSlideQuantities);
             without.grow(s.points.memory.slots());
             s.points.memory = without;
         }},
        {"unused lanes",
         [](State& s) {
             const Interfaces& f = s.interfaces;
             for (std::size_t g = 0; g < f.groups.size(); ++g)
                 if (f.groups[g].size < simd::kLanes) s.interfaces.frames.at(8 * g + 7, 4) = 1e-3;
         }},
        {"between two blocks", [=](State& s) { s.interfaces.block_b[last] = s.interfaces.block_a[last]; }},
        {"between two blocks", [](State& s) { s.interfaces.block_a[1] = 99; }},
        {"no such face", [](State& s) { s.interfaces.face_b[2] = 6; }},
        {"no such joint", [](State& s) { s.interfaces.joint[2] = -1; }},
        {"its area is not", [=](State& s) { s.interfaces.area[0] = nan; }},
        {"its kind",
         [](State& s) {
             s.interfaces.kind[0] = s.interfaces.kind[0] == InterfaceKind::faces ? InterfaceKind::vertex_edge
                                                                                 : InterfaceKind::faces;
         }},
        {"what places for vertices", [=](State& s) { s.interfaces.idle[patch] = 1; }},
        {"what places for vertices", [=](State& s) { s.interfaces.travel_left[patch] = 0.1; }},
        {"not orthonormal",
         [=](State& s) {
             InterfaceFrame frame = s.interfaces.frame(patch);
             frame.e2_b += 1e-6 * frame.e1_b;
             s.interfaces.setFrame(patch, frame);
         }},
        {"the face of a",
         [=](State& s) {
             InterfaceFrame frame = s.interfaces.frame(patch);
             frame.origin_a += 1e-4 * frame.e1_a.cross(frame.e2_a);
             s.interfaces.setFrame(patch, frame);
         }},
        {"the face of b",
         [=](State& s) {
             InterfaceFrame frame = s.interfaces.frame(patch);
             std::swap(frame.e1_b, frame.e2_b);  // looks back at a
             s.interfaces.setFrame(patch, frame);
         }},
        {"point out of its reference",
         [=](State& s) {
             InterfaceFrame frame = s.interfaces.frame(vertex);
             std::swap(frame.e1_a, frame.e2_a);
             s.interfaces.setFrame(vertex, frame);
         }},
        {"not one of the other",
         [=](State& s) {
             InterfaceFrame frame = s.interfaces.frame(vertex);
             frame.origin_b *= 1.01;
             s.interfaces.setFrame(vertex, frame);
         }},
        {"its patch is not", [=](State& s) { s.interfaces.area[patch] *= 1.00001; }},
        {"its patch is not",
         [=](State& s) {
             std::vector<Eigen::Vector2d> outline = patchOutline(s.interfaces, patch);
             std::reverse(outline.begin(), outline.end());
             placeCorners(s.interfaces, patch, outline);
         }},
        {"have another one",
         [=](State& s) {
             Interfaces& f = s.interfaces;
             std::size_t other = patch + 1;
             while (f.block_a[other] != f.block_a[patch] || f.face_a[other] != f.face_a[patch] ||
                    f.face_b[other] != f.face_b[patch])
                 ++other;
             f.block_b[other] = f.block_b[patch];
         }},
        {"other places of its pair",
         [=](State& s) {
             std::swap(s.interfaces.block_a[place + 1], s.interfaces.block_b[place + 1]);
             std::swap(s.interfaces.face_a[place + 1], s.interfaces.face_b[place + 1]);
             InterfaceFrame frame = s.interfaces.frame(place + 1);
             frame.e1_a = frame.e1_b = Vec3::UnitX();
             frame.e2_a = frame.e2_b = Vec3::UnitY();
             s.interfaces.setFrame(place + 1, frame);
         }},
        {"a bond is not", [=](State& s) { s.points.setBond(s.interfaces.pointSlot(patch, 2), 1.5); }},
        {"a bond is not", [=](State& s) { s.points.setOffset(s.interfaces.pointSlot(patch, 0), nan, 0); }},
        {"rows by block", [](State& s) { s.incidence.interface.pop_back(); }},
        {"a block does not have it", [](State& s) { s.incidence.wrench[0] ^= 1; }},
        {"a block does not have it",
         [](State& s) {
             const auto row = static_cast<std::size_t>(s.incidence.interface_begin[1]);
             std::swap(s.incidence.interface[row], s.incidence.interface[row + 1]);
         }},
        {"arrays of wet walls", [](State& s) { s.wet.moment.z.pop_back(); }},
        {"arrays of waters", [](State& s) { s.drained.push_back(0); }},
        {"sorted by its water", [](State& s) { s.wet.water[0] = 1; }},
        {"wet wall 0: it is not on a block", [](State& s) { s.wet.block[0] = -1; }},
        {"wet wall 0: its interface",
         [](State& s) {
             s.wet.interface[0] = 0;
             s.wet.block[0] = s.interfaces.block_a[0] == 1 || s.interfaces.block_b[0] == 1 ? 3 : 1;
         }},
        {"its tangents", [](State& s) { s.wet.e1.x[0] += 0.1; }},
        {"convex",
         [](State& s) {
             std::swap(s.wet.vertex_x[0], s.wet.vertex_x[1]), std::swap(s.wet.vertex_y[0], s.wet.vertex_y[1]);
         }},
        {"its moments", [](State& s) { s.wet.moments[0].second.xy += 1e-12; }},
        {"its block does not", [](State& s) { std::swap(s.incidence.wet[0], s.incidence.wet[1]); }},
        {"another", [](State& s) { s.incidence.wet_blocks.push_back(0); }},
    };
    checkFound(sound, damages, validate);
}

TEST_CASE(
    "validate: stored places have to be the rule's, and patches in the groups of their contact points") {
    const State sound = movedState(everyKind({PointRule::Kind::grid, 2}), 40);
    const std::size_t patch = firstPatch(sound);
    checkFound(sound,
               {{"where the rule has them",
                 [=](State& s) { s.points.places.at(s.interfaces.pointSlot(patch, 1), 0) += 1e-9; }},
                {"unused lanes",
                 [](State& s) {
                     for (const InterfaceGroup& group : s.interfaces.groups)
                         if (group.size < simd::kLanes)
                             s.points.places.at(static_cast<std::size_t>(group.first_point) + 7, 2) = 1;
                 }}},
               validate);
}

TEST_CASE(
    "validate: wrenches that are not the sum over contact points, or not opposite, and lost energy are "
    "found") {
    State sound = movedState(everyKind(), 400);
    const std::size_t patch = firstPatch(sound), vertex = vertexContact(sound);
    const auto turnMore = [](std::size_t i, Vec3 InterfaceWrench::*moment) {
        return [=](State& s) {
            InterfaceWrench wrench = s.interfaces.wrench(i);
            wrench.*moment += Vec3(0, 0.01, 0);
            s.interfaces.setWrench(i, wrench);
        };
    };
    checkFound(sound,
               {{"not opposite", turnMore(patch, &InterfaceWrench::moment_a)},
                {"not opposite", turnMore(vertex, &InterfaceWrench::moment_b)},
                {"its force is not",
                 [=](State& s) {  // twice the load, and opposite all the same
                     InterfaceWrench wrench = s.interfaces.wrench(patch);
                     wrench = {2 * wrench.force, 2 * wrench.moment_a, 2 * wrench.moment_b};
                     s.interfaces.setWrench(patch, wrench);
                 }},
                {"its moment is not",
                 [=](State& s) {  // a couple on both
                     InterfaceWrench wrench = s.interfaces.wrench(patch);
                     const Vec3 couple = Vec3::Constant(0.01 * wrench.force.norm());
                     wrench.moment_a += couple, wrench.moment_b -= couple;
                     s.interfaces.setWrench(patch, wrench);
                 }},
                {"its force is not", [=](State& s) { s.laws[0].normal_stiffness *= 1.01; }},
                {"an energy is negative",
                 [](State& s) { s.blocks.inverse_mass[1] *= -1, s.blocks.velocity.x[1] = 100; }}},
               validateForces);
}

TEST_CASE("validate: a bond that is being released holds shear while its contact points are apart") {
    Model model = stackModel(1, 1, 1, 0, {0.2, 0.1, 0.1});
    model.joints[0].cohesion = 1e9;
    State state = *buildState(model, false);
    state.release = 0.25;
    const Vec3 apart(1e-8, 0, 1e-7);
    const std::size_t block = state.blocks.size() - 1;
    REQUIRE(state.blocks.motion[block] == Motion::free);
    state.blocks.position.set(block, state.blocks.position.get(block) + apart);
    updateForces(state, false);
    CHECK(validateForces(state).empty());
    for (const ContactPoint& point : contactPoints(state, firstPatch(state))) {
        CHECK_FALSE(point.force.open);
        CHECK(point.memory.bond == 0.75);
        CHECK(point.force.normal == 0);
        CHECK(std::hypot(point.force.shear_1, point.force.shear_2) > 0);
    }
}
