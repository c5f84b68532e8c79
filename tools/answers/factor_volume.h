#pragma once
// The curve of factor and volume: the least factor of safety of a failure of at least some volume, by block
// theory. It serves the design of benches and fences.

#include <string>

#include "cli/json_fwd.h"
#include "report/figures.h"
#include "talus/block_theory.h"

namespace talus::tools {

/// All points: {volume_m3, mass_kg, safety_factor, mode, joints, direction, blocks}.
Json factorVolumeJson(const KeyBlockResult& result);

/// The same, a row a point. \param comments  whole lines above the header
std::string factorVolumeCsv(const KeyBlockResult& result, const std::string& comments);

/// \pre the curve has a point
/// \param scenario  in the title
Plot factorVolumePlot(const KeyBlockResult& result, const std::string& scenario);

/// Points for a table: all of a short curve, else about one for each doubling of the volume, and the two
/// ends.
std::vector<const MovingGroup*> shownPoints(const KeyBlockResult& result);

std::string modeText(const Sliding& sliding);  ///< "wedge on bedding and J1"

}  // namespace talus::tools
