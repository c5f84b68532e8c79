#pragma once
// Assemblies that can be solved in a plane: equal slices side by side along y, each its own mirror image.
//
// The sum of the forces of all slices is a force system in the plane. Forces between slices cancel, mirrored
// points act as one, and friction cones are convex, so none exceeds its strength. The other way round, forces
// in the plane shared out evenly balance every slice by itself. So the limit is that of the section, and
// there the cone is exact.

#include "limit_analysis/assembly.h"

namespace talus::limit {

/// The assembly's section, if it has one, all slices added up; else the assembly itself.
/// \param water the loads besides the weight, on each body
/// \param length_scale of a block [m]
Assembly foldToSection(Assembly assembly, const Loads& water, double length_scale);

}  // namespace talus::limit
