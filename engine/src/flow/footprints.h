#pragma once
// Where a boundary begins or ends inside a polygon of the network: a drain in a joint, or a spring on a part
// of an open end. Nodes of the mesh come to lie on that outline. About a corner of it the head is that of a
// well: it falls over a length as small as the boundary, and the mesh must be as fine. Where the outline
// crosses the polygon from edge to edge, flow towards it is even, and the nodes are enough.
//
// Reads: network before it is refined, boundaries

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "flow/network.h"
#include "geometry/face_frame.h"
#include "talus/flow_data.h"

namespace talus::flow {

/// The part of a patch that a boundary takes, or of one of its edges.
struct Footprint {
    std::int32_t patch = 0;
    FaceFrame plane{};            ///< of the patch, in the state's coordinates
    std::vector<Vec2> corners{};  ///< convex, counter-clockwise; two of a part of an edge [m]
    double size = 0;              ///< longest side of a triangle on its outline [m]; infinity: any
    double same = 0;              ///< distance at which points are the same [m]
    Vec3 centre = Vec3::Zero();   ///< of a ball about it, in the state's coordinates [m]
    double reach = 0;             ///< radius of that [m]

    bool isOnEdge() const { return corners.size() == 2; }
};

/// \param origin  of the state's coordinates, in those of the model [m]
std::vector<Footprint> footprintsOf(const Network& network, std::span<const FlowBoundary> boundaries,
                                    const Vec3& origin);

/// Whether a triangle of the patch has a side that is too long so near to the footprint. On the outline sides
/// are at most `size` long, and more with the distance from it. A triangle that the boundary takes as a whole
/// has any size.
bool isTooLarge(const Footprint& footprint, const std::array<Vec3, 3>& triangle);

/// Where a side of a triangle of the patch crosses the outline, away from its ends; one of several places.
std::optional<Vec3> crossing(const Footprint& footprint, const Vec3& begin, const Vec3& end);

/// Whether a side of a triangle of the patch lies on the outline.
bool isOnOutline(const Footprint& footprint, const Vec3& begin, const Vec3& end);

}  // namespace talus::flow
