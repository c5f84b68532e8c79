#pragma once
// The network of a model with flow, and the conditions on it, as the solution of flow has them.

#include <utility>
#include <vector>

#include "build/build.h"
#include "flow/conditions.h"
#include "flow/meshing.h"
#include "flow/upstream.h"
#include "support/flows.h"

namespace talus::test {

struct FlowNetwork {
    explicit FlowNetwork(Model of) : model(std::move(of)) {}

    Model model;
    Flow water = *model.flow;
    State state = [this] {
        Model dry = model;
        dry.flow.reset();
        return *buildState(std::move(dry), false);
    }();
    flow::Network network = flow::networkOf(state, 0, water.boundaries);
    flow::Conditions conditions = *flow::conditionsOf(network, water, model, Vec3::Zero(), 0);
    std::vector<flow::Corners> transmissivity = transmissivities();

 private:
    /// Of each triangle along its sides, by the aperture of its joint [m^2/s].
    std::vector<flow::Corners> transmissivities() const {
        std::vector<flow::Corners> values;
        for (std::size_t t = 0; t < network.triangles.size(); ++t) {
            const flow::Patch& patch = network.patch(t);
            double aperture = water.aperture;
            for (const auto& [joint, other] : water.joint_apertures)
                if (joint == patch.joint) aperture = other;
            const double along = cubicLaw(water, aperture);
            values.push_back({along, along, along});
        }
        return values;
    }
};

}  // namespace talus::test
