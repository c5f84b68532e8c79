#pragma once
// What is said beside a map of failure, in each of its pages.

#include <string>
#include <utility>
#include <vector>

#include "batch/failure_map.h"
#include "cli/common.h"

namespace talus::tools::batch {

/// Names and values, for a list.
using Facts = std::vector<std::pair<std::string, std::string>>;

std::string percent(double share);
std::string mapTitle(const BatchInfo& info);
/// How many samples fail, and how sure that is.
std::string leadText(const FailureMap& map, const BatchInfo& info);
/// That some samples are not counted; empty where all are.
std::string uncountedText(const FailureMap& map, const BatchInfo& info);
/// Face, expected volume, and volume without a face.
Facts mapFacts(const FailureMap& map);
/// What a cell counts.
std::string readingText(const BatchInfo& info);
Facts mapProvenance(const BatchInfo& info, const Common& common);

}  // namespace talus::tools::batch
