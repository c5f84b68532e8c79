// Steady flow in joints against closed formulas and balances.

#include <doctest/doctest.h>

#include "support/solved_flow.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Under the block on the floor, with heads at its +x and its -x end [m].
Water uplift(double high, double low) {
    Water water;
    water.kind = Water::Level::head;
    water.head = {high, low};
    water.pair = {1, 0};
    water.field = "water[0]";
    return water;
}

/// A joint of its own under one of the blocks.
void setBase(Model& model, std::int32_t block, double aperture) {
    const auto joint_index = static_cast<std::int32_t>(model.joints.size());
    model.joints.push_back(joint(30));
    model.joints.back().name = "base" + std::to_string(joint_index);
    model.pair_joints.push_back({0, block, joint_index, true, "interface[0]"});
    model.flow->joint_apertures.emplace_back(joint_index, aperture);
}

}  // namespace

TEST_CASE("flow: one joint, q = rho g b^3 dH w / (12 mu L)") {
    const Flow flow = flowAlongX(2e-4, 5, 3);
    for (const double width : {1.0, 0.3}) {
        const SteadyFlow found = solved(oneJoint({4, width, 1}, flow));
        const double expected = cubicLaw(flow, 2e-4) * 2 / 4 * width;
        CHECK(found.inflow_sum == doctest::Approx(expected).epsilon(1e-12));
        CHECK(found.boundaries[0].inflow == doctest::Approx(expected).epsilon(1e-12));
        CHECK(found.boundaries[1].outflow == doctest::Approx(expected).epsilon(1e-12));
        CHECK(found.boundaries[0].outflow == 0);
        for (std::size_t n = 0; n < found.nodes.size(); ++n) {
            CHECK(found.head[n] == doctest::Approx(5 - 2 * found.nodes[n].x() / 4).epsilon(1e-12));
            CHECK(found.pressure[n] ==
                  doctest::Approx(9810 * (found.head[n] - found.nodes[n].z())).epsilon(1e-12));
        }
        for (const Vec3& q : found.discharge)
            CHECK((q - Vec3(cubicLaw(flow, 2e-4) / 2, 0, 0)).norm() < 1e-12 * cubicLaw(flow, 2e-4));
    }
}

TEST_CASE("flow: a head that nothing drains is warned of, in the flow and in searches") {
    Model model = oneJoint({4, 1, 1}, flowAlongX(2e-4, 1.5, 0.5));
    CHECK(solved(model).warnings.empty());
    CHECK_FALSE(says(safetyFactor(model, {.interval = false})->warnings, "nothing drains"));
    model.flow->boundaries.pop_back();
    const auto still = steadyFlow(model);
    REQUIRE(still.ok());
    CHECK(still->inflow_sum == 0);
    CHECK(
        says(still->warnings,
             "flow.boundary[0]: nothing drains the water of \"head\": no other boundary (given: \"head\")"));
    CHECK(says(safetyFactor(model, {.interval = false})->warnings, "nothing drains the water of \"head\""));
}

TEST_CASE("flow: a search for the tilt says which tilt its flow is of") {
    Model model = oneJoint({4, 1, 1}, flowAlongX(2e-4, 0.2, 0.1));
    model.gravity.tilt = radians(3);
    CHECK(says(criticalAngle(model, {.interval = false})->warnings,
               "flow: the pressure is that of the flow at the scenario's tilt, 3 deg, at every tilt"));
    CHECK_FALSE(says(safetyFactor(model, {.interval = false})->warnings, "scenario's tilt"));
    model.flow->coupled = true;
    CHECK_FALSE(says(criticalAngle(model, {.interval = false})->warnings, "scenario's tilt"));
}

TEST_CASE("flow: joints in series, of equal and of unequal apertures") {
    for (const double second : {1e-4, 3e-4}) {
        Model model = oneJoint({4, 1, 1}, flowAlongX(1e-4, 5, 3));
        addBox(model, "next", {4, 0, 0}, {2, 1, 1});
        setBase(model, 2, second);
        const double resistance = 4 / cubicLaw(*model.flow, 1e-4) + 2 / cubicLaw(*model.flow, second);
        CHECK(solved(model).inflow_sum == doctest::Approx(2 / resistance).epsilon(1e-11));
    }
}

