#pragma once
// Joints that are weaker where water presses in them (Joint::wet_strength_factor w).
//
// Of an interface whose area is wet by a share s as built, all strengths are those of its joint times
// 1 - s (1 - w): wet and dry parts count by their areas, as joint and intact rock do (J. E. Jennings, 1970).
// Between faces of two joints the one counts that has less friction so weakened.
// Such interfaces get joints of their own, so that searches, limit analysis and block theory see joints
// alone. An area is wet where the pressure of a water, or of the water table, is more than nothing at the
// model's tilt and at time 0. Analyses that move the water are refused.

#include <memory>

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

/// Whether water may weaken a joint of the model.
bool hasWetJoints(const Model& model);

/// The refusal of such a model. \param by  what does not count it: "a time history"; empty where nothing is
/// refused
std::optional<Error> refusedWetJoints(const Model& model, const char* by);

/// Share of each interface of two faces that is wet, 0..1, to rounding; 0 for others, and where none of the
/// joints that may count there is weaker when wet.
/// Reads: interfaces, walls of water, pieces of the water table; all of the state as built
std::vector<double> wetShares(const State& built);

/// The model with joints of their own for wet interfaces, to a thousandth of the share. Applied again it
/// changes nothing.
Model withWetJoints(const Model& model, const State& built);

/// buildState, with these joints. Puts the model that has them into `model`. Errors: as of that, and flow in
/// joints that water weakens.
Result<State> buildWithWetJoints(std::shared_ptr<const Model>& model, bool parallel,
                                 const Control& control = {});

}  // namespace talus
