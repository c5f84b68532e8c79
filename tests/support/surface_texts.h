#pragma once
// Surfaces as texts of mesh files.

#include <cstdio>
#include <string>

#include "talus/surface.h"

namespace talus::test {

/// That reads back as the same bits.
inline std::string exactText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

/// \param before  how many vertices of the file come first
inline std::string objText(const TriangleSurface& s, std::size_t before = 0) {
    std::string text;
    for (const Vec3& v : s.vertices)
        text += "v " + exactText(v.x()) + " " + exactText(v.y()) + " " + exactText(v.z()) + "\n";
    for (const auto& triangle : s.triangles) {
        text += "f";
        for (const std::int32_t v : triangle)
            text += " " + std::to_string(static_cast<std::size_t>(v) + before + 1);
        text += "\n";
    }
    return text;
}

inline std::string dxfPair(int code, const std::string& value) {
    return std::to_string(code) + "\n" + value + "\n";
}

inline std::string dxfPlace(int code, const Vec3& p) {
    return dxfPair(code, exactText(p.x())) + dxfPair(code + 10, exactText(p.y())) +
           dxfPair(code + 20, exactText(p.z()));
}

/// A 3DFACE each, with its last corner twice.
inline std::string dxfFaces(const TriangleSurface& s, const std::string& layer = "0") {
    std::string text;
    for (const auto& triangle : s.triangles) {
        text += dxfPair(0, "3DFACE") + dxfPair(8, layer);
        for (int k = 0; k < 4; ++k)
            text += dxfPlace(
                10 + k,
                s.vertices[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k < 3 ? k : 2)])]);
    }
    return text;
}

/// A polyface mesh.
inline std::string dxfPolyface(const TriangleSurface& s, const std::string& layer = "0") {
    std::string text = dxfPair(0, "POLYLINE") + dxfPair(8, layer) + dxfPair(66, "1") + dxfPair(70, "64") +
                       dxfPair(71, std::to_string(s.vertices.size())) +
                       dxfPair(72, std::to_string(s.triangles.size()));
    for (const Vec3& v : s.vertices)
        text += dxfPair(0, "VERTEX") + dxfPair(8, layer) + dxfPlace(10, v) + dxfPair(70, "192");
    for (const auto& [a, b, c] : s.triangles)
        text += dxfPair(0, "VERTEX") + dxfPair(8, layer) + dxfPlace(10, Vec3::Zero()) + dxfPair(70, "128") +
                dxfPair(71, std::to_string(-(a + 1))) + dxfPair(72, std::to_string(b + 1)) +
                dxfPair(73, std::to_string(c + 1));
    return text + dxfPair(0, "SEQEND");
}

/// A file with these entities.
inline std::string dxfText(const std::string& entities, const std::string& unit = "6") {
    return dxfPair(999, "by hand") + dxfPair(0, "SECTION") + dxfPair(2, "HEADER") + dxfPair(9, "$ACADVER") +
           dxfPair(1, "AC1015") + dxfPair(9, "$INSUNITS") + dxfPair(70, unit) + dxfPair(0, "ENDSEC") +
           dxfPair(0, "SECTION") + dxfPair(2, "BLOCKS") + dxfPair(0, "BLOCK") + dxfPair(8, "0") +
           dxfPair(0, "3DFACE") + dxfPair(0, "ENDBLK") + dxfPair(0, "ENDSEC") + dxfPair(0, "SECTION") +
           dxfPair(2, "ENTITIES") + entities + dxfPair(0, "ENDSEC") + dxfPair(0, "EOF");
}

}  // namespace talus::test
