#include "analysis/evidence.h"

#include <algorithm>
#include <utility>

namespace talus::analysis {
namespace {

// A failure is a failure when blocks have been seen to go some share of their size (kSeenShare) and gather speed. At the
// start, where no deflection at rest is known to compare with, more is asked for.
constexpr double kSeenAtStart = 0.01;
// Steps of the continuation: as many as the probes took, but a number that shows something, and not without bound.
constexpr std::int64_t kLeastSteps = 120'000, kMostSteps = 400'000, kMostStepsAtStart = 100'000;
// Slides are seen to in 1,000 to 16,000 steps, slow ones in 35,000. What is not is asked for rest before it takes as many as it may: of ten
// columns of 20 that lean on each other 120,000 showed nothing, and rest took 71 factorisations. As many where it is known that the
// assembly fails, standing again where it is jammed: then they only say how.
constexpr std::int64_t kFirstLook = 40'000;
// What is let go before it was watched patiently has to leave its place: a splinter may jump by some hundredths of its size.
constexpr double kLeavesItsPlace = 0.1;
constexpr std::int64_t kFirstLookAtStart = 20'000;  // what falls is seen to in 4,000 to 15,000

}  // namespace

Evidence evidenceOfFailure(const Probing& p, const Doubts& doubts) {
    if (doubts.at_start)
        return {.deflection = 0, .share = kSeenAtStart, .most_steps = kMostStepsAtStart, .alone = true};
    const double least = kSeenShare * p.last_stable.geometry->length_scale;
    const double settled = std::max(least, p.settlement), own = ownDeflection(p);
    const std::int64_t most = p.stands_elsewhere ? kFirstLook : std::clamp(p.steps, kLeastSteps, kMostSteps);
    return {.deflection = doubts.no_rest ? std::min(own, settled) : own,
            .share = kSeenShare,
            .most_steps = most,
            .most_steps_on_its_way = kMostSteps,
            .alone = doubts.alone};
}

Evidence doubted(Evidence wanted, std::function<bool()> rests) {
    wanted.doubted_after = kFirstLook;
    wanted.rests = std::move(rests);
    return wanted;
}

Evidence evidenceOfFall() {
    return {.deflection = 0, .share = kLeavesItsPlace, .most_steps = kFirstLookAtStart, .alone = true};
}

}  // namespace talus::analysis
