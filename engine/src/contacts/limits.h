#pragma once
// Lengths and angles that decide how two blocks touch.

#include "contacts/vertex_edge_points.h"
#include "state/arrays.h"
#include "state/closed_gap.h"  // kClosedGap

namespace talus {

// Displacement that a search allows for; beyond it a block's neighbours are searched again.
inline constexpr double kTravelLimit = 0.01;  // of a block's own size
inline constexpr double kTurnLimit = 0.01;    // [rad]
inline constexpr double kFasterAhead = 4.0;   // times: largest growth of a block's speed before the next look
inline constexpr double kShareOfMargin =
    0.25;  // of the margin, likewise: two blocks may come towards each other

/// Faces meet as faces up to this angle from parallel [rad], which grows with their overlap (per share of the
/// smaller block's size). Beyond that only the patch's lowest edge or vertex carries (the next contact points
/// lie a sixth of the patch away). So the change between a contact of faces and one of a vertex or edge has
/// no jump.
inline constexpr double kFaceAngle = 0.05;
inline constexpr double kFaceAnglePerDepth = 10.0;

/// A patch with less area than one contact point at a vertex is too soft to carry for long. Pressed deeper
/// than this (share of the smaller block's size), it is replaced by vertices and edges.
inline constexpr double kSliverDepth = 1e-4;

/// In quasi-static work a patch of less than this share of the smaller face, and of less than a vertex's
/// area, makes no interface once the model has moved. A slope that has slid by microns has more such strips
/// than joints. They are narrower than the failure displacement, and carry a thousandth of their neighbours'
/// force at equal depth. A strip that is bonded or carries a hundredth of its block's forces stays, since it
/// may be the block's only support.
inline constexpr double kLeastShare = 4e-4;

/// Limits of vertex and edge contacts of two blocks that may move this far before the next look [m].
VertexEdgeLimits vertexEdgeLimits(const Geometry& geometry, std::size_t block_1, std::size_t block_2,
                                  double reach);

/// Area of a contact point at a vertex or a crossing of edges [m^2]: that of a contact point at the corner of
/// a four-cornered face with the two blocks' lesser mean face area (A/24 with `vertex` points, A/4 with
/// `corner` and `quarter`, A/N^2 with `grid N`).
double vertexEdgeArea(const Geometry& geometry, std::size_t block_1, std::size_t block_2);

}  // namespace talus
