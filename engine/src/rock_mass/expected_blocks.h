#pragma once
// Estimate of the number of blocks, before anything is cut.

#include <vector>

#include "rock_mass/joints.h"

namespace talus::rock_mass {

/// Planes in general position cut a convex body into 1 + (planes that meet it) + (pairs whose line does) +
/// (triples whose point does) cells. Pairs and triples follow from the areas of the planes per volume, by
/// stereology (E. E. Underwood, 1970): planes of areas A_i per volume have |n_i x n_j| A_i A_j of line and
/// |n_i . n_j x n_k| A_i A_j A_k points per volume; a line crosses the region over volume / projected area.
/// The region's bounding box stands for its outline. Finite joints come after them, one by one: each cuts as
/// many blocks as it meets among those there are by then.
/// \param enough  where counting may stop
double expectedBlocks(const std::vector<JointPlane>& joints, const Vec3& min, const Vec3& max, double volume,
                      double enough);

}  // namespace talus::rock_mass
