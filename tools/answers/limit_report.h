#pragma once
// The result of a limit analysis as JSON.

#include <string>
#include <string_view>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"

namespace talus::tools {

/// What may grow, by its name on the command line ("tilt"); nullptr when there is none of this name.
const VariedQuantity* variedNamed(std::string_view name);

Json limitJson(const VariedQuantity& load, const LimitResult& result, const Common& common,
               const std::string& scenario_path);

}  // namespace talus::tools
