#pragma once
// The load that a search goes up: a tilt, a factor on strength, a horizontal push.

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

#include "state/arrays.h"

namespace talus::analysis {

/// The load that is searched over. Probes stand on a grid of cells no wider than the tolerance, so that the bracket
/// found is one of these cells whatever way led to it.
struct LoadAxis {
    double unit = 1;  ///< of the answer's loads: those of the search times this
    double start = 0;
    bool strongest_at_start = false;  ///< strength is divided by `strongestFactor` there
    std::int64_t stop = 0;            ///< [cells from the start]
    double cell = 0;                  ///< width of the bracket
    double overload =
        8;  ///< how far beyond the failing load a failure is let go, so that it gathers speed in time [cells]
    double imbalance_tolerance = 0;  ///< out-of-balance force over weight that a change by one cell is worth
    std::function<std::int64_t(std::int64_t)> next;  ///< from a stable load to the next one up [cells]
    std::function<std::int64_t(std::int64_t)>
        farthest{};  ///< load to which the implicit solve goes at once from a stable one [cells]
    std::function<void(State&, double)> apply;
    std::function<std::string(double)> say;  ///< for progress

    double load(std::int64_t cells) const { return start + cell * static_cast<double>(cells); }
};

/// Of a critical angle: the tilt [rad], from the analysis' start to its stop.
LoadAxis tiltAxis(const Model& model);
/// Of a factor of safety: what strength is divided by, from the strongest on. The model must outlive it.
LoadAxis strengthAxis(const Model& model);
/// Of a critical acceleration: the horizontal seismic coefficient.
LoadAxis accelerationAxis(const Model& model);

/// A number in words, by printf's format.
inline std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

}  // namespace talus::analysis
