#pragma once
// Joints with cohesion that are open in part.

#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"

namespace talus::checks {

/// A contact point is open or closed as a whole, and so is its cohesion. The rule "distributed" counts the
/// closed part instead, in joints that neither dilate nor have tensile strength.
/// \param blocks  that count; empty: all
/// \return share of their joints' area that has cohesion counted so and is open in part, 0..1
double openCohesion(const State& state, const std::vector<std::size_t>& blocks);

/// The warning where that matters.
std::optional<std::string> ofOpenCohesion(const State& state, const std::vector<std::size_t>& blocks);

// Of the area of the joints: a smaller share is negligible.
inline constexpr double kLeastOpenCohesion = 0.01;

}  // namespace talus::checks
