#pragma once
// The allowed range of a quantity.

#include <cmath>
#include <limits>
#include <string_view>

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

    /// Every positive number up to `max`.
    static constexpr Interval positive(double max) { return {.min = 0, .max = max, .open_min = true}; }
    static constexpr Interval positive() { return {.min = 0, .open_min = true}; }
    static constexpr Interval notNegative() { return {.min = 0}; }
};

/// Range of values that suggest another unit: rare in the quantity's own unit, common in that one.
struct UnitMixUp {
    double above = 0, below = 0;
    std::string_view unit{};  ///< "g/cm3"

    constexpr bool looksLike(double value) const { return value > above && value < below; }
};

}  // namespace talus
