#pragma once
// Heads on a refined mesh, from those on the meshes that it was refined from (nested iteration: Hackbusch 1985,
// Multi-Grid Methods and Applications, section 5). On the coarsest mesh the free surface moves far and cheaply.
// On each finer one it is less than a row of nodes away.

#include <vector>

#include "flow/solve.h"

namespace talus::flow {

/// \param aperture  hydraulic, at the corners of each triangle [m]
/// \param flow      with its fluid, and whether it has a free surface
/// \param unit_weight  of the water [N/m^3]
/// \return with the iterations on all meshes
Heads nestedHeads(const Network& network, const Conditions& conditions, const std::vector<Corners>& aperture,
                  const Flow& flow, double unit_weight, const Telling& telling);

/// The mesh before the last refinement.
Network coarser(const Network& network);

/// Transmissivity along the sides 0-1, 1-2, 2-0 of each triangle, by the cubic law [m^2/s].
std::vector<Corners> transmissivities(const std::vector<Corners>& aperture, const Flow& flow,
                                      double unit_weight);

}  // namespace talus::flow