TEST_CASE("flow: joints in parallel") {
    Model model = oneJoint({4, 1, 1}, flowAlongX(1e-4, 5, 3));
    model.blocks.push_back(box("roof", {0, 0, 1}, {4, 1, 2}, 2700, Motion::fixed));
    setBase(model, 1, 2e-4);
    const double sum = cubicLaw(*model.flow, 1e-4) + cubicLaw(*model.flow, 2e-4);
    CHECK(solved(model).inflow_sum == doctest::Approx(sum * 2 / 4).epsilon(1e-12));
}

TEST_CASE("flow: polygons in space that cross carry a linear head exactly") {
    // Eight cubes: three planes cross. The floor's joint is the fourth.
    Model model = stackModel(2, 2, 2, 30, {1, 1, 1});
    model.flow = flowAlongX(1e-4, 9, 5);
    const SteadyFlow found = solved(model);
    // Along x: the floor's joint and the bed, each 2 m wide, and the joint between the slices, 2 m high.
    CHECK(found.inflow_sum == doctest::Approx(cubicLaw(*model.flow, 1e-4) * 4 / 2 * 6).epsilon(1e-11));
    for (std::size_t n = 0; n < found.nodes.size(); ++n)
        CHECK(found.head[n] == doctest::Approx(9 - 2 * found.nodes[n].x()).epsilon(1e-11));
}

TEST_CASE("flow: the head at a crossing of equal joints is the mean of their ends") {
    Model model = stackModel(2, 2, 1, 30, {1, 1, 1});
    model.blocks.erase(model.blocks.begin());  // the floor
    model.flow = flowAlongX(1e-4, 9, 5);
    model.flow->boundaries.push_back(headAt(Vec3::UnitZ(), 6));
    model.flow->boundaries.push_back(headAt(-Vec3::UnitZ(), 4));
    const SteadyFlow found = solved(model);
    for (std::size_t n = 0; n < found.nodes.size(); ++n)
        if ((found.nodes[n] - Vec3(1, found.nodes[n].y(), 1)).norm() < 1e-9 &&
            std::abs(found.nodes[n].y() - 0.5) > 0.4)
            CHECK(found.head[n] == doctest::Approx(6).epsilon(1e-11));
}

TEST_CASE("flow: a square joint between halves of two opposite sides converges as its mesh is refined") {
    std::vector<double> inflow;
    for (const int refinements : {1, 2, 3, 4}) {
        Model model = oneJoint({1, 1, 1}, flowAlongX(1e-4, 5, 3));
        model.flow->boundaries[0].box_max = Vec3(9, 0.5, 9);
        model.flow->boundaries[1].box_min = Vec3(-9, 0.5, -9);
        model.flow->refinements = refinements;
        inflow.push_back(solved(model).inflow_sum);
    }
    // Finite elements with given heads bound the flow from above.
    for (std::size_t k = 1; k < inflow.size(); ++k) CHECK(inflow[k] < inflow[k - 1]);
    CHECK(inflow[3] > 0.9 * inflow[2]);
}

TEST_CASE("flow: Dupuit's discharge through a dam of dense joints, q = K (h1^2 - h2^2) / (2 L)") {
    const Model model = gridDam(18, 15, 1, {0.5, 1, 0.5}, 6, 1.2);
    const SteadyFlow found = solved(model);
    const double dupuit = kMobility * 9810 * (36 - 1.44) / 18;
    CHECK(dupuit == doctest::Approx(1.8835e-6).epsilon(1e-4));
    CHECK(found.inflow_sum == doctest::Approx(dupuit).epsilon(5e-3));
    // The free surface falls from the upstream level to a seepage face above the downstream one.
    CHECK(found.highest_surface == doctest::Approx(6).epsilon(0.05));
    CHECK(found.boundaries[1].highest_outflow > 1.2);
    CHECK(found.boundaries[1].highest_outflow < 3);
    for (std::size_t n = 0; n < found.nodes.size(); ++n) CHECK(found.pressure[n] >= 0);
    for (const Vec3& x : found.free_surface) CHECK(x.z() <= 6 + 0.25);
    CHECK(found.residual <= 1e-9);
    CHECK(found.ramp < 0.01 * 0.5);  // of the height of a polygon
}

