#include "equilibrium/release.h"

#include <algorithm>

namespace talus::equilibrium {
namespace {

constexpr int kMostReleaseSteps = 2'000;
// Steps in pseudo-time that together move neighbours by less than this share of the longest step make no
// progress: nearly all contact points are at their limit, and go over it and back.
constexpr int kStepsOfProgress = 5;
constexpr double kLeastProgress = 3e-3;
// Of the longest step: shorter slides are no progress, either.
constexpr double kLongSlide = 0.5;

/// Steps of a release. They are steps in pseudo-time, where blocks move in many ways. Where all slide at their
/// limit, as one, they are steps of a given length in the direction of the slide.
class Steps {
 public:
    Steps(EquilibriumPath& path, double length)
        : path_(path), length_(length), drag_(path.rules().relaxation_drag) {}

    PathStep next() {
        if (slides_ || is_first_) {
            PathStep rest = path_.toRest();
            if (rest && path_.partedBy(rest) <= length_) return rest;
        }
        is_first_ = false;
        if (!slides_) return inPseudoTime();
        PathStep slide = path_.against(length_);
        if (!slide || path_.partedBy(slide) < kLongSlide * length_) slides_ = false;
        return slide ? slide : inPseudoTime();
    }

 private:
    PathStep inPseudoTime() {
        if (count_ == 0) since_ = path_.parting();
        PathStep step = path_.relax(length_, drag_);
        if (!step || ++count_ < kStepsOfProgress) return step;
        slides_ = path_.partedAfter(since_, step) < kLeastProgress * length_;
        count_ = 0;
        return step;
    }

    EquilibriumPath& path_;
    double length_, drag_;
    Parting since_{};
    int count_ = 0;
    bool slides_ = false, is_first_ = true;
};

}  // namespace

Released release(EquilibriumPath& path, double load, const Parting& since, double leaves,
                 std::int64_t most_factors) {
    const std::int64_t begin = path.work().factors;
    path.putUnder(load);
    Steps steps(path, std::min(path.rules().step_displacement, leaves / path.rules().release_looks));
    for (int k = 0; k < kMostReleaseSteps && !path.stopped(); ++k) {
        if (path.work().factors - begin > most_factors) return Released::lost;
        PathStep step = steps.next();
        if (!step) return Released::lost;
        path.commit(std::move(step));
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
