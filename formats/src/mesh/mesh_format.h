#pragma once
// Which format a mesh file has.

#include <string>

#include "mesh/builder.h"
#include "talus/formats/mesh.h"

namespace talus::formats::mesh {

/// One of the formats; by_name where the name tells none.
MeshFormat formatOf(const std::string& path, MeshFormat format);
Error unknownEnding(const std::string& path);

/// Reads a file's bytes. Errors of the options have their field: "cell_m", "layer".
Result<FileSurface> surfaceOf(const std::string& bytes, const std::string& path, const MeshOptions& options);

}  // namespace talus::formats::mesh
