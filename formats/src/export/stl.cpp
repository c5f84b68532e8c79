// Binary STL: 80 bytes of header, the number of triangles, then normal and corners of each as floats. Of a
// block of several parts each part is a closed surface, so that volumes add up.

#include <cstring>

#include "export/placed.h"

namespace talus::formats {
namespace {

constexpr std::size_t kHeaderBytes = 80;

void append(std::string& out, const Vec3& v) {
    const float values[3] = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    out.append(reinterpret_cast<const char*>(values), sizeof values);
}

void appendTriangle(std::string& out, const Vec3& a, const Vec3& b, const Vec3& c) {
    append(out, (b - a).cross(c - a).normalized());
    append(out, a), append(out, b), append(out, c);
    out.append(2, '\0');  // attributes: none
}

}  // namespace

std::string stlBlocks(const SnapshotHeader& header, const LightFrame& frame) {
    const RunGeometry& g = header.geometry;
    const std::vector<Vec3> vertices = placedVertices(header, frame);
    std::string triangles;
    std::uint32_t count = 0;
    for (std::size_t f = 0; f + 1 < g.face_vertex_begin.size(); ++f) {
        if (g.isInner(f)) continue;
        const auto begin = static_cast<std::size_t>(g.face_vertex_begin[f]);
        const auto end = static_cast<std::size_t>(g.face_vertex_begin[f + 1]);
        const auto corner = [&](std::size_t k) {
            return vertices[static_cast<std::size_t>(g.face_vertex[k])];
        };
        for (std::size_t k = begin + 2; k < end; ++k, ++count)
            appendTriangle(triangles, corner(begin), corner(k - 1), corner(k));
    }
    std::string out = "Talus, binary STL, m";
    out.resize(kHeaderBytes, ' ');
    out.append(reinterpret_cast<const char*>(&count), sizeof count);
    return out + triangles;
}

}  // namespace talus::formats
