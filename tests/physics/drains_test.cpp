// Flow to drains and other boundaries that end inside a polygon of a joint, against closed formulas.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/slower.h"
#include "support/solved_flow.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kJoint = 20, kDrain = 0.4;  // sides of a square joint, and of a square drain in it [m]
constexpr double kHead = 5;                  // at the ends of the joint [m]

/// Conformal radius of a square joint at its centre, and of the outside of a square drain, over their sides
/// (Polya and Szego 1951, Isoperimetric Inequalities).
double ofJoint() { return 4 * std::sqrt(std::numbers::pi) / std::pow(std::tgamma(0.25), 2); }
double ofDrain() { return std::pow(std::tgamma(0.25), 2) / (4 * std::pow(std::numbers::pi, 1.5)); }

/// Discharge to a drain of this conformal radius at the centre of the joint [m^3/s]. What it leaves out is of
/// the order (drain / joint)^4.
double drained(const Flow& flow, double radius) {
    return 2 * std::numbers::pi * cubicLaw(flow, flow.aperture) * kHead /
           std::log(ofJoint() * kJoint / radius);
}

void widenFloor(Model& model) {
    model.blocks[0] = box("floor", {-5, -5, -1}, {kJoint + 5, kJoint + 5, 0}, 2700, Motion::fixed);
}

FlowBoundary drainAt(double x, double y, double width, double length) {
    FlowBoundary drain = outletAt(Vec3::UnitX());
    drain.face.reset();
    drain.box_min = Vec3(x - width / 2, y - length / 2, -0.1);
    drain.box_max = Vec3(x + width / 2, y + length / 2, 0.1);
    return drain;
}

/// Heads at three ends of a joint, and at the fourth unless `half`; the drain comes first.
Flow drainedFlow(const FlowBoundary& drain, bool half = false) {
    Flow flow = flowAlongX(2e-4, kHead, kHead);
    if (half) flow.boundaries.erase(flow.boundaries.begin());
    flow.boundaries.push_back(headAt(Vec3::UnitY(), kHead));
    flow.boundaries.push_back(headAt(-Vec3::UnitY(), kHead));
    flow.boundaries.insert(flow.boundaries.begin(), drain);
    return flow;
}

/// Of this length along x.
Model drainedJoint(double length, const Flow& flow) {
    Model model = oneJoint({length, kJoint, 1}, flow);
    widenFloor(model);
    return model;
}

double discharge(const Model& model) { return solved(model).boundaries[0].outflow; }

double dischargeOf(const FlowBoundary& drain) { return discharge(drainedJoint(kJoint, drainedFlow(drain))); }

}  // namespace

TEST_CASE("flow: a second mesh says how far discharges depend on it") {
    Model model = drainedJoint(kJoint, drainedFlow(drainAt(10, 10, kDrain, kDrain)));
    const SteadyFlow coarse = solved(model);
    const auto finer = meshChange(model, coarse);
    REQUIRE(finer.ok());
    CHECK(finer->refinements == 1);
    model.flow->refinements = 1;
    const SteadyFlow fine = solved(model);
    CHECK(finer->triangles == fine.triangles.size());
    const double ratio = fine.inflow_sum / coarse.inflow_sum;
    CHECK(finer->total == doctest::Approx(ratio - 1).epsilon(1e-9));
    REQUIRE(finer->boundaries.size() == 5);
    CHECK(finer->boundaries[0] == doctest::Approx(ratio - 1).epsilon(1e-9));
    const auto coarser = meshChange(model, fine);
    REQUIRE(coarser.ok());
    CHECK(coarser->refinements == 0);
    CHECK(coarser->total == doctest::Approx(1 / ratio - 1).epsilon(1e-9));
    const Model straight = oneJoint({4, 1, 1}, flowAlongX(2e-4, 5, 3));
    CHECK(std::abs(meshChange(straight, solved(straight))->total) < 1e-12);
    const Model still = oneJoint({4, 1, 1}, flowAlongX(2e-4, 5, 5));
    CHECK(std::isnan(meshChange(still, *steadyFlow(still))->total));
}

TEST_CASE("flow: a drain inside a joint carries 2 pi T dH / ln(r_e / r_w)") {
    Model model = drainedJoint(kJoint, drainedFlow(drainAt(10, 10, kDrain, kDrain)));
    const double expected = drained(*model.flow, ofDrain() * kDrain);
    for (const double within : {0.015, 0.005, 0.0015}) {
        CAPTURE(within);
        const double found = discharge(model);
        CHECK(found > expected);  // a mesh dissipates more
        CHECK(found < (1 + within) * expected);
        ++model.flow->refinements;
    }
}

TEST_CASE("flow: a drain as thin as a borehole carries what a slit of its length does") {
    for (const double width : {0.04, 1e-3, 1e-5, 1e-8}) {  // the radius of a slit is a quarter of its length
        CAPTURE(width);
        Model model = drainedJoint(kJoint, drainedFlow(drainAt(10, 10, 2, width)));
        const double slit = drained(*model.flow, 0.5), wider = drained(*model.flow, 0.5 + width / 4);
        CHECK(discharge(model) > 0.995 * slit);
        CHECK(discharge(model) < 1.02 * wider);
    }
}

