#pragma once
// The blocks and groups of block theory as text and JSON.

#include <string>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "talus/block_theory.h"
#include "talus/formats/scenario.h"

namespace talus::tools {

Json keyBlocksJson(const KeyBlockResult& result, const Common& common, const formats::Scenario& scenario);

/// Counts, the groups with the least factors, what is not covered. \param rows  groups to show
std::string keyBlocksText(const KeyBlockResult& result, const std::string& scenario, std::size_t rows);

/// Degrees: "268.1/28.0", clockwise from +y and below the horizontal.
std::string trendPlungeText(const Vec3& direction);

}  // namespace talus::tools
