#pragma once
// The tables that hold for the whole model: [analysis], [run], [contact], [gravity], and those of plain
// numbers (fields.h).

#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

void readSettings(TableReader& root, Model& model);

/// Where a search ends if the file does not say: 45 deg, or half way up from a scenario steeper than that.
double defaultStopDeg(double start_deg);

}  // namespace talus::formats::scenario
