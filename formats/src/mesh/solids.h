#pragma once
// The solids of a file that has several.

#include <string>
#include <vector>

#include "talus/result.h"
#include "talus/surface.h"

namespace talus::formats::mesh {

struct SolidPart {
    std::string name;  ///< of its own; "" where the file has no names
    TriangleSurface surface;
    std::vector<std::size_t> source;  ///< per triangle: index into those of the whole
};

/// Divides a surface by the solids it names, unless just two of them share an edge and so are pieces of one.
/// Each is then divided into the pieces connected by edges of two triangles. Further solids of the same name
/// get "-2" and so on.
/// \param solid  of each triangle, index into `names`; -1: none
/// Errors ("triangles[i]"): an edge of more than two triangles of one solid, where two may touch.
Result<std::vector<SolidPart>> solidsOf(const TriangleSurface& surface,
                                        const std::vector<std::int32_t>& solid,
                                        const std::vector<std::string>& names);

}  // namespace talus::formats::mesh
