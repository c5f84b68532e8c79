#include "history/watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"

namespace talus::history {
namespace {

constexpr int kLeastStepsPerWindow = 100;
constexpr double kFlatForce = 0.03;  // spread of the out-of-balance force over its mean, within a window
constexpr double kEven = 0.01;     // change of the motion from window to window: it goes on at the same speed
constexpr double kLevel = 0.05;    // change of the mean from window to window on a plateau with some noise
constexpr int kLevelWindows = 3;   // as many such windows in a row
constexpr int kWindowsInSpan = 4;  // where it is not flat: windows per span, and spans are compared
constexpr double kPlateau = 0.8;   // out-of-balance force of a span over that of the span before
constexpr double kSteadyMotion =
    0.9;  // motion of a window over that of the window before: it does not slow down
constexpr double kSlowestMotion = 32.0;  // slowest motion the drag is tuned to, in slowest periods

}  // namespace

std::string describe(const char* what, double out_of_balance, std::int64_t steps) {
    char text[160];
    std::snprintf(text, sizeof text, "%s %.2e of the weight after %lld steps", what, out_of_balance,
                  static_cast<long long>(steps));
    return text;
}

void Watch::Window::add(double ratio) {
    sum += ratio;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
    ++samples;
}

Watch::Watch(const State& state, double limit, int steps_per_period, double periods)
    : limit_(limit),
      steps_per_period_(steps_per_period),
      samples_per_window_(std::max(kLeastStepsPerWindow, static_cast<int>(periods * steps_per_period)) /
                          kStepsPerSample),
      position_(state.blocks.position),
      orientation_(state.blocks.orientation) {}

bool Watch::look(const State& state, Settling& settling) {
    const double ratio = outOfBalanceRatio(state);
    settling.out_of_balance = ratio;
    window_.add(ratio);
    span_.add(ratio);
    quiet_steps_ = ratio < limit_ ? quiet_steps_ + kStepsPerSample : 0;
    if (quiet_steps_ >= std::max(steps_per_period_, 2 * kStepsPerSample)) {
        settling.verdict = Verdict::stable;
        settling.reason = describe("equilibrium: out-of-balance force stays below", ratio, settling.steps);
        return true;
    }
    if (window_.samples < samples_per_window_) return false;
    return closeWindow(state, settling);
}

bool Watch::closeWindow(const State& state, Settling& settling) {
    const double motion = largestMotion(state, position_, orientation_);
    window_.motion = motion - last_motion_;
    const bool steady = window_.mean() > limit_ && last_window_.samples > 0 &&
                        window_.motion > kSteadyMotion * last_window_.motion;
    const bool flat = steady && window_.most - window_.least < kFlatForce * window_.mean() &&
                      window_.mean() > (1.0 - kFlatForce) * last_window_.mean();
    // The speed shows what the noise of the force hides: it falls where a spring acts, however slow the mode.
    const bool even = steady && last_window_.motion > 0 &&
                      std::abs(window_.motion - last_window_.motion) < kEven * last_window_.motion &&
                      window_.mean() > (1.0 - kLevel) * last_window_.mean();
    const bool level =
        steady && std::abs(window_.mean() - last_window_.mean()) < kLevel * last_window_.mean();
    level_windows_ = level ? level_windows_ + 1 : 0;
    last_window_ = window_;
    last_motion_ = motion;
    window_ = {};
    if (flat || even || level_windows_ == kLevelWindows) return fails(settling, last_window_);
    return ++windows_ % kWindowsInSpan == 0 && closeSpan(settling, motion);
}

bool Watch::closeSpan(Settling& settling, double motion) {
    span_.motion = motion - last_span_motion_;
    const bool plateau = last_span_.samples > 0 && span_.mean() > limit_ &&
                         span_.mean() > kPlateau * last_span_.mean() &&
                         span_.motion > kSteadyMotion * last_span_.motion;
    last_span_ = span_;
    last_span_motion_ = motion;
    span_ = {};
    return plateau && fails(settling, last_span_);
}

bool Watch::fails(Settling& settling, const Window& seen) {
    settling.verdict = Verdict::failing;
    settling.out_of_balance = seen.mean();
    settling.reason = describe("keeps moving: out-of-balance force stays at", seen.mean(), settling.steps);
    return true;
}

void DragTuner::tune(State& state, double ratio, double slow_period) {
    double stiffness = 0, inertia = 0;
    const Vec3 g = bodyAcceleration(state);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Vec3 u = state.blocks.position.get(b) - position_.get(b);
        stiffness -= u.dot(outOfBalance(state, b, g).force - force_[b]);
        inertia += u.squaredNorm() / state.blocks.inverse_mass[b];
    }
    // Motion without resistance is a failure, and keeps its drag to stay free of chatter.
    const double slowest = kSlowestMotion * slow_period;
    const double period = stiffness > 0 ? 2.0 * M_PI * std::sqrt(inertia / stiffness) : kInfinity;
    setDrag(state, ratio, period < slowest ? std::max(period, slow_period) : slow_period);
    remember(state);
}

void DragTuner::setDrag(State& state, double ratio, double period) {
    state.damping.mass = state.damping.rotation = 4.0 * M_PI * ratio / period;
}

void DragTuner::remember(const State& state) {
    position_ = state.blocks.position;
    force_.resize(state.blocks.size());
    const Vec3 g = bodyAcceleration(state);
    for (std::size_t b = 0; b < force_.size(); ++b) force_[b] = outOfBalance(state, b, g).force;
}

}  // namespace talus::history
