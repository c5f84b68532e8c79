#pragma once
// Polygons of joints, cut along the outlines of the boundaries on them. A boundary then begins and ends where
// its box does, and not at the next node of a mesh.
//
// All coordinates are the state's.

#include <cstdint>
#include <span>
#include <vector>

#include "talus/flow_data.h"

namespace talus::flow {

using Ring = std::vector<Vec3>;  ///< corners of a plane convex polygon, in order [m]

/// Corner of a boundary's outline in the inside of a joint. The gradient of the head has no bound there.
struct OutlineCorner {
    Vec3 place = Vec3::Zero();
    double side = 0;  ///< of the outline, the shorter one that ends here [m]
};

/// Whether a boundary takes joints of this number.
bool isOfJoint(const FlowBoundary& boundary, std::int32_t joint);

/// Convex pieces that cover the polygon; the polygon itself where no box ends inside it.
/// \param same  distance at which points are the same [m]
std::vector<Ring> piecesOf(const Ring& polygon, std::int32_t joint, std::span<const FlowBoundary> boundaries,
                           const Vec3& origin, double same);

/// Of boundaries that cover parts of the polygon; those at ends of joints (`face`) have none.
std::vector<OutlineCorner> cornersInside(const Ring& polygon, std::int32_t joint,
                                         std::span<const FlowBoundary> boundaries, const Vec3& origin,
                                         double same);

/// Of its area. \pre area > 0
Vec3 centroidOf(const Ring& polygon);

}  // namespace talus::flow
