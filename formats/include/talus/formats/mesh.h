#pragma once
// Closed surfaces from mesh files: STL (text and binary), Wavefront OBJ and PLY (text and binary).

#include <string>

#include "talus/result.h"
#include "talus/rock_mass.h"

namespace talus::formats {

/// Reads an STL file; the program finds out itself whether it is text or binary. Corners with equal coordinates become
/// one vertex, coordinates are taken as metres times `scale`.
/// Errors: the file cannot be read, is cut short or malformed (with its line, if it is text), or the surface is not
/// closed, manifold and facing outwards (checkSurface; with the line of the triangle, else its number in the message).
Result<TriangleSurface> readStl(const std::string& path, double scale = 1.0);

/// The same for OBJ: `v` and `f` lines count, all others are passed over. Faces with more than three corners must be
/// convex; vertices are shared by index, and those with equal coordinates become one.
Result<TriangleSurface> readObj(const std::string& path, double scale = 1.0);

/// The same for PLY: the properties x, y, z of its vertices and the corners of its faces count, which must be convex.
Result<TriangleSurface> readPly(const std::string& path, double scale = 1.0);

/// One of these by the end of its name: .stl, .obj or .ply, in capitals or not.
Result<TriangleSurface> readMesh(const std::string& path, double scale = 1.0);

}  // namespace talus::formats
