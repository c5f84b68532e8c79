#pragma once
// Steady flow in the joints as text, JSON, table and picture.

#include <optional>
#include <string>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "talus/flow.h"
#include "talus/formats/scenario.h"

namespace talus::tools {

/// \param change  by the mesh; nothing where it was not found
std::string flowText(const SteadyFlow& flow, const std::optional<MeshChange>& change,
                     const std::string& scenario);

/// How well flow and opening of the joints agree; null where they are not coupled.
Json couplingJson(const std::optional<FlowCoupling>& coupling);
std::string couplingText(const FlowCoupling& coupling);

/// Sums, boundaries, the free surface, and of each joint's polygon the largest pressure.
Json flowJson(const SteadyFlow& flow, const std::optional<MeshChange>& change, const Common& common,
              const formats::Scenario& scenario);

/// A row a triangle of the mesh: its centroid, blocks and joint, head, pressure, discharge.
/// \param comments  whole lines above the header
std::string flowCsv(const SteadyFlow& flow, const Model& model, const std::string& comments);

}  // namespace talus::tools
