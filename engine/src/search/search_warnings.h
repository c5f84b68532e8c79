#pragma once
// What users should know of an answer beside the figure.

#include <string>
#include <vector>

#include "state/arrays.h"

namespace talus::search {

/// How the warning begins of an answer that depends on cohesion lost at the first slip.
inline constexpr const char* kDependsOnCohesion = "the answer depends on cohesion that is lost";
/// Likewise, on tensile strength.
inline constexpr const char* kDependsOnTension = "the answer depends on tensile strength that is lost";

/// Likewise, on friction beyond the residual one.
inline constexpr const char* kDependsOnFriction = "the answer depends on peak friction that is lost";

/// \param built  the state before the search
/// \param last   the one it ended in: where the assembly has left its place, if it `fails`
/// \param at_start  it fails before the search begins
std::vector<std::string> searchWarnings(const State& built, const State& last, bool fails, bool at_start);

/// Share of the area of joints whose cohesion goes at the first slip that has lost it, 0..1.
double lostCohesion(const State& state);

}  // namespace talus::search
