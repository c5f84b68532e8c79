// DXF as text: faces of all kinds give the surface that OBJ gives; what is not read is named.

#include <doctest/doctest.h>

#include <algorithm>

#include "../scenario/scenario_texts.h"
#include "support/files.h"
#include "support/surface_texts.h"
#include "support/terrains.h"
#include "talus/formats/mesh.h"

namespace talus::formats {

namespace {

using namespace talus::test;

TriangleSurface box() { return *boxSurface({1, 2, 3}, {3, 3, 4}); }

MeshSurface readGoodMesh(const std::string& text, const MeshOptions& options = {}) {
    auto mesh = parseMesh(text, "a.dxf", options);
    for (const Error& error : mesh.errors()) FAIL_CHECK(format(error));
    REQUIRE(mesh.ok());
    return std::move(*mesh);
}

std::string fault(const std::string& text, const MeshOptions& options = {}) {
    const auto mesh = parseMesh(text, "a.dxf", options);
    REQUIRE_FALSE(mesh.ok());
    return format(mesh.errors()[0]);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string withReturns(std::string text) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
        text.insert(at, "\r");
    return text;
}

}  // namespace

TEST_CASE("DXF: 3DFACE and polyface meshes are the surface that was written") {
    const TriangleSurface s = box();
    const std::string faces = dxfText(dxfFaces(s)), mesh = dxfText(dxfPolyface(s));
    for (const std::string& text : {faces, mesh, withReturns(faces)}) {
        const MeshSurface read = readGoodMesh(text);
        CHECK(read.surface.vertices.size() == 8);
        CHECK(read.surface.triangles.size() == 12);
        CHECK(surfaceVolume(read.surface) == doctest::Approx(2).epsilon(1e-14));
        CHECK(read.notes.empty());
    }
}

TEST_CASE("DXF: quadrilateral faces and polygon meshes") {
    // A box of six 3DFACE with four corners each.
    std::string faces;
    const auto built = *makeBox({0, 0, 0}, {2, 1, 1});
    for (const auto& face : built.faces) {
        faces += dxfPair(0, "3DFACE");
        for (int k = 0; k < 4; ++k)
            faces +=
                dxfPlace(10 + k, built.vertices[static_cast<std::size_t>(face[static_cast<std::size_t>(k)])]);
    }
    CHECK(surfaceVolume(readGoodMesh(dxfText(faces)).surface) == doctest::Approx(2).epsilon(1e-14));

    // A terrain of 3 rows with 4 places each, and one that is closed round N: the sides of a prism.
    const auto polygonMesh = [](const std::string& flags, int m, int n, const std::vector<Vec3>& places) {
        std::string text = dxfPair(0, "POLYLINE") + dxfPair(70, flags) + dxfPair(71, std::to_string(m)) +
                           dxfPair(72, std::to_string(n));
        for (const Vec3& p : places) text += dxfPair(0, "VERTEX") + dxfPlace(10, p) + dxfPair(70, "64");
        return dxfText(text + dxfPair(0, "SEQEND"));
    };
    std::vector<Vec3> places;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) places.emplace_back(i, j, 0.1 * i * j);
    MeshOptions terrain;
    terrain.base = -1;
    const MeshSurface ground = readGoodMesh(polygonMesh("16", 3, 4, places), terrain);
    // Each square's two triangles, prisms down to the base: mean height of their corners.
    double volume = 0;
    const auto z = [](int i, int j) { return 1 + 0.1 * i * j; };
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 3; ++j)
            volume += (2 * z(i, j) + z(i + 1, j) + 2 * z(i + 1, j + 1) + z(i, j + 1)) / 6;
    CHECK(surfaceVolume(ground.surface) == doctest::Approx(volume).epsilon(1e-14));

    terrain.open = true;
    terrain.base.reset();
    CHECK(has(fault(polygonMesh("16", 3, 5, places)),
              "found a polygon mesh of 3 times 5 with 12 vertices, allowed: as many as that"));
    CHECK(has(fault(polygonMesh("20", 3, 4, places)), "found a smoothed polygon mesh"));
    const MeshOptions whole;
    const auto tube =
        parseMesh(polygonMesh("48", 2, 3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}),
                  "a.dxf", whole);
    REQUIRE_FALSE(tube.ok());
    CHECK(tube.errors().size() == 6);  // its two ends are open, with three edges each
}