TEST_CASE("flow: a section in space, three slices thick, carries three times as much") {
    const SteadyFlow section = solved(gridDam(6, 5, 1, {1.5, 1, 1.5}, 6, 1.2));
    Model thick = gridDam(6, 5, 3, {1.5, 1, 1.5}, 6, 1.2);
    thick.joints.push_back(joint(10));  // between the slices, tight
    thick.joints[2].name = "slices";
    for (std::size_t b = 1; b < thick.blocks.size(); ++b)
        for (const Vec3& across : {Vec3(Vec3::UnitY()), Vec3(-Vec3::UnitY())})
            thick.blocks[b].face_joint[static_cast<std::size_t>(faceTowards(thick, b, across))] = 2;
    thick.flow->joint_apertures.emplace_back(2, 1e-8);
    const SteadyFlow found = solved(thick);
    CHECK(found.inflow_sum == doctest::Approx(3 * section.inflow_sum).epsilon(1e-6));
    const Vec3 far_end(0, 2, 0);
    std::size_t compared = 0;
    for (std::size_t n = 0; n < section.nodes.size(); ++n)
        for (std::size_t m = 0; m < found.nodes.size(); ++m)
            if ((found.nodes[m] - section.nodes[n] - far_end).norm() < 1e-9) {
                CHECK(std::abs(found.head[m] - section.head[n]) < 1e-5);
                ++compared;
            }
    CHECK(compared > section.nodes.size() / 2);
}

TEST_CASE("flow: a part that no head reaches is dry, and said to be") {
    Model model = oneJoint({4, 1, 1}, flowAlongX(1e-4, 5, 3));
    addBox(model, "alone", {8, 0, 0}, {1, 1, 1});
    model.flow->boundaries[0].box_max.x() = 5;
    model.flow->boundaries[1].box_max.x() = 5;
    const SteadyFlow found = solved(model);
    CHECK(found.unreached_patches == 1);
    REQUIRE(found.warnings.size() == 1);
    CHECK(found.warnings[0].find("\"alone\"") != std::string::npos);
    for (std::size_t n = 0; n < found.nodes.size(); ++n)
        if (found.nodes[n].x() > 7) CHECK(found.pressure[n] == 0);
}

