#pragma once
// Numbers that a quantity may be.

#include <cmath>
#include <limits>

namespace talus {

/// From `min` to `max`, without the ends that are open. Always finite numbers.
struct Interval {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool open_min = false;
    bool open_max = false;

    bool contains(double value) const {
        if (!std::isfinite(value)) return false;
        return (open_min ? value > min : value >= min) && (open_max ? value < max : value <= max);
    }

    static constexpr Interval positive() { return {.min = 0, .open_min = true}; }
    static constexpr Interval notNegative() { return {.min = 0}; }
};

}  // namespace talus
