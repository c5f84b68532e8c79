#pragma once
// The result of a limit analysis as JSON.

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"

namespace talus::tools {

Json limitJson(const VariedQuantity& load, const LimitResult& result, const Common& common,
               const formats::Scenario& scenario);

}  // namespace talus::tools
