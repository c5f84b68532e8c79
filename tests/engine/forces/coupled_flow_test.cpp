#include "forces/coupled_flow.h"

#include <doctest/doctest.h>

#include <utility>

#include "build/build.h"
#include "forces/flow_water.h"
#include "forces/sum.h"
#include "support/flows.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A box of 4 m on the floor under a head that falls from 5 m at x = 0 to 1 m at x = 4.
State coupledState(int refinements = 0) {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, {4, 1, 1});
    model.flow = flowAlongX(1e-4, 5, 1);
    model.flow->coupled = true;
    model.flow->refinements = refinements;
    return *buildState(std::move(model), false);
}

/// Turns the box about the edge at x = 0: the joint opens by this at x = 4 [m].
void openAtEnd(State& state, double by) {
    const Eigen::Quaterniond turn = turnAbout(-Vec3::UnitY(), degrees(by / 4));
    const Eigen::Quaterniond before(state.blocks.orientation[1].w, state.blocks.orientation[1].x,
                                    state.blocks.orientation[1].y, state.blocks.orientation[1].z);
    const Eigen::Quaterniond after = turn * before;
    state.blocks.orientation[1] = {after.w(), after.x(), after.y(), after.z()};
    state.blocks.position.set(1, turn * state.blocks.position.get(1));
}

}  // namespace

TEST_CASE("coupled flow: while nothing has opened it is the flow as stated") {
    State state = coupledState();
    flow_water::CoupledFlow coupled(state);
    coupled.takeAsStated(state);
    const std::vector<double> before = state.coupled_pressure.push;
    CHECK_FALSE(coupled.renew(state, 0));
    CHECK(state.coupled_pressure.push == before);
    CHECK(state.coupled_pressure.change < 1e-12);
    CHECK(coupled.coupling(state).converged);
}

TEST_CASE("coupled flow: the head in a joint that opens like a wedge") {
    // b^3 dh/dx = -c with b = b0 + s x has h = h0 - c (1 / b0^2 - 1 / b^2) / (2 s).
    for (const int refinements : {0, 1, 2}) {
        CAPTURE(refinements);
        State state = coupledState(refinements);
        flow_water::CoupledFlow coupled(state);
        coupled.takeAsStated(state);
        openAtEnd(state, 1e-4);
        const SteadyFlow flow = *coupled.flowIn(state);
        const auto share = [](double x) {
            const double b = 1 + x / 4;
            return (1 - 1 / (b * b)) / (1 - 1.0 / 4);
        };
        double error = 0;
        for (std::size_t n = 0; n < flow.nodes.size(); ++n)
            error = std::max(error, std::abs(flow.head[n] - (5 - 4 * share(flow.nodes[n].x()))));
        CHECK(error < 1e-6 * 4);  // exact at the nodes of any mesh
    }
}

TEST_CASE("coupled flow: a pass puts the new pressure in, and the next one finds no change") {
    State state = coupledState(2);
    flow_water::CoupledFlow coupled(state);
    coupled.takeAsStated(state);
    openAtEnd(state, 1e-4);
    const Wrench before = blockForcesOn(state, 1);
    CHECK(coupled.renew(state, 0));
    CHECK(state.coupled_pressure.change > 0.05);
    // Wide at the low end, the joint holds less pressure.
    CHECK(blockForcesOn(state, 1).force.z() < 0.95 * before.force.z());
    CHECK_FALSE(coupled.renew(state, 1));
    CHECK(state.coupled_pressure.change < 1e-12);
    CHECK(coupled.coupling(state).converged);
    CHECK(coupled.coupling(state).passes == 1);
    CHECK(coupled.coupling(state).flows == 2);
}

