#pragma once
// Where a boundary begins or ends inside a polygon of the network: a drain in a joint, or a spring on a part
// of an open end. There the head falls over a length as small as the boundary, and the mesh must be as fine.
//
// About a corner of the boundary the head is that of a well, and its gradient grows without limit. A box that
// crosses the polygon from edge to edge ends at lines, towards which flow is even: there nodes on the lines are
// enough.
//
// Reads: network before it is refined, boundaries

#include <array>
#include <span>
#include <vector>

#include "flow/network.h"
#include "geometry/face_frame.h"
#include "talus/flow_data.h"

namespace talus::flow {

/// What a boundary takes of a patch's plane, or of the line of an open edge.
struct Footprint {
    std::int32_t patch = 0;
    FaceFrame plane{};            ///< of the patch, in the state's coordinates
    std::vector<Vec2> corners{};  ///< convex, counter-clockwise; two of them are a part of a line [m]
    Vec3 low, high;               ///< the boundary's box, in the state's coordinates [m]
    double size = 0;              ///< longest side of a triangle on its outline [m]
    double same = 0;              ///< distance at which points are the same [m]
};

/// \param origin  of the state's coordinates, in those of the model [m]
std::vector<Footprint> footprintsOf(const Network& network, std::span<const FlowBoundary> boundaries,
                                    const Vec3& origin);

/// How long a side of a triangle of the patch may be: `size` on the outline, more with the distance from it, and
/// any length where the boundary takes the whole triangle [m].
double mostSide(const Footprint& footprint, const std::array<Vec3, 3>& triangle);

}  // namespace talus::flow
