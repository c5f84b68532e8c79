// Flow in the joints of a model, without the forces on its blocks.

#include "build/build.h"
#include "flow/flow_in.h"
#include "forces/flow_water.h"

namespace talus {

Result<SteadyFlow> steadyFlow(const Model& model, const Control& control) {
    Model dry = model;
    dry.flow.reset();
    const auto state = buildState(std::move(dry), true);
    if (!state) return state.errors();
    if (auto errors = flow_water::conflicts(*state, *model.flow); !errors.empty()) return errors;
    return flow::flowIn(*state, *model.flow, control.progress);
}

}  // namespace talus
