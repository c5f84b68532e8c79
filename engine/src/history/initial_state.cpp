#include "history/initial_state.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "build/build.h"
#include "checks/loose_blocks.h"
#include "checks/water_warnings.h"
#include "contacts/update.h"
#include "forces/contact_forces.h"
#include "forces/coupled_flow.h"
#include "history/quasi_static.h"
#include "state/block_motion.h"
#include "state/caller.h"

namespace talus::history {
namespace {

constexpr double kLoadTolerance =
    1e-4;  // in equilibrium when the out-of-balance force is below 1 % of this share of the weight
constexpr double kHeldStrength = 1e15;  // [Pa], of unbreakable joints

/// Coupled flow: its pressure follows the joints from equilibrium to equilibrium, until both agree.
bool settlesWithFlow(State& state, QuasiStaticWork& work, flow_water::CoupledFlow& coupled) {
    const Ramp none = [](State&, double) {};
    for (int pass = 0; coupled.renew(state, pass); ++pass)
        if (bringOn(state, work, none).verdict != Verdict::stable) return false;
    return true;
}

/// Of coupled flow: the weight on level ground, where joints have their stated apertures, and then the tilt;
/// as in a search. A given direction of gravity is that of a site.
bool bearsWeight(State& state, QuasiStaticWork& work, const Ramp& gravity, flow_water::CoupledFlow& coupled) {
    const double own = state.load.tilt;
    const bool has_level = !state.geometry->model.gravity.direction;
    if (has_level) state.load.tilt = 0;
    if (bringOn(state, work, gravity).verdict != Verdict::stable) return false;
    coupled.takeAsStated(state);
    if (!has_level || own == 0) return true;
    return bringOn(state, work, [own](State& s, double share) { s.load.tilt = share * own; }).verdict ==
           Verdict::stable;
}

/// Applies weight, then water; true when the assembly reaches equilibrium.
/// \param coupled  the flow, where it is; else nullptr
bool comesToRest(State& state, const Control& control, bool parallel, flow_water::CoupledFlow* coupled) {
    QuasiStaticWork work = prepare(state, QuasiStatic{}, control, kLoadTolerance, parallel);
    state.load.gravity_share = state.load.water_share = 0;
    const Ramp gravity = [](State& s, double share) { s.load.gravity_share = share; };
    const Ramp water = [](State& s, double share) { s.load.water_share = share; };
    const bool bears = coupled != nullptr ? bearsWeight(state, work, gravity, *coupled)
                                          : bringOn(state, work, gravity).verdict == Verdict::stable;
    if (!bears || !state.geometry->model.hasWater()) return bears;
    if (bringOn(state, work, water).verdict != Verdict::stable) return false;
    return coupled == nullptr || settlesWithFlow(state, work, *coupled);
}

std::optional<flow_water::CoupledFlow> coupledFlowOf(const State& built) {
    const std::optional<Flow>& flow = built.geometry->model.flow;
    if (!flow || !flow->coupled) return std::nullopt;
    return std::optional<flow_water::CoupledFlow>(std::in_place, built);
}

Error noBeginning(const Flow& flow, const std::string& why) {
    return {
        flow.field + ".coupled",
        "found no equilibrium that the history begins with, because " + why +
            "; coupled flow has its pressure from that; allowed: a slope that is stable under its own loads, "
            "or coupled = false. A search with --keep-run plays a failure under the pressure that acts then"};
}

/// The start where a free block touches nothing.
Result<InitialState> startOfLoose(const State& state, std::size_t block) {
    const Model& model = state.geometry->model;
    if (!model.flow || !model.flow->coupled) return InitialState::unstressed;
    return noBeginning(*model.flow, "block \"" + model.blocks[block].name + "\" touches no other block");
}

/// Settings of the history itself, whatever loads brought the state to its start.
struct AsBuilt {
    Damping damping;
    double release;
    std::vector<std::string> warnings;
    double time;
    std::int64_t step;
    VectorArray velocity, angular_momentum;
};

AsBuilt asBuilt(const State& state) {
    return {state.damping,
            state.release,
            state.warnings,
            state.time,
            state.step,
            state.blocks.velocity,
            state.blocks.angular_momentum};
}

/// The start of the history from equilibrium: true inertia, the model's own damping and velocities.
void giveBack(AsBuilt built, State& state) {
    state.damping = built.damping;
    state.release = built.release;
    state.warnings = std::move(built.warnings);
    state.time = built.time;
    state.step = built.step;
    setInertia(state, std::vector<double>(state.blocks.size(), 1.0));
    state.blocks.velocity = std::move(built.velocity);
    state.blocks.angular_momentum = std::move(built.angular_momentum);
}

struct Poses {
    PositionArray position;
    QuaternionArray orientation;
};

/// The equilibrium of the same model with unbreakable joints.
std::optional<Poses> findHeld(Model model, const Control& control, bool parallel) {
    for (Joint& joint : model.joints) joint = holding(std::move(joint), kHeldStrength);
    Result<State> held = buildState(std::move(model), parallel, control);
    if (!held || !comesToRest(*held, control, parallel, nullptr)) return std::nullopt;
    return Poses{std::move(held->blocks.position), std::move(held->blocks.orientation)};
}

Result<InitialState> findStart(State& state, const Control& control, bool parallel) {
    const std::shared_ptr<const Model> model = state.geometry->description;
    if (model->run.start == RunSettings::Start::unstressed || !(model->gravity.magnitude > 0))
        return InitialState::unstressed;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free && !checks::touchesSomething(state, b))
            return startOfLoose(state, b);
    AsBuilt built = asBuilt(state);
    auto coupled = coupledFlowOf(state);
    if (comesToRest(state, control, parallel, coupled ? &*coupled : nullptr)) {
        giveBack(std::move(built), state);
        if (coupled)
            for (std::string& doubt : checks::ofCoupling(*coupled, state))
                state.warnings.push_back(std::move(doubt));
        return InitialState::equilibrium;
    }
    if (coupled && !isStopped(control))
        return noBeginning(*model->flow, "blocks part while weight and water are applied slowly");
    // Built again rather than copied, and one state at a time: with a million blocks each takes two
    // gigabytes.
    if (isStopped(control)) return InitialState::unstressed;
    state = {};
    std::optional<Poses> held = findHeld(*model, control, parallel);
    if (isStopped(control)) return InitialState::unstressed;
    Result<State> anew = buildState(model, parallel, control);
    if (!anew) return InitialState::unstressed;
    state = *std::move(anew);
    state.warnings = std::move(built.warnings);
    if (!held) return InitialState::unstressed;
    state.blocks.position = std::move(held->position);
    state.blocks.orientation = std::move(held->orientation);
    return InitialState::held;
}

}  // namespace

Result<InitialState> bringToStart(State& state, const Control& control, bool parallel) {
    const Result<InitialState> start = findStart(state, control, parallel);
    if (!start || *start == InitialState::equilibrium || !state.geometry) return start;
    constexpr const char* kWhy = "the history does not begin in equilibrium";
    if (auto stated = checks::flowAsStated(state.geometry->model, kWhy))
        state.warnings.push_back(std::move(*stated));
    return start;
}

}  // namespace talus::history

namespace talus {

const char* toString(InitialState start) {
    switch (start) {
        case InitialState::equilibrium:
            return "equilibrium";
        case InitialState::held:
            return "held";
        case InitialState::unstressed:
            break;
    }
    return "unstressed";
}

}  // namespace talus
