// PLY (binary, little-endian): vertices, then faces as polygons with numbers of theirs and a colour.

#include <cstring>

#include "export/placed.h"
#include "export/role_colours.h"

namespace talus::formats {
namespace {

template <class Number>
void append(std::string& out, Number value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// \param properties  of a face, between its corners and its colour
std::string head(std::size_t vertices, std::size_t faces, const std::string& properties) {
    return "ply\nformat binary_little_endian 1.0\ncomment Talus, m\nelement vertex " +
           std::to_string(vertices) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
           std::to_string(faces) + "\nproperty list uchar int vertex_indices\n" + properties +
           "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
}

void appendVertices(std::string& out, const std::vector<Vec3>& vertices) {
    for (const Vec3& v : vertices)
        for (const double x : {v.x(), v.y(), v.z()}) append(out, x);
}

/// Without inner ones.
std::size_t surfaceFaceCount(const RunGeometry& g) {
    std::size_t count = 0;
    for (std::size_t f = 0; f + 1 < g.face_vertex_begin.size(); ++f) count += g.isInner(f) ? 0 : 1;
    return count;
}

}  // namespace

std::string plyBlocks(const SnapshotHeader& header, const LightFrame& frame) {
    const RunGeometry& g = header.geometry;
    const std::vector<Vec3> vertices = placedVertices(header, frame);
    const std::vector<FailureMode> roles = failureRoles(header, frame);
    std::string out =
        head(vertices.size(), surfaceFaceCount(g), "property int block\nproperty uchar failure_role\n");
    appendVertices(out, vertices);
    for (std::size_t b = 0; b < header.names.size(); ++b) {
        const RoleColour colour = colourOf(header.motions[b], roles[b]);
        for (auto f = static_cast<std::size_t>(g.face_begin[b]);
             f < static_cast<std::size_t>(g.face_begin[b + 1]); ++f) {
            if (g.isInner(f)) continue;
            const auto begin = g.face_vertex_begin[f], end = g.face_vertex_begin[f + 1];
            append(out, static_cast<std::uint8_t>(end - begin));
            for (auto k = begin; k < end; ++k) append(out, g.face_vertex[static_cast<std::size_t>(k)]);
            append(out, static_cast<std::int32_t>(b));
            append(out, static_cast<std::uint8_t>(roles[b]));
            for (const std::uint8_t part : colour) append(out, part);
        }
    }
    return out;
}

std::string plyMap(const PolygonMap& map) {
    std::string properties;
    for (const auto& [name, values] : map.values) properties += "property double " + name + "\n";
    std::string out = head(map.vertices.size(), map.polygons.size(), properties);
    appendVertices(out, map.vertices);
    for (std::size_t k = 0; k < map.polygons.size(); ++k) {
        append(out, static_cast<std::uint8_t>(map.polygons[k].size()));
        for (const std::int32_t vertex : map.polygons[k]) append(out, vertex);
        for (const auto& [name, values] : map.values) append(out, values[k]);
        for (const std::uint8_t part : map.colours[k]) append(out, part);
    }
    return out;
}

}  // namespace talus::formats
