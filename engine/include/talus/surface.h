#pragma once
// Surfaces of triangles: what is wrong with one, the ones made from boxes, profiles and terrains, repair and
// simplification.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "talus/polyhedron.h"
#include "talus/result.h"

namespace talus {

/// A surface of triangles, counter-clockwise seen from outside. Vertices are shared: two triangles meet in an
/// edge when they use the same two indices.
struct TriangleSurface {
    std::vector<Vec3> vertices;  ///< [m]
    std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Faults that keep a surface from bounding a region. It is empty, crosses itself or faces inwards; an index
/// or a coordinate is out of range; a triangle has no area. An edge has one triangle (open) or more than two
/// (non-manifold); neighbours face opposite ways. Fields are "triangles[i]" (0-based) or "" for the whole;
/// messages have the coordinates of the place. At most 20 faults are listed.
std::vector<Error> checkSurface(const TriangleSurface& surface);

/// The volume a closed surface encloses; negative when it faces inwards [m^3].
double surfaceVolume(const TriangleSurface& surface);

/// The longest side of the box around it [m]; 0 without vertices.
double surfaceExtent(const TriangleSurface& surface);

/// The surface of a box; as makeBox.
Result<TriangleSurface> boxSurface(const Vec3& min, const Vec3& max);

/// A slope profile, a simple polygon of (x, z) in either sense of rotation, extruded from y_min to y_max [m].
/// Errors: fewer than three points, sides that cross or touch ("[i]" is the side behind point i), y_min >=
/// y_max.
Result<TriangleSurface> extrudeProfile(const std::vector<Eigen::Vector2d>& profile, double y_min,
                                       double y_max);

/// An open surface, made closed.
struct ClosedTerrain {
    TriangleSurface surface;  ///< the terrain's triangles first, in their order, then sides and base
    bool turned = false;      ///< all triangles looked down
};

/// Closes a terrain by vertical sides below its rim and a level base at z = `base` [m]. All triangles may
/// look up or all down. Errors: those of checkSurface but for the rim; holes, separate pieces, pieces that
/// meet in a point only, a rim that crosses itself in plan; a base that is not below the terrain ("base"); a
/// terrain that is closed already.
Result<ClosedTerrain> closeTerrain(TriangleSurface terrain, double base);

/// What repairSurface made, and did.
struct SurfaceRepair {
    TriangleSurface surface;
    std::vector<std::size_t> source;  ///< per triangle: the one it was, or is a piece of
    std::size_t merged = 0;           ///< vertices that were another one's duplicates
    std::size_t dropped = 0;          ///< triangles without a width
    std::size_t split = 0;            ///< T-junctions: vertices on the edge of another triangle
    Vec3 place = Vec3::Zero();        ///< the first of all these [m]

    bool changed() const { return merged + dropped + split > 0; }
};

/// Merges vertices within `tolerance` of an earlier one, and leaves out triangles no wider than it. Divides
/// triangles along open edges at open corners of others that lie that near. Nothing else moves. A tolerance
/// of 0 merges only equal vertices. \pre finite vertices, indices in range
SurfaceRepair repairSurface(const TriangleSurface& surface, double tolerance);

/// A coarser surface: as many vertices as possible are removed, and none moves. Every point of either surface
/// is within `deviation` [m] of the other one (Hausdorff distance). The rim of an open surface keeps its
/// outline in plan, and what is a graph over (x, y) stays one. \pre what checkSurface or closeTerrain take
TriangleSurface simplifySurface(const TriangleSurface& surface, double deviation);

}  // namespace talus
