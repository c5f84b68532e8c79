// Terrains from files: one ground in every format makes the same blocks, also in survey coordinates; faults
// of grids.

#include <algorithm>
#include <cstdio>

#include "../scenario/scenario_texts.h"
#include "support/files.h"
#include "support/slower.h"
#include "support/terrains.h"
#include "talus/formats/mesh.h"

namespace talus::formats {

namespace {

using namespace talus::test;

constexpr int kN = 8;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string coordinates(const Vec3& v) { return number(v.x()) + " " + number(v.y()) + " " + number(v.z()); }

std::string obj(const TriangleSurface& s) {
    std::string text;
    for (const Vec3& v : s.vertices) text += "v " + coordinates(v) + "\n";
    for (const auto& [a, b, c] : s.triangles)
        text +=
            "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
    return text;
}

std::string stl(const TriangleSurface& s) {
    std::string text = "solid ground\n";
    for (const auto& t : s.triangles) {
        text += "facet normal 0 0 1\nouter loop\n";
        for (const std::int32_t v : t)
            text += "vertex " + coordinates(s.vertices[static_cast<std::size_t>(v)]) + "\n";
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
}

std::string ply(const TriangleSurface& s) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(s.vertices.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                       std::to_string(s.triangles.size()) +
                       "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& v : s.vertices) text += coordinates(v) + "\n";
    for (const auto& [a, b, c] : s.triangles)
        text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    return text;
}

std::string asc(const std::vector<double>& z, int n, const Vec3& origin, const std::string& more = "") {
    std::string text = "NCOLS " + std::to_string(n + 1) + "\nnrows " + std::to_string(n + 1) +
                       "\nxllcorner " + number(origin.x() - 1) + "\nyllcenter " + number(origin.y()) +
                       "\ncellsize 2\n" + more;
    for (int j = n; j >= 0; --j) {
        for (int i = 0; i <= n; ++i)
            text += number(z[static_cast<std::size_t>(j * (n + 1) + i)] + origin.z()) + " ";
        text += "\n";
    }
    return text;
}

/// Properties of six lines, the region on line 8.
std::string rock(const std::string& region) {
    std::string text = properties() + "[rock_mass]\nregion = { " + region + " }\n";
    for (const char* set :
         {"25\ndip_direction_deg = 265\nspacing = 3", "80\ndip_direction_deg = 95\nspacing = 4",
          "86\ndip_direction_deg = 5\nspacing = 4"})
        text += std::string("[[joint_set]]\ndip_deg = ") + set + "\n";
    return text;
}

void checkSameBlocks(const Model& a, const Model& b) {
    REQUIRE(a.blocks.size() == b.blocks.size());
    for (std::size_t k = 0; k < a.blocks.size(); ++k)
        CHECK(a.blocks[k].shape.vertices == b.blocks[k].shape.vertices);
}

bool mentions(const std::vector<std::string>& warnings, const std::string& words) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

std::string fault(const std::string& path, const MeshOptions& options) {
    const auto mesh = readMesh(path, options);
    REQUIRE_FALSE(mesh.ok());
    return format(mesh.errors()[0]);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

MeshOptions onBase(double base) {
    MeshOptions options;
    options.base = base;
    return options;
}

}  // namespace

TEST_CASE("terrain files: every ground makes the same blocks in all formats, and at survey coordinates") {
    const TemporaryFolder folder;
    const Vec3 survey(451200, 5412300, 0);
    for (const Ground ground : kGrounds) {
        if (kTriesFew && ground != kGrounds[0]) continue;
        const std::vector<double> z = heights(ground, kN);
        const TriangleSurface s = terrainOf(z, kN), far = terrainOf(z, kN, survey);
        const Model model =
            readGood(rock("obj = \"" + folder.write("a.obj", obj(s)) + "\", base = -5")).model;
        CHECK(model.blocks.size() > 50);
        for (const std::string& region :
             {"stl = \"" + folder.write("a.stl", stl(s)) + "\"",
              "ply = \"" + folder.write("a.ply", ply(s)) + "\"",
              "asc = \"" + folder.write("a.asc", asc(z, kN, Vec3::Zero())) + "\"",
              "mesh = \"" + folder.write("b.ASC", asc(z, kN, Vec3::Zero())) + "\""})
            checkSameBlocks(model, readGood(rock(region + ", base = -5")).model);
        for (const std::string& file :
             {folder.write("far.obj", obj(far)), folder.write("far.stl", stl(far)),
              folder.write("far.ply", ply(far)), folder.write("far.asc", asc(z, kN, survey))}) {
            const Scenario moved = readGood(rock("mesh = \"" + file + "\", base = -5"));
            checkSameBlocks(model, moved.model);
            CHECK(mentions(moved.warnings, "[451200, 5412300, 0] is subtracted"));
            const Scenario told =
                readGood(rock("mesh = \"" + file + "\", base = -5, shift = [451200, 5412300, 0]"));
            checkSameBlocks(model, told.model);
            CHECK_FALSE(mentions(told.warnings, "subtracted"));
        }
        const Model half =
            readGood(rock("obj = \"" + folder.write("a.obj", obj(s)) + "\", base = -5, scale = 0.5")).model;
        CHECK(half.blocks.size() < model.blocks.size());
    }
}

TEST_CASE("terrain files: repairs, turned and simplified surfaces are reported, and very small blocks") {
    const TemporaryFolder folder;
    const std::vector<double> z = heights(Ground::rough, kN);
    TriangleSurface s = terrainOf(z, kN);
    const std::string whole = folder.write("whole.obj", obj(s));
    for (auto& t : s.triangles) std::swap(t[0], t[1]);
    s.vertices.push_back(s.vertices[40] + Vec3(0, 0, 4e-6));
    s.triangles[60][0] = s.triangles[60][0] == 40 ? 81 : s.triangles[60][0];
    for (auto& t : s.triangles)
        if (std::find(t.begin(), t.end(), 40) != t.end()) {
            std::replace(t.begin(), t.end(), 40, 81);
            break;
        }
    const Scenario turned = readGood(rock("obj = \"" + folder.write("t.obj", obj(s)) + "\", base = -5"));
    CHECK(mentions(turned.warnings,
                   "t.obj was repaired within 1.6e-05 m: 1 duplicate vertex, 0 T-junctions, 0 triangles"));
    CHECK(mentions(turned.warnings, "t.obj was turned over, because all its triangles face down"));
    CHECK(
        readBad(rock("obj = \"" + folder.write("t.obj", obj(s)) + "\", base = -5, tolerance = 1e-6")).size() >
        0);

    const Scenario rough = readGood(rock("obj = \"" + whole + "\", base = -5"));
    CHECK(
        mentions(rough.warnings, "blocks at the surface are smaller than a thousandth of the median block"));
    CHECK(mentions(rough.warnings, "; simplify = "));
    const Scenario smooth = readGood(rock("obj = \"" + whole + "\", base = -5, simplify = 0.4"));
    CHECK(mentions(smooth.warnings, "was simplified from 128 to "));
    std::size_t before = 0, after = 0;
    for (const Block& block : rough.model.blocks) before += block.shape.partCount();
    for (const Block& block : smooth.model.blocks) after += block.shape.partCount();
    CHECK(after < before);
}

TEST_CASE("terrain files: faults have their line, their triangle and their place") {
    const TemporaryFolder folder;
    const TriangleSurface good = terrainOf(Ground::hill, kN);
    TriangleSurface hole = good;
    hole.triangles.erase(hole.triangles.begin() + 55);
    CHECK(has(fault(folder.write("h.obj", obj(hole)), onBase(-5)), "h.obj:"));
    CHECK(has(fault(folder.write("h.obj", obj(hole)), onBase(-5)), "found a hole with 3 edges about ("));
    TriangleSurface flipped = good;
    std::swap(flipped.triangles[55][0], flipped.triangles[55][1]);
    // 81 lines of vertices before the faces; triangle 56 is on line 137.
    CHECK(
        has(fault(folder.write("f.obj", obj(flipped)), onBase(-5)),
            "f.obj:137: error: triangle 56: found triangles that face opposite ways along the edge from ("));
    TriangleSurface crossing = good;
    crossing.vertices[vertexAt(good, 6, 10)] += Vec3(5.2, 0.3, -0.9);
    crossing.vertices[vertexAt(good, 12, 10)].z() -= 6;
    const std::string text = fault(folder.write("c.obj", obj(crossing)), onBase(-5));
    CHECK(has(text, "found a surface that crosses itself: this triangle and triangle "));
    CHECK(has(text, " (line "));
    CHECK(has(text, "meet near ("));
    CHECK(has(fault(folder.write("o.obj", obj(good)), {}),
              "for an open terrain give the elevation of its base"));
    const auto low = readMesh(folder.write("o.obj", obj(good)), onBase(3));
    REQUIRE_FALSE(low.ok());
    CHECK(low.errors()[0].field == "base");
    const auto errors = readBad(rock("obj = \"" + folder.write("o.obj", obj(good)) + "\", base = 3"));
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].field == "rock_mass.region.base");
    CHECK(errors[0].line == 8);
    CHECK(has(errors[0].message, "found 3, allowed: below the terrain, whose lowest point is (0, 0, "));
    CHECK(readBad(rock("box = { min = [0, 0, 0], max = [1, 1, 1] }, base = 3"))[0].field ==
          "rock_mass.region.base");
}

TEST_CASE("terrain files: grids may lack heights at their rim, not inside; their faults have lines") {
    const TemporaryFolder folder;
    std::vector<double> z = heights(Ground::hill, kN);
    const double volume =
        surfaceVolume(readMesh(folder.write("a.asc", asc(z, kN, Vec3::Zero())), onBase(-5))->surface);
    z[0] = -9999;
    const auto less =
        readMesh(folder.write("b.asc", asc(z, kN, Vec3::Zero(), "nodata_value -9999\n")), onBase(-5));
    REQUIRE(less.ok());
    CHECK(surfaceVolume(less->surface) < volume - 15);
    z[40] = -9999;
    CHECK(has(fault(folder.write("c.asc", asc(z, kN, Vec3::Zero(), "nodata_value -9999\n")), onBase(-5)),
              "found a hole with 8 edges about (8, 8, "));
    const auto bad = [&](const std::string& content, const std::string& words) {
        const std::string text = fault(folder.write("x.asc", content), onBase(-5));
        CHECK_MESSAGE(has(text, words), text, " lacks ", words);
    };
    const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    bad(head + "1 2\n3 x\n", "x.asc:7: error: found \"x\", allowed: finite heights");
    bad(head + "1 2\n3\n", "found 3 heights, allowed: ncols times nrows, 4");
    bad(head + "1 2\n3 4 5\n", "x.asc:7: error: found more heights than ncols times nrows, allowed: 4");
    bad("ncols 2\nnrows 2\nxllcorner 0\ncellsize 1\n1 2\n3 4\n",
        "x.asc:5: error: found no yllcorner before the heights");
    bad("ncols 2\nnrow 2\n", "x.asc:2: error: found \"nrow\", did you mean \"nrows\"?");
    bad("ncols two\n", "x.asc:1: error: found \"two\" behind ncols");
    bad("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2 3 4\n", "found a cell without a size");
    bad("", "found no heights");
}

TEST_CASE("terrain files: binary STL far from the origin says how few digits it has") {
    const TemporaryFolder folder;
    const TriangleSurface far = terrainOf(heights(Ground::hill, kN), kN, Vec3(451200, 5412300, 0));
    std::string bytes(80, ' ');
    const auto append = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(static_cast<std::uint32_t>(far.triangles.size()));
    for (const auto& t : far.triangles) {
        for (int k = 0; k < 3; ++k) append(0.0f);
        for (const std::int32_t v : t)
            for (const double c : far.vertices[static_cast<std::size_t>(v)]) append(static_cast<float>(c));
        append(std::uint16_t{0});
    }
    const auto mesh = readMesh(folder.write("far.stl", bytes), onBase(-5));
    if (mesh) CHECK(mentions(mesh->notes, "coordinates of seven digits, which at 5.41232e+06 m are 0.6"));
    REQUIRE(mesh.ok());
}

}  // namespace talus::formats
