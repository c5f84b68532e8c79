#pragma once
// Convex cells of a rock mass during cutting: faces with their planes, over one table of welded vertices.
//
// The side of a vertex on a plane depends on its coordinates and the plane alone, and a cut edge gives the
// same new vertex in every cell. So neighbours agree about a cut along their common face. Joints are given by
// angles, so a joint meant to pass through a vertex misses it by some 1e-16 of the region; exact arithmetic
// would cut slivers of that thickness. Hence a vertex within the weld distance of a plane lies in the plane.
// Along a convex outline heights rise and fall once. So vertices below, in and above form at most four runs,
// also with that band, and both parts are closed.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "talus/polyhedron.h"

namespace talus::rock_mass {

inline constexpr std::int32_t kSurface = -1;  ///< source of a plane that is no joint

struct Plane {
    Vec3 normal = Vec3::UnitZ();  ///< unit; upwards for joints, outwards for the region's surface
    double offset = 0;            ///< normal . x of its points [m]
    std::int32_t source = kSurface;
    std::int32_t number = 0;  ///< within its joint set

    double height(const Vec3& x) const { return normal.dot(x) - offset; }
};

/// Vertices no two of which are nearer than the weld distance (in any coordinate).
class VertexTable {
 public:
    explicit VertexTable(double weld) : weld_(weld), cell_(8 * weld) {}

    /// The vertex there, a new one if need be.
    std::int32_t add(const Vec3& position);
    const Vec3& operator[](std::int32_t vertex) const { return positions_[static_cast<std::size_t>(vertex)]; }
    double weld() const { return weld_; }
    std::size_t size() const { return positions_.size(); }

    /// -1 below, 0 in, 1 above the plane.
    int side(const Plane& plane, std::int32_t vertex) const {
        const double height = plane.height((*this)[vertex]);
        return height > weld_ ? 1 : height < -weld_ ? -1 : 0;
    }
    /// Where an edge that a plane passes through meets it.
    std::int32_t cut(const Plane& plane, std::int32_t a, std::int32_t b);

 private:
    std::int64_t stepOf(double coordinate) const;
    static std::uint64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z);
    /// A vertex there, -1: none.
    std::int32_t find(const Vec3& position) const;
    std::int32_t findIn(std::uint64_t key, const Vec3& position) const;

    double weld_, cell_;
    std::vector<Vec3> positions_;
    std::vector<std::int32_t> next_;  ///< of the same bucket, -1 at the end
    std::unordered_map<std::uint64_t, std::int32_t> first_;
};

struct CellFace {
    std::int32_t plane = 0;
    bool outward = true;                ///< whether the plane's normal points out of the cell
    std::vector<std::int32_t> outline;  ///< counter-clockwise seen from outside
};

struct Cell {
    std::vector<CellFace> faces;
};

struct Split {
    enum class Kind : std::uint8_t {
        below,  ///< the cell lies below the plane, or touches it from below
        above,
        cut,
        failed  ///< too thin against the weld distance to be cut properly
    };
    Kind kind = Kind::failed;
    Cell lower{}, upper{};
};

/// Cuts a cell by `planes[plane]`.
Split split(const Cell& cell, const std::vector<Plane>& planes, std::int32_t plane, VertexTable& vertices);

/// A box as a cell; its six planes are appended to `planes`.
Cell boxCell(const Vec3& min, const Vec3& max, std::vector<Plane>& planes, VertexTable& vertices);

/// The union of two cells with one face in common, if it is convex.
bool merge(const Cell& a, const Cell& b, const std::vector<Plane>& planes, const VertexTable& vertices,
           Cell& merged);

/// Extent along its thinnest face normal, over all cells together [m].
double thickness(const std::vector<const Cell*>& cells, const std::vector<Plane>& planes,
                 const VertexTable& vertices);

/// Area two faces in one plane have in common [m^2]; 0 unless they look at each other.
double sharedArea(const CellFace& a, const CellFace& b, const std::vector<Plane>& planes,
                  const VertexTable& vertices);

double volume(const Cell& cell, const VertexTable& vertices);
Vec3 centre(const Cell& cell, const VertexTable& vertices);  ///< mean of its faces' corners, inside the cell

}  // namespace talus::rock_mass