TEST_CASE("DXF: a terrain makes the blocks that OBJ makes, by its ending or by the key dxf") {
    const TemporaryFolder folder;
    const TriangleSurface s = terrainOf(Ground::benches, 8);
    const auto rock = [](const std::string& region) {
        return properties() + "[rock_mass]\nregion = { " + region +
               ", base = -5 }\n[[joint_set]]\ndip_deg = 30\ndip_direction_deg = 265\nspacing = 3\n";
    };
    const Model model = readGood(rock("mesh = \"" + folder.write("a.obj", objText(s)) + "\"")).model;
    for (const std::string& region :
         {"mesh = \"" + folder.write("a.DXF", dxfText(dxfFaces(s))) + "\"",
          "dxf = \"" + folder.write("a.txt", dxfText(dxfPolyface(s))) + "\"",
          "layer = \"TOPO\", dxf = \"" +
              folder.write("b.dxf", dxfText(dxfFaces(box(), "TANK") + dxfFaces(s, "TOPO"))) + "\""}) {
        const Model read = readGood(rock(region)).model;
        REQUIRE(read.blocks.size() == model.blocks.size());
        for (std::size_t b = 0; b < model.blocks.size(); ++b)
            CHECK(read.blocks[b].shape.vertices == model.blocks[b].shape.vertices);
    }
}

TEST_CASE("DXF: entities left out are reported, and the header's unit where it differs") {
    const std::string line = dxfPair(0, "LINE") + dxfPair(8, "0") + dxfPair(10, "not read");
    const std::string traces = dxfPair(0, "POLYLINE") + dxfPair(70, "8") + dxfPair(0, "VERTEX") +
                               dxfPlace(10, Vec3::Ones()) + dxfPair(0, "SEQEND");
    const MeshSurface read = readGoodMesh(dxfText(line + dxfFaces(box()) + line + traces, "4"));
    REQUIRE(read.notes.size() == 2);
    CHECK(read.notes[0] == "a.dxf has 2 LINE, 1 POLYLINE besides its faces, which are left out");
    CHECK(read.notes[1] ==
          "a.dxf has a unit of 0.001 m by its header, and was read with 1 m (scale says it otherwise)");
    MeshOptions options;
    options.scale = 1e-3;
    CHECK(readGoodMesh(dxfText(dxfFaces(box()), "4"), options).notes.empty());
    options.scale = 1;
    options.layer = "A";
    const auto both = readGoodMesh(dxfText(dxfFaces(box(), "A") + dxfFaces(box(), "B")), options);
    CHECK(both.surface.triangles.size() == 12);
    REQUIRE(both.notes.size() == 1);
    CHECK(both.notes[0] == "a.dxf has 12 faces or meshes on other layers than \"A\", which are left out");
}

TEST_CASE("DXF: faults name the file and the line, what was found and what is allowed") {
    CHECK(has(fault("AutoCAD Binary DXF\r\n\x1a"),
              "a.dxf: error: found a binary DXF file, allowed: DXF as text"));
    CHECK(has(fault("solid x\n"),
              "a.dxf:1: error: found \"solid x\" in place of a group code, allowed: DXF as text"));
    CHECK(has(fault(dxfPair(0, "SECTION") + dxfPair(2, "ENTITIES")),
              "a.dxf:4: error: found the end of the file without EOF"));
    CHECK(has(fault(dxfText("")), "a.dxf: error: found no faces, allowed: 3DFACE, and POLYLINE"));
    const std::string lines = fault(dxfText(dxfPair(0, "LWPOLYLINE") + dxfPair(0, "INSERT")));
    CHECK(has(lines, "found no faces but 1 INSERT, 1 LWPOLYLINE, allowed: 3DFACE"));
    CHECK(has(lines, "; explode inserted blocks; triangulate contour lines"));
    MeshOptions options;
    options.layer = "C";
    CHECK(has(fault(dxfText(dxfFaces(box(), "A") + dxfFaces(box(), "B")), options),
              "found no faces on layer \"C\", allowed: a layer that has some: \"A\", \"B\""));
    options.layer.reset();

    const std::string whole = dxfText(dxfFaces(box()));
    std::string broken = whole;
    const auto coordinate = broken.find("\n10\n") + 4;
    broken.replace(coordinate, 1, "x");
    const auto line =
        1 + std::count(broken.begin(), broken.begin() + static_cast<std::ptrdiff_t>(coordinate), '\n');
    CHECK(has(fault(broken),
              "a.dxf:" + std::to_string(line) + ": error: found \"x\" for group code 10 of 3DFACE"));
    CHECK(has(fault(dxfText(dxfPair(0, "3DFACE") + dxfPlace(10, Vec3::Zero()))),
              "found a 3DFACE without group code 11, allowed: three or four corners"));
    TriangleSurface s = box();
    s.triangles[3][1] = 11;
    CHECK(has(fault(dxfText(dxfPolyface(s))), "found the corner 12 of a polyface mesh, allowed: 1 to 8"));
    s = box();
    s.triangles.pop_back();
    CHECK(has(fault(dxfText(dxfFaces(s))), "found an open surface: the edge from"));
    options.cell = 1;
    CHECK(has(fault(whole, options), "cell_m: found a cell size for a mesh"));
}

}  // namespace talus::formats
