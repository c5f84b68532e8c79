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

/// Parts a surface by the solids it names, if no edge is shared by just two of them, which are then pieces of
/// one; and each of these into what hangs together by edges of two triangles. A further solid of a name has
/// "-2" and so on behind it.
/// \param solid  of each triangle, index into `names`; -1: none
/// Errors ("triangles[i]"): an edge of more than two triangles of one solid, where two may touch.
Result<std::vector<SolidPart>> solidsOf(const TriangleSurface& surface,
                                        const std::vector<std::int32_t>& solid,
                                        const std::vector<std::string>& names);

}  // namespace talus::formats::mesh
