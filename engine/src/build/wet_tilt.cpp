#include "build/wet_tilt.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "build/build.h"
#include "build/wet_joints.h"
#include "measure/words.h"
#include "talus/angles.h"

namespace talus {
namespace {

// Of an interface's area: by so much wet shares of two tilts may differ. Strength then differs by less than
// the tolerance of a factor of safety.
constexpr double kSameShare = 1e-3;
constexpr double kSameTilt = 1e-6;  // [rad], between stable and failing: farther halving changes no answer
constexpr int kMostRounds = 20;     // searches; most need two to four
constexpr int kLooks = 32;          // tilts up to an answer at which wet shares are computed

double startOf(const Model& model) { return model.analysis.start.value_or(model.gravity.tilt); }

double largestChange(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

std::vector<double> sharesAt(State& built, double tilt) {
    const double own = std::exchange(built.load.tilt, tilt);
    std::vector<double> shares = wetShares(built);
    built.load.tilt = own;
    return shares;
}

std::string degreesText(double tilt) { return formatted("%.4g", degrees(tilt)) + " deg"; }

}  // namespace

Result<WetTilt> WetTilt::begin(const Model& model, bool parallel, const Control& control) {
    if (auto refused = refusedWetJoints(model)) return *refused;
    std::shared_ptr<const Model> given = keptByCaller(model);
    Result<State> built = buildState(given, parallel, control);
    if (!built) return built.errors();
    return WetTilt(std::move(given), std::move(*built));
}

WetTilt::WetTilt(std::shared_ptr<const Model> given, State built)
    : given_(std::move(given)), built_(std::move(built)), stands_(-kInfinity), fails_(kInfinity) {
    tiltTo(startOf(*given_));
}

void WetTilt::tiltTo(double tilt) {
    built_.load.tilt = tilt;
    shares_ = wetShares(built_);
    Model wet = withWetJoints(*given_, built_, shares_);
    for (Joint& joint : wet.joints) joint.wet_strength_factor = 1;
    wet_ = std::make_shared<const Model>(std::move(wet));
}

bool WetTilt::goesOn(double found) {
    const double start = startOf(*given_);
    const double answer = std::clamp(found, start, std::max(start, given_->analysis.stop));
    if (answer > tilt() && rounds_ < kMostRounds) {
        if (const auto between = wetterBefore(answer)) {
            ++rounds_;
            stands_ = tilt();
            tiltTo(*between);
            return true;
        }
    }
    const double change = largestChange(shares_, sharesAt(built_, answer));
    if (answer == tilt() || change <= kSameShare) return false;
    (answer > tilt() ? stands_ : fails_) = tilt();
    if (++rounds_ >= kMostRounds || fails_ - stands_ <= kSameTilt) {
        doubtAt(answer, change);
        return false;
    }
    tiltTo(answer > stands_ && answer < fails_ ? answer : 0.5 * (stands_ + fails_));
    return true;
}

std::optional<double> WetTilt::wetterBefore(double answer) {
    const std::vector<double> then = sharesAt(built_, answer);
    const auto sum = [](const std::vector<double>& shares) {
        return std::accumulate(shares.begin(), shares.end(), 0.0);
    };
    const double sum_at_ends = std::max(sum(shares_), sum(then));
    double most = kSameShare;
    std::optional<double> wettest;
    for (int k = 1; k < kLooks; ++k) {
        const double between = tilt() + (answer - tilt()) * k / kLooks;
        const std::vector<double> now = sharesAt(built_, between);
        double excess = sum(now) - sum_at_ends;  // different joints may be wet at the two ends
        for (std::size_t i = 0; i < now.size(); ++i)
            excess = std::max(excess, now[i] - std::max(shares_[i], then[i]));
        if (excess > most) most = excess, wettest = between;
    }
    return wettest;
}

void WetTilt::doubtAt(double answer, double change) {
    doubt_ = "what is wet changes abruptly at " + degreesText(0.5 * (stands_ + fails_)) +
             ": the slope is stable below and fails above. With the areas that are wet at " +
             degreesText(tilt()) + " it would fail at " + degreesText(answer) +
             ", where the wet share of a joint differs by up to " + formatted("%.3g", 100 * change) +
             " % of its area";
}

}  // namespace talus