TEST_CASE("flow: a drain draws the free surface down") {
    Model model = gridDam(9, 7, 1, {1, 1, 1}, 6, 1.2);
    const SteadyFlow before = solved(model);
    FlowBoundary drain = outletAt(Vec3::UnitX());
    drain.face.reset();
    drain.box_min = Vec3(3.9, -1, -0.1);
    drain.box_max = Vec3(4.1, 2, 0.1);
    model.flow->boundaries.push_back(drain);
    const SteadyFlow after = solved(model);
    CHECK(after.boundaries[2].outflow > 0);
    CHECK(after.boundaries[2].inflow == 0);
    CHECK(after.inflow_sum > before.inflow_sum);
    const auto wetOf = [](const SteadyFlow& flow) {
        double sum = 0;
        for (std::size_t t = 0; t < flow.triangles.size(); ++t) {
            const auto at = [&](std::size_t k) -> const Vec3& {
                return flow.nodes[static_cast<std::size_t>(flow.triangles[t][k])];
            };
            sum += flow.wet_share[t] * (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
        }
        return sum;  // [m^2]
    };
    CHECK(wetOf(after) < wetOf(before));
}

TEST_CASE("flow: what cannot be is refused") {
    const auto refusal = [](const Model& model) {
        const auto flow = steadyFlow(model);
        REQUIRE_FALSE(flow.ok());
        return flow.errors().front().field + ": " + flow.errors().front().message;
    };
    const auto contains = [](const std::string& text, const char* part) {
        CAPTURE(text);
        CHECK(text.find(part) != std::string::npos);
    };
    Model model = oneJoint({4, 1, 1}, flowAlongX(1e-4, 5, 3));
    model.flow->boundaries[0].box_max.x() = -50;
    contains(refusal(model), "flow.boundary[0]: found no open end of a joint");
    model = oneJoint({4, 1, 1}, flowAlongX(1e-4, -5, -3));
    model.flow->free_surface = true;
    contains(refusal(model), "flow: found no place of the network with a head");
    model = oneJoint({4, 1, 1}, flowAlongX(1e-4, 5, 3));
    model.blocks[1].shape = *makeBox({0, 0, 2}, {4, 1, 3});
    contains(refusal(model), "flow: found no joint between two blocks");
    model = oneJoint({4, 1, 1}, flowAlongX(1e-4, 5, 3));
    model.waters.push_back(uplift(1, 0));
    contains(refusal(model), "water[0]: found water in a joint beside flow");
}

TEST_CASE("flow: a head below all of its boundary is refused, because it would be a drain") {
    Model model = gridDam(6, 5, 1, {1, 1, 1}, 4, 0.6);
    for (FlowBoundary& boundary : model.flow->boundaries) boundary.box_min.z() = 0.5;
    model.flow->boundaries[1].field = "flow.boundary[1]";
    const auto refused = steadyFlow(model);
    REQUIRE_FALSE(refused.ok());
    REQUIRE(refused.errors().size() == 1);
    CHECK(refused.errors().front().field == "flow.boundary[1].head");
    CHECK(refused.errors().front().message.starts_with(
        "found 0.600, below the whole of its boundary, which reaches from 1.000 to 4.000 m"));
    model.flow->boundaries[1].head = 1;
    CHECK(steadyFlow(model).ok());
    model.flow->boundaries[1].head = 0.6;
    model.flow->free_surface = false;  // then a head counts wherever its boundary lies
    CHECK(steadyFlow(model).ok());
}

TEST_CASE("flow: still water is found, with and without a finer mesh") {
    for (const int refinements : {0, 1, 2}) {
        CAPTURE(refinements);
        Model model = gridDam(4, 4, 1, {1, 1.3, 0.9}, 2.3, 0);
        model.flow->boundaries.pop_back();
        model.flow->refinements = refinements;
        const auto found = steadyFlow(model);
        for (const Error& error : found.errors()) FAIL_CHECK(error.field, ": ", error.message);
        REQUIRE(found.ok());
        for (const double head : found->head) CHECK(head == doctest::Approx(2.3).epsilon(1e-9));
        CHECK(found->residual == 0);
        CHECK(found->inflow_sum < 1e-12 * cubicLaw(*model.flow, model.flow->aperture));
    }
}

TEST_CASE("flow: a boundary of many nodes with one head passes their sum, also of thin polygons") {
    // Obtuse triangles give neighbouring nodes inflows of both signs.
    Model model = gridDam(6, 5, 1, {1, 0.05, 1}, 4, 0.6);
    model.flow->boundaries[0].face.reset();
    model.flow->boundaries[0].box_max.x() = 1.5;
    const SteadyFlow found = solved(model);
    CHECK(found.boundaries[0].outflow == 0);
    CHECK(found.boundaries[0].highest_outflow == -kInfinity);
    CHECK(found.boundaries[0].inflow == doctest::Approx(found.boundaries[1].outflow).epsilon(1e-9));
}

TEST_CASE("flow: the discharge of a section per metre does not depend on its thickness") {
    const SteadyFlow thin = solved(gridDam(6, 5, 1, {1, 1, 1}, 4, 0.6));
    for (const double thickness : {0.1, 200.0}) {
        CAPTURE(thickness);
        const SteadyFlow found = solved(gridDam(6, 5, 1, {1, thickness, 1}, 4, 0.6));
        CHECK(found.warnings.empty());
        CHECK(found.inflow_sum / thickness == doctest::Approx(thin.inflow_sum).epsilon(5e-3));
    }
}

TEST_CASE("flow: its pressure lowers the factor of safety of a block on an inclined joint") {
    // U = rho g h / 2 L w under a pressure that falls linearly to nothing at the lower end.
    const double length = 4, width = 1, height = 2, tilt = radians(20), h = 1.5, friction = 30;
    Model model = floorModel(friction);
    addBox(model, "box", {0, 0, 0}, {length, width, height});
    model.gravity.tilt = tilt;
    model.flow = flowAlongX(1e-4, 0, length * std::sin(tilt) + h);
    const double weight = 2700 * 9.81 * length * width * height, push = 9810 * h / 2 * length * width;
    const double expected =
        (weight * std::cos(tilt) - push) * std::tan(radians(friction)) / (weight * std::sin(tilt));
    Control control;
    const auto result = safetyFactor(model, control);
    REQUIRE(result.ok());
    const bool found = result->status == SearchStatus::found;
    CHECK(found);
    CHECK(result->answer == doctest::Approx(expected).epsilon(2e-3));
    // The same as of the water between two heads that has a closed form in the engine.
    Model beside = model;
    beside.flow.reset();
    beside.waters.push_back(uplift(h / std::cos(tilt), 0));
    const auto other = safetyFactor(beside, control);
    REQUIRE(other.ok());
    CHECK(result->answer == doctest::Approx(other->answer).epsilon(2e-3));
}
