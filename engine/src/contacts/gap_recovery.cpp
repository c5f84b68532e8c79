#include "contacts/gap_recovery.h"

#include <algorithm>
#include <cmath>

#include "contacts/limits.h"
#include "forces/contact_forces.h"
#include "state/incidence.h"
#include "step/relative_motion.h"

namespace talus {
namespace {

// Share of the energy of the relative motion, per look: negligible in an impact.
constexpr double kShare = 0.02;
// A slowly sliding pair of faces needs slightly more energy at each search, and would sink. So the first part
// of the recovery, a share of the smaller block's size, may take more. It is negligible in an impact, but
// more than such a pair needs.
constexpr double kFirstBit = 1e-6, kShareOfFirstBit = 0.5;

/// Of the smaller of two blocks [m].
double sizeOf(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    return std::min(state.geometry->size[static_cast<std::size_t>(f.block_a[i])],
                    state.geometry->size[static_cast<std::size_t>(f.block_b[i])]);
}

/// How far the reference gap is from where the faces are [m].
double gapToRecover(const State& state, std::size_t i) {
    return -state.interfaces.referenceGap(i, 0) - kClosedGap * sizeOf(state, i);
}

/// Raising the reference gap by o presses every spring by o more. Together they gain at most k A (depth o +
/// o^2/2), with the depth of the deepest. The gain is zero as long as that one is open. The blocks lose the
/// energy that the springs gain. \return whether anything changed
bool recoverGap(State& state, std::size_t i, double missing) {
    const DeepestPoint deepest = deepestPoint(state, i);
    const double depth = std::max(0.0, deepest.depth),
                 open = std::min(missing, std::max(0.0, -deepest.depth));
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    const RelativeMotion motion = motionAt(state, i, deepest.place);
    const auto paid = [&](double share) {
        return contact::pressedBy(law, state.interfaces.area[i], depth, share * motion.energy());
    };
    const double step =
        open + std::min(missing - open, std::max(paid(kShare), std::min(paid(kShareOfFirstBit),
                                                                        kFirstBit * sizeOf(state, i))));
    if (!(step > 0)) return false;
    const double before = storedEnergy(contactsOf(state), i);
    state.interfaces.referenceGap(i, 0) += step;
    if (const double cost = storedEnergy(contactsOf(state), i) - before; cost > 0 && cost < motion.energy())
        takeEnergy(state, i, deepest.place, motion, cost);
    return true;
}

}  // namespace

bool searchedAgain(const State& state) {
    const PositionArray &first = state.geometry->initial_position, &last = state.search_position;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (first.get(b) != last.get(b)) return true;
    return false;
}

bool recoverGaps(State& state) {
    bool changes = false;
    const bool faces_too = searchedAgain(state);
    for (const InterfaceGroup& group : state.interfaces.groups) {
        if (!isVertexEdge(state.interfaces, static_cast<std::size_t>(group.begin)) && !faces_too) continue;
        for (std::int32_t k = 0; k < group.size; ++k) {
            const auto i = static_cast<std::size_t>(group.begin + k);
            if (isIdle(state.interfaces, i)) continue;
            if (const double missing = gapToRecover(state, i); missing > 0)
                changes = recoverGap(state, i, missing) || changes;
        }
    }
    return changes;
}

}  // namespace talus
