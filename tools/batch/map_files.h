#pragma once
// A map of failure as a file: a page, or polygons for other programs.

#include <string>
#include <vector>

#include "batch/failure_map.h"
#include "cli/common.h"
#include "cli/json_fwd.h"

namespace talus::tools::batch {

/// Throws BadInput where a map cannot have this name, FileRefused where it cannot be written.
void refuseMapFile(const std::string& path, const Face& face);

/// The same of a page with the map on the slope.
void refuseSlopePage(const std::string& path, const Face& face);

/// By the ending of its name: .html, .vtp or .ply.
std::string mapFile(const std::string& path, const FailureMap& map, const BatchInfo& info,
                    const Common& common);

Json toJson(const FailureMap& map, const std::vector<std::string>& files);

}  // namespace talus::tools::batch
