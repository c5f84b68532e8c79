#pragma once
// Joints that are weaker where water presses in them (Joint::wet_strength_factor w).
//
// Of an interface whose area is wet by a share s as built, all strengths are those of its joint times
// 1 - s (1 - w): wet and dry parts count by their areas, as joint and intact rock do (J. E. Jennings, 1970).
// Between faces of two joints the one counts that has less friction so weakened.
// Such interfaces get joints of their own, so that all analyses see joints alone. An area is wet where the
// pressure of a water, of the water table or of a flow is more than nothing in the model as built, at time 0.
// A search for a tilt takes what is wet at the tilt that it finds (wet_tilt.h); all others take the model's.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

/// Whether water may weaken a joint of the model.
bool hasWetJoints(const Model& model);

/// The scenario's key of the first joint that water weakens. \pre hasWetJoints(model)
std::string wetStrengthKey(const Model& model);

/// The refusal of a model whose wet areas are not found: joints that water weakens, and coupled
/// flow.
std::optional<Error> refusedWetJoints(const Model& model);

/// Share of each interface of two faces that is wet, 0..1, to rounding; 0 for others, and where none of the
/// joints that may count there is weaker when wet.
/// Reads: interfaces, walls of water, pieces of the water table, load.tilt; all else of the state as built
std::vector<double> wetShares(const State& built);

/// The model with joints of their own for wet interfaces, behind its own. Applied again it changes nothing.
/// \param shares  of its interfaces (wetShares); they count to a thousandth
Model withWetJoints(const Model& model, const State& built, const std::vector<double>& shares);

/// buildState, with these joints. Puts the model that has them into `model`. Errors: as of that, and of
/// refusedWetJoints.
Result<State> buildWithWetJoints(std::shared_ptr<const Model>& model, bool parallel,
                                 const Control& control = {});
/// For a model that the caller keeps.
Result<State> buildWithWetJoints(const Model& model, bool parallel, const Control& control = {});

}  // namespace talus
