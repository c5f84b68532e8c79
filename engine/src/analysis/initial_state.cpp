#include "analysis/initial_state.h"

#include <utility>

#include "analysis/quasi_static.h"
#include "stages/contacts.h"
#include "stages/patches.h"
#include "state/build.h"

namespace talus::analysis {
namespace {

constexpr double kLoadTolerance =
    1e-4;  // at rest when the out-of-balance force is below 1 % of this share of the weight
constexpr double kHeldStrength = 1e15;  // [Pa], of joints that do not give way

/// Puts weight, then water on; true when the assembly comes to rest.
bool comesToRest(State& state, const Control& control, bool parallel) {
    QuasiStaticWork work = prepare(state, QuasiStatic{}, control, kLoadTolerance, parallel);
    state.load.gravity_share = state.load.water_share = 0;
    const Ramp gravity = [](State& s, double share) { s.load.gravity_share = share; };
    const Ramp water = [](State& s, double share) { s.load.water_share = share; };
    if (bringOn(state, work, gravity).verdict != Verdict::stable) return false;
    return state.geometry->model.waters.empty() || bringOn(state, work, water).verdict == Verdict::stable;
}

/// The start of the history from a state that has come to rest: true inertia, the model's own damping and velocities.
void takeOver(State& state, State&& at_rest) {
    at_rest.damping = state.damping;
    at_rest.release = state.release;
    at_rest.warnings = state.warnings;
    at_rest.time = state.time;
    at_rest.step = state.step;
    setInertia(at_rest, std::vector<double>(at_rest.blocks.size(), 1.0));
    at_rest.blocks.velocity = state.blocks.velocity;
    at_rest.blocks.angular_momentum = state.blocks.angular_momentum;
    state = std::move(at_rest);
}

/// The same model with joints that hold, where it has come to rest.
bool findHeld(State& state, const Control& control, bool parallel) {
    Model model = state.geometry->model;
    for (Joint& joint : model.joints)
        joint.cohesion = joint.tensile_strength = joint.residual_cohesion = kHeldStrength;
    Result<State> held = buildState(std::move(model), parallel);
    if (!held || !comesToRest(*held, control, parallel)) return false;
    state.blocks.position = held->blocks.position;
    state.blocks.orientation = held->blocks.orientation;
    return true;
}

}  // namespace

bool touchesSomething(const State& state, std::size_t b) {
    for (auto k = state.incidence.interface_begin[b]; k < state.incidence.interface_begin[b + 1]; ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (stages::relativePose(state, i).gap.x() <= stages::kClosedGap * state.geometry->size[b])
            return true;
    }
    return false;
}

InitialState bringToStart(State& state, const Control& control, bool parallel) {
    const Model& model = state.geometry->model;
    if (model.run.start == RunSettings::Start::unstressed || !(model.gravity.magnitude > 0))
        return InitialState::unstressed;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free && !touchesSomething(state, b))
            return InitialState::unstressed;
    State at_rest = state;
    if (comesToRest(at_rest, control, parallel)) {
        takeOver(state, std::move(at_rest));
        return InitialState::equilibrium;
    }
    return findHeld(state, control, parallel) ? InitialState::held : InitialState::unstressed;
}

}  // namespace talus::analysis
