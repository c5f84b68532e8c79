#include "equilibrium/release.h"

#include <algorithm>

namespace talus::equilibrium {
namespace {

constexpr int kMostReleaseSteps = 200;

}  // namespace

Released release(EquilibriumPath& path, double load, const Parting& since, double leaves,
                 std::int64_t most_factors) {
    const std::int64_t begin = path.work().factors;
    path.putUnder(load);
    const double step_length = std::min(path.rules().step_displacement, leaves / path.rules().release_looks);
    for (int k = 0; k < kMostReleaseSteps && !path.stopped(); ++k) {
        if (path.work().factors - begin > most_factors) return Released::lost;
        PathStep rest = path.toRest();
        if (rest && path.partedBy(rest) <= step_length) {
            path.commit(std::move(rest));
        } else {
            PathStep step = path.against(step_length);
            if (!step) return Released::lost;
            path.commit(std::move(step));
        }
        if (path.isBalanced() && !path.bondsGive() && !path.renewPressure()) return Released::rests;
        if (path.partedSince(since) > leaves) return Released::left;
    }
    return Released::lost;
}

Released releaseFromHeldJoints(EquilibriumPath& path, double load, const Parting& since, double leaves) {
    path.putUnder(load);
    PathStep rest = path.fromHeldJoints();
    if (rest && path.partedBy(rest) <= leaves) path.commit(std::move(rest));
    return release(path, load, since, leaves);
}

}  // namespace talus::equilibrium
