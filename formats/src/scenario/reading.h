#pragma once
// Shared readers for all tables of a scenario, from the folder below.

#include "toml/report.h"
#include "toml/table_reader.h"
#include "toml/wording.h"

namespace talus::formats::scenario {

using namespace toml;

}  // namespace talus::formats::scenario
