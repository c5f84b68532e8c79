#pragma once
// Whether an answer depends on how its load was reached. Friction remembers: blocks that came to rest while strength was
// reduced step by step carry other shear forces than the same blocks laid there at that strength, and may fail elsewhere.

#include <algorithm>
#include <cstdint>

#include "analysis/load_axis.h"
#include "analysis/quasi_static.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// Searches beside the answer's own are made up to this share of the contact points up to which weight is brought on anew: they take as
/// long as the first, or ten times as long.
inline constexpr std::size_t kDearerThanRange = 15;

/// Each ends after so many times the work of the answer's own, or work that takes no time worth counting.
inline std::int64_t mostWorkBeside(const SearchResult& answer) {
    constexpr std::int64_t kMostTimes = 4, kLeastWork = 100'000;
    return std::max(kLeastWork, kMostTimes * workOf(answer.steps, answer.factors));
}

/// Looks, near an answer that was found, for the load up to which an equilibrium is found when weight and water are brought
/// on at that load, all at once, on joints that have not slid yet; where blocks topple on joints rougher than 45 degrees also for the
/// answer with no more than that. Fills `range` and `range_reason`.
/// \param built  the state before the search, as `buildState` gives it
void addHistoryRange(const State& built, const LoadAxis& axis, const Control& control,
                     const QuasiStatic& settings, bool parallel, SearchResult& result);

}  // namespace talus::analysis
