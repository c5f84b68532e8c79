#include "history/initial_state.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "build/build.h"
#include "checks/loose_blocks.h"
#include "contacts/update.h"
#include "forces/contact_forces.h"
#include "history/quasi_static.h"
#include "state/block_motion.h"
#include "state/caller.h"

namespace talus::history {
namespace {

constexpr double kLoadTolerance =
    1e-4;  // in equilibrium when the out-of-balance force is below 1 % of this share of the weight
constexpr double kHeldStrength = 1e15;  // [Pa], of unbreakable joints

/// Applies weight, then water; true when the assembly reaches equilibrium.
bool comesToRest(State& state, const Control& control, bool parallel) {
    QuasiStaticWork work = prepare(state, QuasiStatic{}, control, kLoadTolerance, parallel);
    state.load.gravity_share = state.load.water_share = 0;
    const Ramp gravity = [](State& s, double share) { s.load.gravity_share = share; };
    const Ramp water = [](State& s, double share) { s.load.water_share = share; };
    if (bringOn(state, work, gravity).verdict != Verdict::stable) return false;
    return !state.geometry->model.hasWater() || bringOn(state, work, water).verdict == Verdict::stable;
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
    if (!held || !comesToRest(*held, control, parallel)) return std::nullopt;
    return Poses{std::move(held->blocks.position), std::move(held->blocks.orientation)};
}

}  // namespace

InitialState bringToStart(State& state, const Control& control, bool parallel) {
    const std::shared_ptr<const Model> model = state.geometry->description;
    if (model->run.start == RunSettings::Start::unstressed || !(model->gravity.magnitude > 0))
        return InitialState::unstressed;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free && !checks::touchesSomething(state, b))
            return InitialState::unstressed;
    AsBuilt built = asBuilt(state);
    if (comesToRest(state, control, parallel)) {
        giveBack(std::move(built), state);
        return InitialState::equilibrium;
    }
    // Built again rather than copied, and one state at a time: with a million blocks each takes two
    // gigabytes.
    if (isStopped(control)) return InitialState::unstressed;
    state = {};
    std::optional<Poses> held = findHeld(*model, control, parallel);
    if (isStopped(control)) return InitialState::unstressed;
    Result<State> anew = buildState(model, parallel, control);
    if (!anew) return InitialState::unstressed;
    state = *std::move(anew);
    if (!held) return InitialState::unstressed;
    state.blocks.position = std::move(held->position);
    state.blocks.orientation = std::move(held->orientation);
    return InitialState::held;
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
