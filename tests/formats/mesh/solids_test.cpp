// Files with several solids, and meshes that are mended as they are read.

#include <doctest/doctest.h>

#include <algorithm>

#include "../scenario/faults.h"
#include "support/files.h"
#include "support/surface_texts.h"
#include "support/terrains.h"
#include "talus/formats/mesh.h"
#include "talus/polyhedron.h"

namespace talus::formats {

namespace {

using namespace talus::test;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TriangleSurface boxAt(double x) { return *boxSurface({x, 0, 0}, {x + 1, 1, 1}); }

std::string stlText(const TriangleSurface& s, const std::string& name) {
    std::string text = "solid " + name + "\n";
    for (const auto& t : s.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::int32_t v : t) {
            const Vec3& p = s.vertices[static_cast<std::size_t>(v)];
            text += "vertex " + exactText(p.x()) + " " + exactText(p.y()) + " " + exactText(p.z()) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid " + name + "\n";
}

std::vector<std::string> namesOf(const MeshSolids& solids) {
    std::vector<std::string> names;
    for (const auto& solid : solids.solids) names.push_back(solid.name);
    return names;
}

MeshSolids readGoodSolids(const std::string& text, const std::string& name, const MeshOptions& options = {}) {
    auto solids = parseSolids(text, name, options);
    for (const Error& error : solids.errors()) FAIL_CHECK(format(error));
    REQUIRE(solids.ok());
    return std::move(*solids);
}

bool mentions(const std::vector<std::string>& warnings, const std::string& words) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return has(w, words); });
}

}  // namespace

TEST_CASE("solids: distinguished by name where they touch, in every format") {
    // Two boxes with a common face and its corners.
    const std::string obj = "o left\n" + objText(boxAt(0)) + "g right\n" + objText(boxAt(1), 8);
    const std::string stl = stlText(boxAt(0), "left") + stlText(boxAt(1), "right");
    const std::string dxf = dxfText(dxfPolyface(boxAt(0), "left") + dxfPolyface(boxAt(1), "right"));
    const std::string faces = dxfText(dxfFaces(boxAt(0), "left") + dxfFaces(boxAt(1), "right"));
    for (const auto& file : {std::pair(obj, "a.obj"), std::pair(stl, "a.stl"), std::pair(dxf, "a.dxf"),
                             std::pair(faces, "a.dxf")}) {
        CAPTURE(file.second);
        const MeshSolids solids = readGoodSolids(file.first, file.second);
        CHECK(namesOf(solids) == std::vector<std::string>{"left", "right"});
        for (const auto& solid : solids.solids) {
            CHECK(surfaceVolume(solid.surface) == doctest::Approx(1).epsilon(1e-14));
            CHECK(solid.surface.vertices.size() == 8);
        }
    }
}

TEST_CASE("solids: without names by what hangs together; names of a body's sides part nothing") {
    const MeshSolids apart = readGoodSolids(objText(boxAt(0)) + objText(boxAt(2), 8), "a.obj");
    CHECK(namesOf(apart) == std::vector<std::string>{"", ""});
    CHECK(apart.solids[1].surface.vertices[0].x() >= 2);

    // One box whose first two triangles are a group of their own.
    std::string grouped = objText(boxAt(0));
    grouped.insert(grouped.find('f'), "g bottom\n");
    std::size_t third = grouped.find("\nf", grouped.find("\nf", grouped.find("g bottom")) + 1);
    third = grouped.find("\nf", third + 1);
    grouped.insert(third + 1, "g others\n");
    CHECK(readGoodSolids(grouped, "a.obj").solids.size() == 1);

    // One name for two bodies.
    const MeshSolids twice = readGoodSolids("o A\n" + objText(boxAt(0)) + objText(boxAt(2), 8), "a.obj");
    CHECK(namesOf(twice) == std::vector<std::string>{"A", "A-2"});

    const auto touching = parseSolids(objText(boxAt(0)) + objText(boxAt(1), 8), "a.obj");
    REQUIRE_FALSE(touching.ok());
    CHECK(has(format(touching.errors()[0]), "solids that touch have to be told apart by their names"));
    CHECK(touching.errors()[0].line > 0);
    TriangleSurface open = boxAt(2);
    open.triangles.pop_back();
    const auto one_open = parseSolids("o A\n" + objText(boxAt(0)) + "o B\n" + objText(open, 8), "a.obj");
    REQUIRE_FALSE(one_open.ok());
    CHECK(has(format(one_open.errors()[0]), "found an open surface"));
}