TEST_CASE("coupled flow: what is left after the last pass is reported") {
    State state = coupledState();
    state.coupled_pressure.pressure_head.assign(state.coupled_pressure.pressure_head.size(), 9.0);
    flow_water::CoupledFlow coupled(state);
    coupled.takeAsStated(state);
    CHECK_FALSE(coupled.renew(state, state.geometry->model.flow->coupling_passes));
    const FlowCoupling found = coupled.coupling(state);
    CHECK_FALSE(found.converged);
    CHECK(found.largest_change == doctest::Approx(8.0 / 9).epsilon(1e-9));
}

TEST_CASE("coupled flow: without water it waits") {
    State state = coupledState();
    flow_water::CoupledFlow coupled(state);
    CHECK_FALSE(coupled.renew(state, 0));  // no apertures as stated yet
    coupled.takeAsStated(state);
    openAtEnd(state, 1e-4);
    state.load.water_share = 0;
    CHECK_FALSE(coupled.renew(state, 0));
    CHECK(coupled.coupling(state).flows == 0);
}

TEST_CASE(
    "coupled flow: its pressure is remembered for restarts, that of other flow follows from the model") {
    State state = coupledState();
    const std::vector<ForceArray> arrays = flow_water::memory(state);
    REQUIRE(arrays.size() == 1);
    CHECK(arrays[0].values.size() == 6 * state.blocks.size());
    State other = coupledState();
    std::vector<ForceArray> twice = arrays;
    for (double& x : twice[0].values) x *= 2;
    flow_water::remember(other, twice);
    CHECK((blockForcesOn(other, 1).force - 2 * blockForcesOn(state, 1).force).norm() < 1e-6);
    Model model = state.geometry->model;
    model.flow->coupled = false;
    const State plain = *buildState(std::move(model), false);
    CHECK(flow_water::memory(plain).empty());
    CHECK((blockForcesOn(plain, 1).force - blockForcesOn(state, 1).force).norm() == 0);
}

TEST_CASE("coupled flow: a change of pressure is counted over the largest, and suction not at all") {
    CHECK(flow_water::pressureChange({1, 2, -3}, {1, 2.5, -7}) == doctest::Approx(0.2));
    CHECK(flow_water::pressureChange({-1, -2}, {-3, -4}) == 0);
    CHECK(flow_water::pressureChange({4, 0}, {0, 0}) == 1);
}

TEST_CASE("coupled flow: the taper of a triangle, by hand, falls with the mesh") {
    // 1e-4 m at x = 0 and 2e-4 m at x = 4: triangles meet at x = 2 and reach from there to both ends.
    for (const auto& each : {std::pair(0, 2.0), std::pair(1, 1.5), std::pair(2, 1.25)}) {
        const int refinements = each.first;
        const double taper = each.second;
        CAPTURE(refinements);
        State state = coupledState(refinements);
        flow_water::CoupledFlow coupled(state);
        CHECK(coupled.doubtsOf(state).taper == 1);  // no apertures as stated yet
        coupled.takeAsStated(state);
        CHECK(coupled.doubtsOf(state).taper == 1);
        openAtEnd(state, 1e-4);
        const flow_water::ApertureDoubts found = coupled.doubtsOf(state);
        CHECK(found.taper == doctest::Approx(taper).epsilon(1e-4));
        CHECK(found.capped == 0);
        CHECK(found.wet == state.coupled_pressure.stated_opening.size() / 4);
    }
}

TEST_CASE("coupled flow: joints that open to more than ten times the stated aperture are counted") {
    State state = coupledState();
    flow_water::CoupledFlow coupled(state);
    coupled.takeAsStated(state);
    openAtEnd(state, 40e-4);  // 1 + 10 x times: 21 at x = 2, where each triangle has a corner, 41 at 4
    flow_water::ApertureDoubts found = coupled.doubtsOf(state);
    CHECK(found.wet == 4);
    CHECK(found.capped == 4);
    CHECK(found.most == doctest::Approx(41).epsilon(1e-4));
    for (double& head : state.coupled_pressure.pressure_head) head = 0;
    found = coupled.doubtsOf(state);  // no water
    CHECK(found.wet == 0);
    CHECK(found.capped == 0);
}
