// Points thinned to a height grid: every separator, means and medians by hand, holes and loose cells told.

#include <doctest/doctest.h>

#include <algorithm>

#include "../scenario/faults.h"
#include "support/files.h"
#include "support/surface_texts.h"
#include "talus/formats/mesh.h"

namespace talus::formats {

namespace {

using namespace talus::test;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

MeshOptions cellsOf(double side, bool median = false) {
    MeshOptions options;
    options.cell = side;
    options.median = median;
    options.base = -1;
    return options;
}

MeshSurface readGoodPoints(const std::string& text, const MeshOptions& options) {
    auto mesh = parseMesh(text, "p.xyz", options);
    for (const Error& error : mesh.errors()) FAIL_CHECK(format(error));
    REQUIRE(mesh.ok());
    return std::move(*mesh);
}

std::string fault(const std::string& text, const MeshOptions& options) {
    const auto mesh = parseMesh(text, "p.xyz", options);
    REQUIRE_FALSE(mesh.ok());
    return format(mesh.errors()[0]);
}

double heightAt(const TriangleSurface& surface, double x, double y) {
    for (const Vec3& v : surface.vertices)
        if (v.x() == x && v.y() == y && v.z() != -1) return v.z();
    FAIL("no vertex there");
    return 0;
}

/// One point in the middle of each cell of 1 m, but for some. \param of  whether there is one
template <class Of>
std::string pointsWhere(int n, const Of& of) {
    std::string text;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            if (of(i, j)) text += std::to_string(i) + ".5 " + std::to_string(j) + ".5 0\n";
    return text;
}

}  // namespace

TEST_CASE("points: mean and median of each cell, with any separator and header") {
    // Cells of 2 m from -2 on: heights 1, 2 and 6 in the south-western one, one point in each other.
    const std::string texts[] = {
        "-1.5 -1.5 1\n-0.5 -0.5 2 255 0 0\n-1 -1 6\n1 -1 4\n-1 1 5\n1 1 0\n",
        "# survey\nX,Y,Z,intensity\n-1.5,-1.5,1,9\n-0.5,-0.5,2,9\n-1,-1,6,9\n1,-1,4,9\n-1,1,5,9\n1,1,0,9\n",
        "Height;Easting;Northing\n1;-1,5;-1,5\n2;-0,5;-0,5\n6;-1;-1\n4;1;-1\n5;-1;1\n0;1;1\n",
        "// a cloud\n-1.5,-1.5,1\n-0.5,-0.5,2\n-1,-1,6\n1,-1,4\n-1,1,5\n1,1,0\n",
        "//X\tY\tZ\r\n-1.5\t-1.5\t1\r\n-0.5\t-0.5\t2\r\n-1\t-1\t6\r\n1\t-1\t4\r\n-1\t1\t5\r\n1\t1\t0\r\n"};
    for (const std::string& text : texts) {
        CAPTURE(text);
        const MeshSurface mean = readGoodPoints(text, cellsOf(2)),
                          median = readGoodPoints(text, cellsOf(2, true));
        CHECK(heightAt(mean.surface, -1, -1) == 3);
        CHECK(heightAt(median.surface, -1, -1) == 2);
        for (const MeshSurface& read : {mean, median}) {
            CHECK(heightAt(read.surface, 1, -1) == 4);
            CHECK(heightAt(read.surface, -1, 1) == 5);
            CHECK(heightAt(read.surface, 1, 1) == 0);
            REQUIRE(read.notes.size() == 1);
        }
        // Along the diagonal whose ends differ less: 4 and 5.
        CHECK(surfaceVolume(mean.surface) ==
              doctest::Approx(4 * (1 + (3 + 2 * 4 + 2 * 5 + 0) / 6.0)).epsilon(1e-14));
        CHECK(mean.notes[0] ==
              "p.xyz was thinned from 6 points to a grid of 2 x 2 cells, each with the mean height of its "
              "points");
    }
    MeshOptions options = cellsOf(2);
    options.scale = 2;
    options.cell = 4;
    CHECK(heightAt(readGoodPoints(texts[0], options).surface, -2, -2) == 6);
}

TEST_CASE("points: a median of an even number of heights is the mean of the middle ones") {
    const std::string text = "0 0 9\n0.1 0 1\n0 0.1 3\n0.1 0.1 5\n1 0 0\n0 1 0\n1 1 0\n";
    CHECK(heightAt(readGoodPoints(text, cellsOf(1, true)).surface, 0.5, 0.5) == 4);
}

TEST_CASE("points: cells without points are reported; holes are refused, or closed on request") {
    const std::string text = pointsWhere(6, [](int i, int j) { return i != 2 || j != 3; });
    CHECK(has(fault(text, cellsOf(1)), "found a hole with 8 edges about (2.5, 3.5, 0)"));
    MeshOptions options = cellsOf(1);
    options.mend = true;
    options.largest_hole = 2;
    const MeshSurface closed = readGoodPoints(text, options);
    CHECK(surfaceVolume(closed.surface) == doctest::Approx(25).epsilon(1e-12));
    CHECK(has(closed.notes[0], "; 1 cell has no point, the first at (2.5, 3.5)"));
    CHECK(has(closed.notes[1], "1 hole closed, at (2.5, 3.5, 0) (8 edges, 2 m wide)"));
    // At the rim there is no hole.
    const std::string rim = pointsWhere(6, [](int i, int j) { return i != 0 || j != 0; });
    CHECK(surfaceVolume(readGoodPoints(rim, cellsOf(1)).surface) == doctest::Approx(24).epsilon(1e-12));
}

TEST_CASE("points: pieces that touch the largest one at a corner, or lie apart, are left out and reported") {
    // 4 x 4 cells, 3 x 3 at its corner, which share one cell; and two cells far off.
    const std::string text = pointsWhere(20, [](int i, int j) {
        return (i < 4 && j < 4) || (i >= 3 && i < 6 && j >= 3 && j < 6) || (i == 15 && j < 2);
    });
    const MeshSurface read = readGoodPoints(text, cellsOf(1));
    CHECK(surfaceVolume(read.surface) == doctest::Approx(9).epsilon(1e-12));
    REQUIRE(read.notes.size() == 2);
    CHECK(has(read.notes[1], "10 cells that touch the others at a corner, or not at all, and are left out"));
}

TEST_CASE("points: faults name line, column, what was found and what is allowed") {
    CHECK(has(fault("1 2 3\n4 x 6\n", cellsOf(1)),
              "p.xyz:2:3: error: found \"x\" for y, allowed: x, y and z of a point, finite numbers"));
    CHECK(has(fault("1,2,3\n4,5\n", cellsOf(1)), "p.xyz:2: error: found 2 columns, allowed: x, y and z"));
    CHECK(has(fault("x,y,depth\n1,2,3\n", cellsOf(1)),
              "p.xyz:1: error: found columns \"x,y,depth\", allowed: x, y and z"));
    CHECK(has(fault("", cellsOf(1)), "p.xyz: error: found no points"));
    CHECK(has(fault("0 0 0\n1 0 0\n0 1 0\n", cellsOf(1)), "found no four neighbouring cells"));
    CHECK(has(fault("0 0 0\n1e9 1e9 0\n", cellsOf(1)),
              "found 2 points over 1.000000002e+18 cells, allowed: at most 10200; a larger cell"));
    CHECK(has(fault("0 0 0\n1e300 0 0\n", cellsOf(1e-300)), "allowed: at most 10200"));
    CHECK(has(fault("0 0 0\n", {}), "cell_m: found points without a cell size"));

    const TemporaryFolder folder;
    const std::string file = folder.write("p.txt", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n");
    const auto region = [&](const std::string& keys) {
        return properties() + "[rock_mass]\nregion = { xyz = \"" + file + "\", base = -5" + keys +
               " }\n[[joint_set]]\ndip_deg = 30\ndip_direction_deg = 265\nspacing = 3\n";
    };
    CHECK(readGood(region(", cell_m = 1, cell_height = \"median\"")).model.blocks.size() > 0);
    checkFault({region(""), 8, "rock_mass.region.cell_m", "found points without a cell size"});
    checkFault({region(", cell_m = 0"), 8, "rock_mass.region.cell_m", "greater than 0"});
}

}  // namespace talus::formats
