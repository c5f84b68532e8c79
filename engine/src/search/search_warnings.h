#pragma once
// Warnings of an answer.

#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::search {

/// What joints have lost in a failing state: cohesion, else tensile strength, else peak friction.
std::optional<LostStrength> lostStrength(const State& failing);

/// The warning that an answer depends on it.
/// \param kept  the answer with that strength kept, with its unit; "": unknown
std::string warningOf(const LostStrength& lost, const std::string& kept);

/// "cohesion", ...
const char* nameOf(LostStrength::Kind kind);

/// But for that of lost strength.
/// \param built  the state before the search
/// \param last the final one: the failing state, if it `fails`
/// \param at_start  it fails before the search begins
std::vector<std::string> searchWarnings(const State& built, const State& last, bool fails, bool at_start);

/// Share of brittle joint area that has lost its cohesion, 0..1.
double lostCohesion(const State& state);

}  // namespace talus::search
