#pragma once
// The flow in a model, checked for balance, and the simplest model that has one.

#include <doctest/doctest.h>

#include "support/flows.h"
#include "support/models.h"
#include "talus/analysis.h"

namespace talus::test {

inline SteadyFlow solved(const Model& model) {
    auto flow = steadyFlow(model);
    for (const Error& error : flow.errors()) FAIL_CHECK(error.field, ": ", error.message);
    REQUIRE(flow.ok());
    CHECK(largestImbalance(*flow) < 1e-12);
    CHECK(flow->inflow_sum == doctest::Approx(flow->outflow_sum).epsilon(1e-12));
    return *flow;
}

/// One box of this size on the floor, heads at its ends.
inline Model oneJoint(const Vec3& size, const Flow& flow) {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, size);
    model.flow = flow;
    return model;
}

}  // namespace talus::test
