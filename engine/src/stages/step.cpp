#include "stages/step.h"

#include "stages/contacts.h"
#include "stages/motion.h"
#include "stages/water.h"

namespace talus::stages {
namespace {

constexpr std::size_t kBlocksPerTask = 512;
constexpr std::size_t kGroupsPerTask = 64;

}  // namespace

void updateForces(State& state, bool parallel) {
    forRange(state.blocks.size(), kBlocksPerTask, parallel, [&](Range range) { updateSpin(state, range); });
    forRange(state.interfaces.groups.size(), kGroupsPerTask, parallel,
             [&](Range range) { updateContacts(state, range); });
    updateWater(state);
    forRange(state.blocks.size(), kBlocksPerTask, parallel, [&](Range range) { gather(state, range, 0.0); });
}

void advance(State& state, const StepOptions& options) {
    const double dt = options.time_step;
    const bool parallel = options.parallel;
    forRange(state.blocks.size(), kBlocksPerTask, parallel, [&](Range range) { drift(state, range, dt); });
    forRange(state.interfaces.groups.size(), kGroupsPerTask, parallel,
             [&](Range range) { updateContacts(state, range); });
    updateWater(state);
    forRange(state.blocks.size(), kBlocksPerTask, parallel, [&](Range range) { gather(state, range, dt); });
    ++state.step;
}

}  // namespace talus::stages
