#include "step/energy_keeper.h"

#include <algorithm>
#include <vector>

#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "state/range.h"
#include "step/relative_motion.h"

namespace talus {
namespace {

constexpr double kMostShare = 0.5;
constexpr int kRounds = 4;  // one is exact but where several contacts share a block

/// Idle and open places hold no energy; there are many of them.
bool holdsNothing(const State& state, std::size_t i) {
    return isIdle(state.interfaces, i) ||
           (isVertexEdge(state.interfaces, i) && relativePose(state, i).gap.x() >= 0);
}

struct Touch {
    std::size_t interface;
    Vec3 place;
};

std::vector<Touch> touches(const State& state, double since) {
    std::vector<Touch> found;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        if (isIdle(state.interfaces, i)) continue;
        const DeepestPoint deepest = deepestPoint(state, i);
        if (deepest.depth > -since * motionAt(state, i, deepest.place).speed)
            found.push_back({i, deepest.place});
    }
    return found;
}

}  // namespace

double totalEnergy(const State& state, bool parallel) {
    constexpr std::size_t kInterfacesPerTask = 256;
    std::vector<double> held(state.interfaces.size());
    forRange(held.size(), kInterfacesPerTask, parallel, [&](Range range) {
        for (std::size_t i = range.begin; i < range.end; ++i)
            held[i] = holdsNothing(state, i) ? 0.0 : storedEnergy(contactsOf(state), i);
    });
    double sum = kineticEnergy(state) + gravityEnergy(state);
    for (const double energy : held) sum += energy;  // in stored order, however many threads there are
    return sum;
}

bool isLeftAlone(const State& state) {
    return !hasBlockForces(state) && !state.load.shaken &&
           std::none_of(state.blocks.motion.begin(), state.blocks.motion.end(),
                        [](Motion motion) { return motion == Motion::driven; });
}

void takeBack(State& state, double energy, double since, bool parallel) {
    if (!(energy > 0)) return;
    const std::vector<Touch> touching = touches(state, since);
    const double kinetic = kineticEnergy(state);
    double left = energy;
    for (int round = 0; round < kRounds && left > 1e-15 * kinetic; ++round) {
        double moving = 0;
        for (const Touch& touch : touching) moving += motionAt(state, touch.interface, touch.place).energy();
        if (!(moving > 0)) break;
        const double share = std::min(kMostShare, left / moving);
        for (const Touch& touch : touching) {
            const RelativeMotion motion = motionAt(state, touch.interface, touch.place);
            if (motion.energy() > 0)
                takeEnergy(state, touch.interface, touch.place, motion, share * motion.energy());
        }
        left = energy - (kinetic - kineticEnergy(state));
    }
    forRange(state.blocks.size(), 512, parallel, [&](Range range) { updateSpin(state, range); });
}

}  // namespace talus
