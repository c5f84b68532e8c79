#pragma once
// Warnings of an answer.

#include <string>
#include <vector>

#include "state/arrays.h"

namespace talus::search {

/// Beginning of the warning that an answer depends on cohesion lost at the first slip.
inline constexpr const char* kDependsOnCohesion = "the answer depends on cohesion that is lost";
/// Likewise, on tensile strength.
inline constexpr const char* kDependsOnTension = "the answer depends on tensile strength that is lost";

/// Likewise, on friction beyond the residual one.
inline constexpr const char* kDependsOnFriction = "the answer depends on peak friction that is lost";

/// \param built  the state before the search
/// \param last the final one: the failing state, if it `fails`
/// \param at_start  it fails before the search begins
std::vector<std::string> searchWarnings(const State& built, const State& last, bool fails, bool at_start);

/// Share of brittle joint area that has lost its cohesion, 0..1.
double lostCohesion(const State& state);

}  // namespace talus::search
