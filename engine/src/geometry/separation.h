#pragma once
// How far apart two convex polyhedra are, or how deep they overlap.

#include <limits>

#include "geometry/world_shape.h"
#include "talus/polyhedron.h"

namespace talus {

struct Separation {
    double distance = 0;       ///< negative: depth of the overlap [m]
    Vec3 axis = Vec3::Zero();  ///< unit vector from a towards b along which it is measured
};

/// The largest separation over the candidates of the separating-axis theorem: face normals of both, and cross
/// products of an edge of each. Negative exactly when the two overlap, and then the least move that parts
/// them. When positive it is a lower bound of their distance (equal to it unless the nearest points are a
/// vertex and an edge or a vertex). The search ends at the first axis that separates by `enough` [m]: with
/// minus the overlap allowed, touching blocks are passed after a few axes.
Separation findSeparation(const WorldShape& a, const WorldShape& b,
                          double enough = std::numeric_limits<double>::infinity());
Separation findSeparation(const Polyhedron& a, const Polyhedron& b,
                          double enough = std::numeric_limits<double>::infinity());

inline double separation(const Polyhedron& a, const Polyhedron& b) { return findSeparation(a, b).distance; }

}  // namespace talus
