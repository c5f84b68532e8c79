#pragma once
// [ground_motion]: a record of accelerations or velocities in a CSV file.

#include "scenario/force_reader.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// Adds the record to the model; a run that says no duration_s lasts as long as it.
void readGroundMotion(const ForceReader& from, Model& model);

}  // namespace talus::formats::scenario
