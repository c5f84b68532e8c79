#pragma once
// The tables that say how to compute: [analysis], [run], [damping], [gravity], [contact].

#include "table_reader.h"
#include "talus/model.h"

namespace talus::formats::scenario {

void readSettings(TableReader& root, Model& model);

}  // namespace talus::formats::scenario
