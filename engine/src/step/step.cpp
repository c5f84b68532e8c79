#include "step/step.h"

#include <cassert>
#include <cmath>

#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "state/block_motion.h"
#include "step/motion.h"

namespace talus {
namespace {

constexpr std::size_t kBlocksPerTask = 512;
constexpr std::size_t kGroupsPerTask = 64;

}  // namespace

void updateForces(State& state, bool parallel) {
    forRange(state.blocks.size(), kBlocksPerTask, parallel, [&](Range range) { updateSpin(state, range); });
    forRange(state.interfaces.groups.size(), kGroupsPerTask, parallel,
             [&](Range range) { updateContacts(state, range); });
    updateBlockForces(state);
    forRange(state.blocks.size(), kBlocksPerTask, parallel, [&](Range range) { gather(state, range, 0.0); });
}

void advance(State& state, const StepOptions& options, int steps, const SetLoad& set_load) {
    const double dt = options.time_step;
    assert(steps >= 0 && dt > 0 && std::isfinite(dt));
    const auto onBlocks = [&](void (*stage)(State&, Range, double)) {
        forRange(state.blocks.size(), kBlocksPerTask, options.parallel,
                 [&](Range range) { stage(state, range, dt); });
    };
    if (steps > 0) onBlocks(drift);
    for (int k = 0; k < steps; ++k) {
        if (set_load) set_load(k);
        forRange(state.interfaces.groups.size(), kGroupsPerTask, options.parallel,
                 [&](Range range) { updateContacts(state, range); });
        updateBlockForces(state);
        onBlocks(k + 1 < steps ? gatherAndDrift : gather);
        ++state.step;
    }
}

}  // namespace talus
