#include "analysis/load_pace.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace talus::analysis {
namespace {

// So far blocks may part in a step, of what leaves their place; how much the next one may be longer; and how much longer than the
// axis's own.
constexpr double kPace = 0.25, kGrowth = 4.0;
constexpr std::int64_t kLongest = 4;

}  // namespace

std::int64_t LoadPace::next(std::int64_t own) const {
    return most_ > 0 ? std::clamp(most_, std::int64_t{1}, kLongest * own) : own;
}

void LoadPace::learn(std::int64_t step, double leaving) {
    const double grown = kPace / std::max(leaving, kPace / kGrowth);
    most_ = std::max<std::int64_t>(1, std::llround(static_cast<double>(step) * grown));
    if (cut_back_ == 0) return;
    const bool limits = most_ > cut_back_;
    most_ = std::min(most_, cut_back_);
    cut_back_ = limits ? 2 * cut_back_ : 0;
}

void LoadPace::cutBack(std::int64_t step) {
    assert(step >= 2);
    most_ = cut_back_ = step / 2;
}

}  // namespace talus::analysis
