#pragma once
// Surfaces from mesh files (STL and PLY as text or binary, Wavefront OBJ, DXF as text), height grids (ESRI
// ASCII) and points. They are closed, or open terrains that get sides and a base.

#include <optional>
#include <string>
#include <vector>

#include "talus/result.h"
#include "talus/surface.h"

namespace talus::formats {

enum class MeshFormat : std::uint8_t {
    by_name,  ///< .stl, .obj, .ply, .asc, .dxf or .xyz, in capitals or not
    stl,
    obj,
    ply,
    asc,
    dxf,
    xyz  ///< points, thinned to a height grid
};

/// Options for reading a surface. Lengths in metres, after scaling.
struct MeshOptions {
    MeshFormat format = MeshFormat::by_name;
    double scale = 1.0;  ///< from the file's unit to metres
    /// Subtracted from all coordinates. Default: nothing; for coordinates beyond `farthest` in plan, which
    /// have too few digits left, their lower corner in plan in whole hundreds of metres
    std::optional<Vec3> shift;
    double farthest = 1e6;
    std::optional<double> base;  ///< an open terrain is closed down to this elevation
    /// What is repaired (repairSurface); default 1e-6 of the extent, the digits of an STL file
    std::optional<double> tolerance;
    std::optional<double> simplify;  ///< deviation that is allowed (simplifySurface)
    bool open = false;               ///< it stays an open terrain; all its triangles must face up
    /// Doubled triangles are left out, triangles turned to face alike, small holes closed (mendSurface); the
    /// tolerance is then 1e-4 of the extent unless it is given
    bool mend = false;
    std::optional<double> largest_hole{};  ///< largest that is closed; default 0.05 of the extent
    std::optional<std::string> layer{};    ///< of DXF: only its faces
    std::optional<double> cell{};          ///< of points: side of the grid's cells
    bool median = false;                   ///< of points: height of a cell; else the mean
};

struct MeshSurface {
    TriangleSurface surface;  ///< closed, unless it was to stay open
    Vec3 shift = Vec3::Zero();
    std::vector<std::string> notes;  ///< what was repaired, shifted or simplified, for the user
};

/// The solids of a file, each a closed surface that faces outwards.
struct MeshSolids {
    struct Solid {
        std::string name;  ///< of its own; "" where the file names none
        TriangleSurface surface;
    };
    std::vector<Solid> solids;  ///< in the order of the file
    Vec3 shift = Vec3::Zero();
    std::vector<std::string> notes;
};

/// Reads a closed surface, or an open terrain and closes it. Vertices with equal coordinates are one. Faces
/// of OBJ and PLY with more than three corners must be convex. The grid's cells are divided along the
/// diagonal whose ends differ less in height. Errors: the file cannot be read, is cut short or malformed
/// (with its line, if it is text); those of checkSurface or closeTerrain (field "base" for the base), with
/// the triangle's line, or else its number from 1, and the place in the file's coordinates, scaled to metres
/// and shifted.
Result<MeshSurface> readMesh(const std::string& path, const MeshOptions& options = {});
/// The same for a file's bytes in memory; `path` is used in messages and by its ending.
Result<MeshSurface> parseMesh(const std::string& bytes, const std::string& path,
                              const MeshOptions& options = {});

/// Reads solids that do not touch, or that the file distinguishes by name (`o` or `g` of OBJ, `solid` of STL,
/// polyface meshes and layers of DXF). Errors: as readMesh; solids without names that touch.
Result<MeshSolids> readSolids(const std::string& path, const MeshOptions& options = {});
/// The same for a file's bytes in memory.
Result<MeshSolids> parseSolids(const std::string& bytes, const std::string& path,
                               const MeshOptions& options = {});

}  // namespace talus::formats
