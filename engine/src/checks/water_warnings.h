#pragma once
// Warnings of water that moves blocks.

#include <optional>
#include <string>
#include <vector>

#include "forces/coupled_flow.h"
#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// Waters, and a water table, that press on no free block, by their scenario key. A depth or heads of 0 are
/// meant to be dry and are left out. Also parts of the joint network that no head of a flow reaches. \pre the
/// state is as `buildState` gives it
std::vector<Error> dryWaters(const State& state);

/// Joints whose strength when wet (Joint::wet_strength_factor) has no effect, because no area of them is wet.
/// Not where the model has no water, or levels of 0 alone. \param model  with its wet joints
std::vector<Error> wetStrengthOfDryJoints(const Model& model);

/// A horizontal table in a steep slope presses in full where its joints daylight, and pushes blocks off at
/// any strength.
/// \param built    the model as it was built, before it is loaded
/// \param falling  blocks that fall whatever the strength
std::optional<std::string> pushedByWater(const State& built, const std::vector<std::size_t>& falling);

/// Water that never drains from opening joints keeps pushing, and ejects blocks. \param state at the end of a
/// run
std::optional<std::string> pushedAway(const State& state);

/// Of coupled flow: equilibria at which it did not converge, or was not found; and at the last one a mesh too
/// coarse for the joints' taper, and apertures that are capped.
/// \param last  the last equilibrium, with its pressure
std::vector<std::string> ofCoupling(const flow_water::CoupledFlow& coupled, const State& last);

/// How many more refinements to try next, for that taper at an equilibrium. None where the mesh would be too large.
int moreRefinements(const flow_water::CoupledFlow& coupled, const State& last);

/// For a search that varies the tilt, where the flow does not follow it.
std::optional<std::string> flowOfOtherTilt(const Model& model);

/// For an analysis that finds no equilibrium, where flow is coupled.
inline constexpr const char* kNothingOpens = "joints do not open here";
std::optional<std::string> flowAsStated(const Model& model, const std::string& why);

}  // namespace talus::checks
