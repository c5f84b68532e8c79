// Mesh files as other programs write them, and faulty ones: the message names the file and, in text, the
// line.

#include "talus/formats/mesh.h"

#include <doctest/doctest.h>

#include <array>
#include <cstring>

#include "support/cpu_time.h"
#include "support/files.h"
#include "talus/formats/scenario.h"

namespace talus::formats {

namespace {

using test::TemporaryFile;
using Corners = std::array<Vec3, 3>;

/// A tetrahedron of volume 1/6, seen from outside.
std::vector<Corners> tetrahedron() {
    const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}

std::string textStl(const std::vector<Corners>& triangles) {
    std::string text = "solid test\n";  // the facet of triangle k begins on line 2 + 7 k
    for (const Corners& corners : triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const Vec3& c : corners)
            text += "      vertex " + std::to_string(c.x()) + " " + std::to_string(c.y()) + " " +
                    std::to_string(c.z()) + "\n";
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid test\n";
}

std::string binaryStl(const std::vector<Corners>& triangles) {
    std::string bytes(80, ' ');
    bytes.replace(0, 5, "solid");  // as some programs do
    const auto append = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(static_cast<std::uint32_t>(triangles.size()));
    for (const Corners& corners : triangles) {
        for (int i = 0; i < 3; ++i) append(0.0f);
        for (const Vec3& c : corners)
            for (const double value : c) append(static_cast<float>(value));
        append(std::uint16_t{0});
    }
    return bytes;
}

Result<TriangleSurface> read(const std::string& path, MeshFormat format, double scale) {
    auto mesh = readMesh(
        path, {.format = format, .scale = scale, .shift = {}, .base = {}, .tolerance = {}, .simplify = {}});
    if (!mesh) return mesh.errors();
    return std::move(mesh->surface);
}
Result<TriangleSurface> readStl(const std::string& path, double scale = 1) {
    return read(path, MeshFormat::stl, scale);
}
Result<TriangleSurface> readObj(const std::string& path, double scale = 1) {
    return read(path, MeshFormat::obj, scale);
}

std::string fault(const Result<TriangleSurface>& surface) {
    REQUIRE_FALSE(surface.ok());
    return format(surface.errors()[0]);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("STL: text and binary give the same closed surface") {
    for (const std::string& bytes : {textStl(tetrahedron()), binaryStl(tetrahedron())}) {
        const TemporaryFile file("t.stl", bytes);
        const auto surface = readStl(file.path(), 2.0);
        REQUIRE(surface.ok());
        CHECK(surface->vertices.size() == 4);
        CHECK(surface->triangles.size() == 4);
        CHECK(surfaceVolume(*surface) == doctest::Approx(8.0 / 6));
    }
}

TEST_CASE("STL: faults name file and line") {
    auto triangles = tetrahedron();
    triangles.pop_back();
    const TemporaryFile open("open.stl", textStl(triangles));
    CHECK(has(fault(readStl(open.path())),
              "open.stl:2: error: triangle 1: found an open surface: the edge from"));
    const TemporaryFile open_binary("open.stl", binaryStl(triangles));
    CHECK(has(fault(readStl(open_binary.path())), "open.stl: error: triangle 1: found an open surface"));

    triangles = tetrahedron();
    std::swap(triangles[1][0], triangles[1][1]);
    const TemporaryFile turned("turned.stl", textStl(triangles));
    CHECK(has(fault(readStl(turned.path())), "opposite ways"));
    triangles = tetrahedron();
    for (Corners& corners : triangles) std::swap(corners[0], corners[1]);
    const TemporaryFile inverted("inverted.stl", textStl(triangles));
    CHECK(has(fault(readStl(inverted.path())), "faces inwards"));

    std::string text = textStl(tetrahedron());
    text.replace(text.find("1.000000"), 8, "1.0000x0");
    const TemporaryFile number("number.stl", text);
    CHECK(has(fault(readStl(number.path())),
              "number.stl:5: error: found \"1.0000x0\", allowed: vertex with three"));
    const TemporaryFile cut("cut.stl", binaryStl(tetrahedron()).substr(0, 200));
    CHECK(has(fault(readStl(cut.path())), "found 200 bytes, allowed: 284 for the 4 triangles"));
    const TemporaryFile other("other.stl", "hello\n");
    CHECK(has(fault(readStl(other.path())), "other.stl:1: error: found \"hello\""));
    const TemporaryFile empty("empty.stl", "");
    CHECK(has(fault(readStl(empty.path())), "found no triangles"));
    CHECK(has(fault(readStl("none.stl")), "none.stl: error: cannot be opened"));
}

TEST_CASE("OBJ: polygons, textures and normals, indices from either end") {
    const TemporaryFile file(
        "box.obj",
        "# a box\nmtllib x.mtl\no box\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\n"
        "v 2 1 1\nv 0 1 1\nvn 0 0 1\nusemtl rock\nf 4 3 2 1\nf 5/1 6/1 7/1 8/1\nf 1//1 2//1 6//1 "
        "5//1\nf 2 3 7 6\nf -6 -5 -1 -2\nf 4 1 5 8\n");
    const auto surface = readObj(file.path());
    for (const Error& error : surface.errors()) FAIL_CHECK(format(error));
    REQUIRE(surface.ok());
    CHECK(surface->triangles.size() == 12);
    CHECK(surfaceVolume(*surface) == doctest::Approx(2));
}

TEST_CASE("OBJ: faults name file and line") {
    const auto message = [](const std::string& text) {
        const TemporaryFile file("m.obj", text);
        return fault(readObj(file.path()));
    };
    CHECK(has(message("v 0 0\n"), "m.obj:1: error: found \"\", allowed: v with three finite numbers"));
    CHECK(has(message("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
              "m.obj:4: error: found the corner \"4\", allowed: 1 to 3"));
    CHECK(has(message("v 0 0 0\nv 1 0 0\nf 1 2\n"), "m.obj:3: error: found a face with 2 corners"));
    CHECK(has(message("v 0 0 0\nv 1 0 0\nv .2 .2 0\nv 0 1 0\nf 2 3 4 1\n"),
              "m.obj:5: error: found a face that is not convex"));
    CHECK(has(message("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              "m.obj:4: error: triangle 1: found an open surface"));
}

TEST_CASE("small files that speak of much are refused at once, whatever they speak of") {
    const double start = test::cpuSeconds();
    const auto message = [](const std::string& bytes, const std::string& name) {
        const auto mesh = parseMesh(bytes, name);
        REQUIRE_FALSE(mesh.ok());
        return mesh.errors().front().message;
    };
    for (int k = 0; k < 20; ++k)
        CHECK(message("ncols 10000\nnrows 10000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n", "a.asc")
                  .starts_with("found 3 heights, allowed: ncols times nrows, 100000000"));
    std::string ply = "ply\nformat ascii 1.0\n";
    for (int k = 0; k < 50'000; ++k) ply += "element a 800000\n";
    CHECK(message(ply + "end_header\n", "a.ply") == "found an element \"a\" without properties");
    CHECK(test::cpuSeconds() - start < 2);
}

}  // namespace talus::formats
