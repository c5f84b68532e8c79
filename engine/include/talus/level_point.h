#pragma once
// Tables over time: levels of water, loads, strengths.

namespace talus {

/// An entry of a table over time.
struct LevelPoint {
    double time = 0;   ///< [s]
    double value = 0;  ///< depth or elevation [m], or a factor of a load or a strength
    friend bool operator==(const LevelPoint&, const LevelPoint&) = default;
};

}  // namespace talus