TEST_CASE("flow: a drain may lie anywhere in a joint, beside all corners of its polygon") {
    const double first = dischargeOf(drainAt(7, 10, kDrain, kDrain));
    CHECK(first > 1.01 * dischargeOf(drainAt(10, 10, kDrain, kDrain)));  // nearer to a head
    for (const auto& [x, y] : {std::pair(13.0, 10.0), {10.0, 7.0}, {10.0, 13.0}})
        CHECK(dischargeOf(drainAt(x, y, kDrain, kDrain)) == doctest::Approx(first).epsilon(5e-3));
}

TEST_CASE("flow: blocks of any size may meet at a drain, at its corner or on its side") {
    const double whole = dischargeOf(drainAt(10, 10, kDrain, kDrain));
    for (const double cut : {10.0, 10.2, 10.2 + 1e-7, 9.9, 4.0, 12.0}) {
        CAPTURE(cut);
        Model model = floorModel(30);
        widenFloor(model);
        addBox(model, "left", {0, 0, 0}, {cut, kJoint, 1});
        addBox(model, "right", {cut, 0, 0}, {kJoint - cut, 9.8, 1});
        addBox(model, "behind", {cut, 9.8, 0}, {kJoint - cut, kJoint - 9.8, 1});
        model.flow = drainedFlow(drainAt(10, 10, kDrain, kDrain));
        model.joints.push_back(joint(30));
        model.joints.back().name = "upright";  // next to no water flows in it
        for (std::int32_t b = 1; b < 4; ++b) model.pair_joints.push_back({0, b, 0, true, "interface[0]"});
        for (std::int32_t b = 1; b < 4; ++b)
            model.blocks[static_cast<std::size_t>(b)].face_joint.assign(6, 1);
        model.flow->joint_apertures.emplace_back(1, 1e-6);
        CHECK(discharge(model) == doctest::Approx(whole).epsilon(0.01));
    }
}

TEST_CASE("flow: a box that only touches a corner of a polygon takes nothing there") {
    FlowBoundary drain = drainAt(10, 10, kDrain, kDrain);
    drain.box_min = Vec3(-1, -1, -0.1);
    drain.box_max = Vec3(0, 0, 0.1);
    Flow flow = drainedFlow(drain);
    auto refused = steadyFlow(drainedJoint(kJoint, flow));
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.errors().front().message.find("found no joint") != std::string::npos);
    flow.boundaries[0].box_max = Vec3(0, kDrain, 0.1);  // water passes through a length of an edge
    flow.boundaries.erase(flow.boundaries.begin() + 1);
    CHECK(discharge(drainedJoint(kJoint, flow)) > 0);
}

TEST_CASE("flow: an outlet on a part of an open end carries half of what a slit does") {
    FlowBoundary spring = outletAt(-Vec3::UnitX());
    spring.box_min.y() = 10 - kDrain / 2;
    spring.box_max.y() = 10 + kDrain / 2;
    FlowBoundary touching = spring;  // a box in front of the rock that only touches the joint's end
    touching.face.reset();
    touching.box_min.x() = -0.5;
    touching.box_max.x() = 0;
    for (const FlowBoundary& drain : {spring, touching}) {
        const Model model = drainedJoint(kJoint / 2, drainedFlow(drain, true));
        const double expected = drained(*model.flow, kDrain / 4) / 2;
        CHECK(discharge(model) > expected);
        CHECK(discharge(model) < 1.025 * expected);
    }
}

TEST_CASE("flow: a head begins where its box does, inside a polygon") {
    for (const double begin : {2.7, 1.01, 3.9, 3.9999, 1e-3}) {
        Flow flow = flowAlongX(2e-4, 5, 3);
        flow.boundaries[1].face.reset();
        flow.boundaries[1].box_min.x() = begin;
        const SteadyFlow found = solved(oneJoint({4, 1, 1}, flow));
        CHECK(found.inflow_sum == doctest::Approx(cubicLaw(flow, 2e-4) * 2 / begin).epsilon(1e-9));
    }
}

TEST_CASE("flow: a drain's box may reach beyond the joint, or end just short of it, with little effect") {
    FlowBoundary drain = drainAt(10, 10, kDrain, kDrain);
    drain.box_min.x() = 19;
    drain.box_max.x() = 19.5;
    Flow flow = drainedFlow(drain);
    flow.boundaries.erase(flow.boundaries.begin() + 2);  // the end at +x is impermeable
    double& end = flow.boundaries[0].box_max.x();
    end = kJoint;
    const double to_the_end = discharge(drainedJoint(kJoint, flow));
    for (const double far : {kJoint - 1e-7, kJoint - 1e-5, kJoint - 1e-4, kJoint + 1, kJoint + 1e3}) {
        CAPTURE(far);
        end = far;
        CHECK(discharge(drainedJoint(kJoint, flow)) == doctest::Approx(to_the_end).epsilon(0.01));
    }
}

TEST_CASE("flow: many drains make a mesh of a few thousand triangles each") {
    constexpr std::size_t kDrains = kTriesFew ? 8 : 40;
    Flow flow = drainedFlow(drainAt(10, 10, kDrain, kDrain));
    for (std::size_t k = 1; k < kDrains; ++k) {
        const auto at = static_cast<double>(k);
        flow.boundaries.insert(
            flow.boundaries.begin(),
            drainAt(1 + 18 * at / kDrains, 2 + std::fmod(7.3 * at, 16), 0.05, k % 3 > 0 ? 0.05 : 0.8));
    }
    const SteadyFlow found = solved(drainedJoint(kJoint, flow));
    CHECK(found.triangles.size() < kDrains * 4000);
    for (std::size_t b = 0; b < kDrains; ++b) CHECK(found.boundaries[b].outflow > 0);
}