TEST_CASE("blocks: each solid of a mesh is one, by the name of the table and its own") {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("two.obj", "o left\n" + objText(boxAt(0)) + "o right\n" + objText(boxAt(1), 8));
    const auto text = [&](const std::string& keys) {
        return properties() + block("floor", "fixed = true\n") + "[[block]]\n" + keys;  // keys from line 12
    };
    const Scenario good =
        readGood(text("name = \"q.\"\nmesh = \"" + file + "\"\neach_solid = true\nscale = 2\n"));
    REQUIRE(good.model.blocks.size() == 3);
    CHECK(good.model.blocks[1].name == "q.left");
    CHECK(good.model.blocks[2].name == "q.right");
    for (int k : {1, 2})
        CHECK(massProperties(good.model.blocks[static_cast<std::size_t>(k)].shape).volume ==
              doctest::Approx(8).epsilon(1e-12));
    const std::string unnamed = folder.write("apart.obj", objText(boxAt(2)) + objText(boxAt(4), 8));
    const Scenario numbers =
        readGood(text("name = \"\"\nmesh = \"" + unnamed + "\"\neach_solid = true\nfixed = true\n"));
    CHECK(numbers.model.blocks[1].name == "1");
    CHECK(numbers.model.blocks[2].name == "2");
    CHECK(numbers.model.blocks[2].motion == Motion::fixed);

    const auto fault = [&](const std::string& keys, int line, const std::string& field,
                           const std::string& fragment) {
        checkFault({text(keys), line, "block[1]" + field, fragment});
    };
    fault("name = \"\"\neach_solid = true\n", 11, ".mesh", "missing");
    fault("name = \"a\"\nmesh = \"" + unnamed + "\"\n", 13, ".mesh",
          "found a surface around 2 separate bodies");
    fault("name = \"a\"\neach_solid = true\nmesh = \"" + file + "\"\nvertices = []\n", 15, ".vertices",
          "beside each_solid");
    fault("name = \"a\"\nmesh = \"" + unnamed + "\"\neach_solid = true\nlargest_hole = 1\n", 15,
          ".largest_hole", "only together with repair = true");
    fault("name = \"a\"\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\nrepair = true\n", 14, ".repair",
          "found repair without mesh");
}

TEST_CASE(
    "repair: a terrain with a doubled and a turned triangle, a hole and gaps is mended, and it is told") {
    const TemporaryFolder folder;
    constexpr int kN = 8;
    const std::vector<double> z = heights(Ground::rough, kN);
    const TriangleSurface whole = terrainOf(z, kN);
    TriangleSurface bad = whole;
    bad.triangles.push_back(bad.triangles[10]);
    std::swap(bad.triangles[20][0], bad.triangles[20][1]);
    // The square at (8, 8) to (10, 10) is missing, and a vertex is there twice, 0.5 mm apart.
    const std::size_t square = 2 * (4 * kN + 4);
    bad.triangles.erase(bad.triangles.begin() + static_cast<std::ptrdiff_t>(square),
                        bad.triangles.begin() + static_cast<std::ptrdiff_t>(square) + 2);
    bad.vertices.push_back(bad.vertices[10] + Vec3(0, 0, 5e-4));
    for (auto& t : bad.triangles)
        if (std::find(t.begin(), t.end(), 10) != t.end()) {
            std::replace(t.begin(), t.end(), 10, (kN + 1) * (kN + 1));
            break;
        }
    const auto rock = [](const std::string& region) {
        return properties() + "[rock_mass]\nregion = { " + region +
               ", base = -5 }\n[[joint_set]]\ndip_deg = 30\ndip_direction_deg = 265\nspacing = 3\n";
    };
    const std::string file = folder.write("bad.obj", objText(bad));
    CHECK(readBad(rock("mesh = \"" + file + "\"")).size() > 0);
    const Scenario mended = readGood(rock("mesh = \"" + file + "\", repair = true, largest_hole = 3"));
    CHECK(
        mentions(mended.warnings, "bad.obj was repaired within 0.0016 m: 1 duplicate vertex, 0 T-junctions"));
    CHECK(mentions(mended.warnings, "bad.obj was mended: 1 doubled triangle left out, at ("));
    CHECK(mentions(mended.warnings, "; 1 triangle turned over, at ("));
    CHECK(mentions(mended.warnings, "; 1 hole closed, at (9, 9, "));
    CHECK(mentions(mended.warnings, "(4 edges, "));

    // All is as it was but the square, whose diagonal may be the other one.
    MeshOptions options;
    options.base = -5;
    options.mend = true;
    options.largest_hole = 3;
    const auto read = parseMesh(objText(bad), "bad.obj", options);
    REQUIRE(read.ok());
    CHECK(std::abs(surfaceVolume(read->surface) - surfaceVolume(closeTerrain(whole, -5)->surface)) < 1.0);
    CHECK(read->surface.triangles.size() == closeTerrain(whole, -5)->surface.triangles.size());

    options.largest_hole = 1;
    const auto open = parseMesh(objText(bad), "bad.obj", options);
    REQUIRE_FALSE(open.ok());
    CHECK(has(open.errors()[0].message, "found a hole with 4 edges"));
    CHECK(has(open.errors()[0].message, "; repair closes holes no wider than largest_hole, 1 m"));
}

TEST_CASE("repair: each solid of a file is mended by itself") {
    TriangleSurface open = boxAt(0), inverted = boxAt(1);
    open.triangles.erase(open.triangles.begin());
    for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
    inverted.triangles.push_back(inverted.triangles[0]);
    MeshOptions options;
    options.mend = true;
    options.largest_hole = 2;
    const MeshSolids solids =
        readGoodSolids("o A\n" + objText(open) + "o B\n" + objText(inverted, 8), "a.obj", options);
    CHECK(namesOf(solids) == std::vector<std::string>{"A", "B"});
    for (const auto& solid : solids.solids)
        CHECK(surfaceVolume(solid.surface) == doctest::Approx(1).epsilon(1e-14));
    CHECK(mentions(solids.notes, "a.obj was mended: 1 hole closed, at ("));
    CHECK(mentions(solids.notes, "1 doubled triangle left out, at ("));
    CHECK(mentions(solids.notes, "12 triangles turned over, at ("));
    CHECK(mentions(solids.notes, "and 7 more"));
}

}  // namespace talus::formats
