#pragma once
// The tables that say how to compute: [analysis], [run], [damping], [gravity], [contact].

#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

void readSettings(TableReader& root, Model& model);

}  // namespace talus::formats::scenario
