#pragma once
// One search over a load that only grows, each probe from the last stable state.

#include <cstdint>
#include <vector>

#include "analysis/load_axis.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// What searches have cost.
struct Effort {
    std::int64_t steps = 0;
    std::int64_t factors = 0;  ///< factorisations of the implicit solve
    TimeSpent time{};

    Effort& operator+=(const Effort& other) {
        steps += other.steps;
        factors += other.factors;
        time += other.time;
        return *this;
    }
};
inline Effort effortOf(const SearchResult& result) { return {result.steps, result.factors, result.time}; }
inline void setEffort(const Effort& effort, SearchResult& result) {
    result.steps = effort.steps;
    result.factors = effort.factors;
    result.time = effort.time;
}
/// Adds what came before it to what a search has cost.
inline void addEffort(Effort before, SearchResult& result) { setEffort(before += effortOf(result), result); }

struct Outcome {
    SearchResult result;
    std::vector<std::size_t> falling;  ///< blocks of the state that were seen to fall
    /// splinters that alone have kept it from rest at the start, though they were not seen to fall; empty: there are others, or
    /// it came to rest
    std::vector<std::size_t> restless{};
};

/// Weight and water at the start, then up until it fails or the end is reached, then down to the bracket, and the failure
/// let go. A failure that this does not bear out is left so (`confirmed`).
Outcome searchLoad(const State& state, const LoadAxis& axis, const Control& control,
                   const QuasiStatic& settings, bool parallel);

/// What falls under weight and water at the start.
struct Start {
    std::vector<std::size_t> falling;
    Effort effort{};
};
Start loadStart(const State& state, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
                bool parallel);

}  // namespace talus::analysis
