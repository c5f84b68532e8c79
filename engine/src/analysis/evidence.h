#pragma once
// What a failing motion that is let go has to show, and what may be spent on it, from what the probes have seen.

#include <cstdint>
#include <functional>

#include "analysis/failure_mode.h"
#include "analysis/probing.h"

namespace talus::analysis {

/// What else is known of a failing load.
struct Doubts {
    bool at_start = false;  ///< there is no load at which it has stood
    bool no_rest = false;   ///< the implicit solve has found none, nearby or elsewhere
    bool alone = false;     ///< nothing but the motion says that it fails
};

/// Of a failure: at the start, a block that has gone a share of its size; else less of that, but several times what the assembly has
/// moved at rest. What it has crept from rest to rest is not asked for again where no rest is found by either way.
Evidence evidenceOfFailure(const Probing& probing, const Doubts& doubts);

/// Factorisations after which the implicit solve gives no answer to that doubt.
inline constexpr std::int64_t kFactorsOfDoubt = 200;
/// The same, but that it is doubted when it is not seen for long. \param rests  whether the implicit solve finds rest
Evidence doubted(Evidence wanted, std::function<bool()> rests);

/// Of what falls at the start, before it was watched patiently.
Evidence evidenceOfFall();

}  // namespace talus::analysis
