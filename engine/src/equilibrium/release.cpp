#include "equilibrium/release.h"

#include <algorithm>

namespace talus::equilibrium {
namespace {

constexpr int kMostReleaseSteps = 2'000;
// A slide is given up after that many factorisations, as its blocks do not move as one body. Slides of small
// models take a hundred at most.
constexpr std::int64_t kMostOfSlide = 100;
// Of the longest step: a shorter slide counts as no progress, and steps in pseudo-time follow.
constexpr double kLongSlide = 0.5;

/// Steps of a release: to equilibrium, where it is near; else of a given length in the direction of the slide;
/// and where that takes too much work, in pseudo-time.
class Steps {
 public:
    Steps(EquilibriumPath& path, double length)
        : path_(path), length_(length), drag_(path.rules().relaxation_drag) {}

    PathStep next() {
        if (!slides_) return path_.relax(length_, drag_);
        PathStep rest = path_.toRest();
        if (rest && path_.partedBy(rest) <= length_) return rest;
        PathStep slide = path_.against(length_, kMostOfSlide);
        slides_ = slide && path_.partedBy(slide) >= kLongSlide * length_;
        return slide ? slide : path_.relax(length_, drag_);
    }

 private:
    EquilibriumPath& path_;
    double length_, drag_;
    bool slides_ = true;
};

}  // namespace

Released release(EquilibriumPath& path, double load, const Parting& since, double leaves,
                 const std::function<bool()>& is_given_up) {
    path.putUnder(load);
    Steps steps(path, std::min(path.rules().step_displacement, leaves / path.rules().release_looks));
    for (int k = 0; k < kMostReleaseSteps && !path.stopped(); ++k) {
        if (is_given_up && is_given_up()) return Released::lost;
        PathStep step = steps.next();
        if (!step) return Released::lost;
        path.commit(std::move(step));
        if (path.isBalanced() && !path.bondsGive() && !path.renewPressure()) return Released::rests;
        if (path.partedSince(since) > leaves) return Released::left;
    }
    return Released::lost;
}

Released releaseFromHeldJoints(EquilibriumPath& path, double load, const Parting& since, double leaves,
                               const std::function<bool()>& is_given_up) {
    path.putUnder(load);
    PathStep rest = path.fromHeldJoints();
    if (rest && path.partedBy(rest) <= leaves) path.commit(std::move(rest));
    return release(path, load, since, leaves, is_given_up);
}

}  // namespace talus::equilibrium
