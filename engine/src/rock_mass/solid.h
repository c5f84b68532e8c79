#pragma once
// A solid: one block of the rock mass. It is one convex cell, or several where the region is not convex.

#include <vector>

#include "rock_mass/cell.h"
#include "rock_mass/joints.h"

namespace talus::rock_mass {

struct Solid {
    std::vector<Cell> pieces;
    Vec3 min = Vec3::Zero(), max = Vec3::Zero();  ///< bounds [m]
};

/// Data of a cut; refers to the caller's tables.
struct Knife {
    std::vector<Plane>& planes;
    VertexTable& vertices;
    double min_thickness = 0;  ///< of what a cut may leave [m]
};

struct CutOutcome {
    enum class Kind : std::uint8_t {
        missed,  ///< the plane, or the finite joint in it, does not meet the solid
        cut,
        sliver  ///< left out, because a part would be too thin
    };
    Kind kind = Kind::missed;
    std::vector<Solid> parts{};
    Vec3 place = Vec3::Zero();  ///< of the first sliver [m]
    double thinnest = 0;        ///< that sliver's thickness [m]
};

/// Cells that share a face form one solid; pieces whose union is convex become one.
std::vector<Solid> joined(std::vector<Cell> cells, const Knife& knife);

/// Cuts all pieces of a solid by `knife.planes[plane]`, as far as `reach` covers any of them.
CutOutcome cutSolid(const Solid& solid, std::int32_t plane, const Reach* reach, const Knife& knife);

/// Its pieces as the convex parts of one shape.
Result<Polyhedron> shapeOf(const Solid& solid, const VertexTable& vertices);

}  // namespace talus::rock_mass
