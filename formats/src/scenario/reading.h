#pragma once
// What every table of a scenario is read with, from the floor below.

#include "toml/report.h"
#include "toml/table_reader.h"
#include "toml/wording.h"

namespace talus::formats::scenario {

using namespace toml;

}  // namespace talus::formats::scenario
