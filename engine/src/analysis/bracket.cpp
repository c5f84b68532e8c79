#include "analysis/bracket.h"

#include <algorithm>
#include <cmath>

namespace talus::analysis {

void Bracket::fails(std::int64_t cell, double out_of_balance) {
    high_ = cell;
    failures_.push_back({cell, out_of_balance});
}

void Bracket::reopen() {
    low_ = *high_;
    goOn();
}

void Bracket::goOn(std::int64_t step) {
    high_.reset();
    failures_.clear();
    width_two_probes_ago_ = width_last_probe_ = 0;
    gallop_ = step;
}

std::int64_t Bracket::up(std::int64_t next) {
    if (gallop_ > 0) {
        next = std::min(next, low_ + gallop_);
        gallop_ = std::min(2 * gallop_, stop_);
    }
    return std::min(next, stop_);
}

/// Zero of the line through the last two failing probes [cells].
std::optional<double> Bracket::extrapolated() const {
    if (failures_.size() < 2) return {};
    const Failure& near = failures_.back();
    const Failure& far = failures_[failures_.size() - 2];
    const double slope =
        (far.out_of_balance - near.out_of_balance) / static_cast<double>(far.cell - near.cell);
    if (!(slope > 0)) return {};
    return static_cast<double>(near.cell) - near.out_of_balance / slope;
}

std::int64_t Bracket::next() {
    const std::int64_t width = *high_ - low_;
    const bool halved = width_two_probes_ago_ == 0 || 2 * width <= width_two_probes_ago_;
    width_two_probes_ago_ = width_last_probe_;
    width_last_probe_ = width;
    const std::optional<double> zero = extrapolated();
    if (!zero || !halved || *zero <= static_cast<double>(low_) - 1 || *zero >= static_cast<double>(*high_))
        return midpoint();
    const auto below = static_cast<std::int64_t>(std::floor(*zero));
    const std::int64_t candidate = below + 1 < *high_ ? below + 1 : below;
    return std::clamp(candidate, low_ + 1, *high_ - 1);
}

}  // namespace talus::analysis
