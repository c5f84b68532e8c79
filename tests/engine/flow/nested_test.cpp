#include "flow/nested.h"

#include <doctest/doctest.h>

#include <cmath>

#include "flow/flow_in.h"
#include "support/flow_network.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A dam of square blocks, 4 m long and 5 m high, with 4.5 m and 1.2 m of water, and a drain on its base.
FlowNetwork drainedDam() {
    Model model = gridDam(4, 5, 1, {1, 1, 1}, 4.5, 1.2);
    FlowBoundary drain = outletAt(Vec3::UnitX());
    drain.face.reset();
    drain.box_min = Vec3(2.3, 0.3, -0.1);
    drain.box_max = Vec3(2.6, 0.7, 0.1);
    model.flow->boundaries.push_back(drain);
    return FlowNetwork(std::move(model));
}

flow::Network meshOf(const FlowNetwork& dam, int refinements) {
    return flow::networkOf(dam.state, refinements, dam.water.boundaries);
}

}  // namespace

TEST_CASE("nested flow: the mesh before a refinement is the one with a refinement less") {
    const FlowNetwork dam = drainedDam();
    for (const int refinements : {1, 2}) {
        CAPTURE(refinements);
        const flow::Network coarse = flow::coarser(meshOf(dam, refinements)),
                            stated = meshOf(dam, refinements - 1);
        CHECK(coarse.nodes == stated.nodes);
        CHECK(coarse.triangles == stated.triangles);
        CHECK(coarse.patch_of == stated.patch_of);
        CHECK(coarse.halved == stated.halved);
        CHECK(coarse.size == stated.size);
        CHECK(coarse.height == stated.height);
    }
}

TEST_CASE("nested flow: heads are those found without coarser meshes") {
    FlowNetwork dam = drainedDam();
    const flow::Network fine = meshOf(dam, 2);
    const std::vector<flow::Corners> apertures = flow::statedApertures(fine, dam.water);
    const double unit_weight = dam.water.density * 9.81;
    for (const bool free_surface : {false, true}) {
        CAPTURE(free_surface);
        dam.water.free_surface = free_surface;
        const auto conditions = flow::conditionsOf(fine, dam.water, dam.model, Vec3::Zero(), 0);
        REQUIRE(conditions.ok());
        const flow::Heads nested =
                              flow::nestedHeads(fine, *conditions, apertures, dam.water, unit_weight, {}),
                          alone = flow::solveHeads(fine, *conditions,
                                                   flow::transmissivities(apertures, dam.water, unit_weight),
                                                   free_surface);
        REQUIRE(nested.found);
        REQUIRE(alone.found);
        CHECK(nested.residual < 1e-9);
        double apart = 0;
        for (std::size_t n = 0; n < fine.nodes.size(); ++n)
            apart = std::max(apart, std::abs(nested.head[n] - alone.head[n]));
        CHECK(apart < 1e-6);
    }
}

TEST_CASE("nested flow: heads that lead nowhere are not taken") {
    const FlowNetwork dam = drainedDam();
    const std::vector<double> nowhere(dam.network.nodes.size(), std::nan(""));
    for (const bool free_surface : {false, true}) {
        const auto solved = [&](const std::vector<double>& begin) {
            return flow::solveHeads(dam.network, dam.conditions, dam.transmissivity, free_surface, {}, {},
                                    begin);
        };
        const flow::Heads found = solved(nowhere);
        REQUIRE(found.found);
        CHECK(found.head == solved({}).head);
    }
}
