// [[block]] of several parts, and of mesh files.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "faults.h"
#include "support/files.h"
#include "talus/formats/mesh.h"
#include "talus/formats/snapshot.h"
#include "talus/rock_mass.h"
#include "talus/simulation.h"

namespace talus::formats {

namespace {

const std::string kAngle =
    "parts = [{ box = { min = [0, 0, 0], max = [1, 0.4, 0.2] } },\n"
    "         { vertices = "
    "[[0,0,0.2],[0.2,0,0.2],[0,0.4,0.2],[0.2,0.4,0.2],[0,0,0.8],[0.2,0,0.8],[0,0.4,0.8],"
    "[0.2,0.4,0.8]] }]\n";

std::string inBody(const std::string& keys) {
    return properties() + "[[block]]\nname = \"a\"\n" + keys;  // keys from line 9
}

Fault bodyFault(const std::string& keys, int line, const std::string& field, const std::string& fragment) {
    return {inBody(keys), line, "block[0]" + field, fragment};
}

/// The angle, as a closed surface.
TriangleSurface angleSurface() {
    return *extrudeProfile({{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 0.8}, {0, 0.8}}, 0, 0.4);
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string objOf(const TriangleSurface& surface) {
    std::string text;
    for (const Vec3& v : surface.vertices)
        text += "v " + number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + "\n";
    for (const auto& [a, b, c] : surface.triangles)
        text +=
            "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
    return text;
}

std::string plyHead(const TriangleSurface& surface, const std::string& format) {
    return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " +
           std::to_string(surface.vertices.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nelement face " +
           std::to_string(surface.triangles.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string textPly(const TriangleSurface& surface) {
    std::string text = plyHead(surface, "ascii");
    for (const Vec3& v : surface.vertices)
        text += number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + " 255\n";
    for (const auto& [a, b, c] : surface.triangles)
        text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    return text;
}

std::string binaryPly(const TriangleSurface& surface, bool big) {
    std::string bytes = plyHead(surface, big ? "binary_big_endian" : "binary_little_endian");
    const auto add = [&](const auto& value) {
        std::string own(reinterpret_cast<const char*>(&value), sizeof value);
        if (big) std::reverse(own.begin(), own.end());
        bytes += own;
    };
    for (const Vec3& v : surface.vertices) {
        for (const double coordinate : v) add(coordinate);
        add(std::uint8_t{255});
    }
    for (const auto& corners : surface.triangles) {
        add(std::uint8_t{3});
        for (const std::int32_t corner : corners) add(corner);
    }
    return bytes;
}

void checkAngle(const Polyhedron& shape) {
    const MassProperties mass = massProperties(shape);
    CHECK(shape.partCount() == 2);
    CHECK(mass.volume == doctest::Approx(0.128).epsilon(1e-12));
    const Vec3 centroid = (0.08 * Vec3(0.5, 0.2, 0.1) + 0.048 * Vec3(0.1, 0.2, 0.5)) / 0.128;
    CHECK((mass.centroid - centroid).norm() < 1e-12);
}

}  // namespace

TEST_CASE("blocks by hand: parts make one body, with a joint for each of its faces") {
    const Model model = readGood(inBody(kAngle)).model;
    REQUIRE(model.blocks.size() == 1);
    checkAngle(model.blocks[0].shape);
    CHECK(model.blocks[0].face_joint.size() == 12);
    CHECK(checkModel(model).empty());
}

TEST_CASE("blocks by hand: a mesh file is the body it encloses, whatever its format") {
    const test::TemporaryFolder folder;
    const TriangleSurface surface = angleSurface();
    for (const std::string& path :
         {folder.write("a.obj", objOf(surface)), folder.write("a.ply", textPly(surface)),
          folder.write("b.PLY", binaryPly(surface, false)),
          folder.write("c.ply", binaryPly(surface, true))}) {
        CAPTURE(path);
        checkAngle(readGood(inBody("mesh = \"" + path + "\"\n")).model.blocks[0].shape);
        const Model scaled = readGood(inBody("mesh = \"" + path + "\"\nscale = 2\n")).model;
        CHECK(massProperties(scaled.blocks[0].shape).volume == doctest::Approx(8 * 0.128));
    }
}

TEST_CASE("blocks by hand: faults of parts and meshes are reported with their places") {
    checkFault(bodyFault("parts = []\n", 9, ".parts", "found 0 parts, allowed: 1 to 1000"));
    checkFault(bodyFault("parts = [{ box = { min = [0, 0, 0], max = [1, 1, 0] } }]\n", 9, ".parts[0].box.max",
                         "found 0 along z"));
    checkFault(bodyFault("parts = [{ bx = 1 }]\n", 9, ".parts[0].bx", "did you mean \"box\"?"));
    checkFault(
        bodyFault("parts = [{ box = { min = [0, 0, 0], max = [1, 1, 1] } },\n"
                  "         { box = { min = [0.5, 0, 0], max = [2, 1, 1] } }]\n",
                  10, ".parts[1]", "found a part that overlaps part 0"));
    checkFault(
        bodyFault("parts = [{ box = { min = [0, 0, 0], max = [1, 1, 1] } },\n"
                  "         { box = { min = [3, 0, 0], max = [4, 1, 1] } }]\n",
                  10, ".parts[1]", "shares no face with the others"));
    checkFault(bodyFault(kAngle + "box = { min = [0, 0, 0], max = [1, 1, 1] }\n", 9, ".parts",
                         "found both box and parts"));
    checkFault(bodyFault(kAngle + "scale = 2\n", 11, ".scale", "only together with a mesh"));
    checkFault(bodyFault("mesh = \"none.obj\"\n", 9, ".mesh", "none.obj: error: cannot be opened"));
    checkFault(bodyFault("mesh = \"none.dwg\"\n", 9, ".mesh",
                         "allowed: a file that ends in .stl, .obj, .ply, .dxf, .asc or .xyz"));
    const test::TemporaryFolder folder;
    TriangleSurface open = angleSurface();
    open.triangles.pop_back();
    const auto errors = readBad(inBody("mesh = \"" + folder.write("open.obj", objOf(open)) + "\"\n"));
    REQUIRE(errors.size() == 3);  // the edges of the triangle that lacks
    for (const Error& error : errors) {
        CHECK(error.line == 9);
        CHECK(error.field == "block[0].mesh");
        CHECK(error.message.find("found an open surface") != std::string::npos);
    }
    TriangleSurface two = angleSurface();
    const auto count = static_cast<std::int32_t>(two.vertices.size());
    for (std::int32_t v = 0; v < count; ++v)
        two.vertices.push_back(two.vertices[static_cast<std::size_t>(v)] + Vec3(3, 0, 0));
    for (std::size_t t = angleSurface().triangles.size(); t-- > 0;) {
        auto corners = two.triangles[t];
        for (std::int32_t& v : corners) v += count;
        two.triangles.push_back(corners);
    }
    checkFault(bodyFault("mesh = \"" + folder.write("two.obj", objOf(two)) + "\"\n", 9, ".mesh",
                         "2 separate bodies"));
    checkFault(bodyFault(
        "mesh = \"" + folder.write("cut.ply", binaryPly(angleSurface(), false).substr(0, 300)) + "\"\n", 9,
        ".mesh", "lacks a finite number"));
}

}  // namespace talus::formats
