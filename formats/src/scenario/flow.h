#pragma once
// [flow]: steady flow in the joint network.

#include <vector>

#include "scenario/force_reader.h"
#include "scenario/properties.h"
#include "scenario/slope_turn.h"
#include "talus/model.h"

namespace talus::formats::scenario {

void readFlow(const ForceReader& from, Model& model);

/// Faces of boundaries are those of the profile, as in `rock_mass.fixed`: they turn with it.
void turnFaces(const SlopeTurn& turn, Model& model);

/// What is said of a joint of the file holds for the joints derived from it, too. Derived joints of an
/// earlier call are forgotten.
void addDerivedJoints(const std::vector<JointOrigin>& origins, Model& model);

}  // namespace talus::formats::scenario
