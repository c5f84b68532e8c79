#pragma once
// Joint traces drawn as lines in a DXF file: each becomes a disc.

#include <optional>
#include <string>
#include <vector>

#include "mesh/plane_table.h"
#include "talus/fractures.h"
#include "talus/result.h"

namespace talus::formats {

struct TraceOptions {
    std::optional<std::string> layer{};        ///< only lines on it; none: on all layers
    std::optional<Orientation> orientation{};  ///< of traces that define no plane
};

struct Traces {
    std::vector<Fracture> discs;       ///< in the order of the file
    std::vector<std::string> notes{};  ///< for the user: entities left out, a unit that is not the metre
};

/// Lines, polylines and lightweight polylines of the section ENTITIES. A trace whose points span a plane has
/// that plane. A straight one, and one drawn in plan, takes the plane through its ends that is nearest to the
/// stated orientation. The disc's diameter is the distance of the ends, and its centre is between them.
/// Errors, with the trace's line: one that defines no plane where no orientation is stated; one that lies
/// across the stated orientation; closed and curved lines; a file without traces; one that is no DXF.
Result<Traces> readTraces(const std::string& path, const TraceOptions& options);
/// The same for text already in memory; `path` is used in messages.
Result<Traces> parseTraces(const std::string& text, const std::string& path, const TraceOptions& options);

/// The plane of a line in space, by least squares over its length.
struct TracePlane {
    Vec3 normal = Vec3::UnitZ();  ///< upwards
    double length = 0;            ///< between the two points farthest from each other [m]
    double relief = 0;            ///< farthest point from the straight line of its main direction [m]
    double off_plane = 0;         ///< farthest point from the plane [m]
};
/// \pre at least two points, not all the same
TracePlane planeOfTrace(const std::vector<Vec3>& points);

}  // namespace talus::formats
