// Water of good scenarios: levels, and the walls it pushes on.

#include <algorithm>
#include <set>

#include "scenario_texts.h"
#include "support/files.h"

namespace talus::formats {

namespace {

Model modelOf(const std::string& text) { return readGood(text).model; }

/// A 3 x 2 x 2 stack of 0.2 x 0.1 x 0.05 m blocks with one water.
Model watered(const std::string& keys, const std::string& stack_keys = "") {
    return modelOf(properties() + stack(stack_keys) + "[[water]]\n" + keys);
}

/// The walls as "c1r1s1+x", sorted.
std::vector<std::string> wallsOf(const Model& model, std::size_t water = 0) {
    std::vector<std::string> walls;
    for (const WetFace& wall : model.waters.at(water).walls) {
        const Block& block = model.blocks.at(static_cast<std::size_t>(wall.block));
        const Vec3 normal = block.shape.faceNormal(static_cast<std::size_t>(wall.face));
        Eigen::Index axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        walls.push_back(block.name + (normal[axis] > 0 ? "+" : "-") + "xyz"[axis]);
    }
    std::sort(walls.begin(), walls.end());
    return walls;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("scenario water: both walls of a stack's joint") {
    const Model model = watered("fissure = 1\ndepth = 0.08\n");
    REQUIRE(model.waters.size() == 1);
    CHECK(wallsOf(model) == Names{"c1r1s1+x", "c1r1s2+x", "c1r2s1+x", "c1r2s2+x", "c2r1s1-x", "c2r1s2-x",
                                  "c2r2s1-x", "c2r2s2-x"});
    const Water& water = model.waters[0];
    for (const WetFace& wall : water.walls) {
        const Block& block = model.blocks[static_cast<std::size_t>(wall.block)];
        for (const std::int32_t vertex : block.shape.faces[static_cast<std::size_t>(wall.face)])
            CHECK(block.shape.vertices[static_cast<std::size_t>(vertex)].x() == doctest::Approx(0.2));
    }
    CHECK(water.kind == Water::Level::depth);
    REQUIRE(water.level.size() == 1);
    CHECK(water.level[0].value == 0.08);
    CHECK(water.base == 0);
    CHECK(water.density == 1000);
    CHECK(water.drains_at_aperture == kInfinity);
    CHECK_FALSE(water.pair.has_value());
    CHECK(water.field == "water[0]");
}

TEST_CASE("scenario water: the toe's and the back's free face") {
    CHECK(wallsOf(watered("fissure = 0\ndepth = 0.08\n")) ==
          Names{"c1r1s1-x", "c1r1s2-x", "c1r2s1-x", "c1r2s2-x"});
    CHECK(wallsOf(watered("fissure = 3\ndepth = 0.08\n")) ==
          Names{"c3r1s1+x", "c3r1s2+x", "c3r2s1+x", "c3r2s2+x"});
}

TEST_CASE("scenario water: beside a lower column it pushes on the free face above") {
    const Model model =
        watered("fissure = 1\ndepth = 0.08\nbase = 0.06\n", "heights = [1, 2, 2]\norigin = [5, 6, 7]\n");
    CHECK(wallsOf(model) == Names{"c1r1s1+x", "c1r1s2+x", "c2r1s1-x", "c2r1s2-x", "c2r2s1-x", "c2r2s2-x"});
    CHECK(model.waters[0].base == doctest::Approx(7.06));
}

TEST_CASE("scenario water: other ways to give the level") {
    const Water elevation =
        watered("fissure = 1\nelevation = -0.5\ndensity = 1025\ndrains_at_aperture = 0.001\n").waters[0];
    CHECK(elevation.kind == Water::Level::elevation);
    CHECK(elevation.level.at(0).value == -0.5);
    CHECK(elevation.density == 1025);
    CHECK(elevation.drains_at_aperture == 0.001);

    const Water levels = watered("fissure = 1\nlevels = [[0, 0.1], [1.5, 0], [2, 0.3]]\n").waters[0];
    CHECK(levels.kind == Water::Level::depth);
    REQUIRE(levels.level.size() == 3);
    CHECK(levels.level[1].time == 1.5);
    CHECK(levels.level[1].value == 0);
    CHECK(levels.level[2].time == 2);
    CHECK(levels.level[2].value == 0.3);

    const Water elevations = watered("fissure = 1\nelevations = [[0, -0.1], [1.5, 0.3]]\n").waters[0];
    CHECK(elevations.kind == Water::Level::elevation);
    REQUIRE(elevations.level.size() == 2);
    CHECK(elevations.level[0].value == -0.1);
    CHECK(elevations.level[1].time == 1.5);
    CHECK(elevations.level[1].value == 0.3);
}

TEST_CASE("scenario water: the stack meant, by name") {
    const std::string two =
        properties() + stack("name = \"a\"\n") +
        stack("name = \"b\"\norigin = [0, 9, 1]\n", "columns = 2\nrows = 1\nslices = 1\n");
    const Model model = modelOf(two + "[[water]]\nstack = \"b\"\nfissure = 2\ndepth = 0.01\n");
    CHECK(wallsOf(model) == Names{"bc2r1s1+x"});
    CHECK(model.waters[0].base == 1);
}

TEST_CASE("scenario water: on the interface of two blocks") {
    const Model model = watered("between = [\"c2r1s1\", \"floor\"]\nhead = [0.3, 0]\n");
    const Water& water = model.waters[0];
    CHECK(water.kind == Water::Level::head);
    CHECK(water.head == std::array<double, 2>{0.3, 0});
    CHECK(water.level.empty());
    CHECK(water.walls.empty());
    CHECK(water.base == -kInfinity);
    REQUIRE(water.pair.has_value());
    CHECK(model.blocks[static_cast<std::size_t>(water.pair->first)].name == "c2r1s1");
    CHECK(model.blocks[static_cast<std::size_t>(water.pair->second)].name == "floor");
    CHECK(watered("between = [\"c2r1s1\", \"floor\"]\ndepth = 0.1\n").waters[0].kind == Water::Level::depth);
}

TEST_CASE("scenario water: on one face of a block") {
    const auto wallOf = [](const std::string& face) {
        return wallsOf(watered("block = \"c2r1s1\"\nface = \"" + face + "\"\ndepth = 0.01\n")).at(0);
    };
    for (const std::string face : {"+x", "-x", "+y", "-y", "+z", "-z"})
        CHECK(wallOf(face) == "c2r1s1" + face);
    CHECK(watered("block = \"c2r1s1\"\nface = \"+x\"\ndepth = 0.01\n").waters[0].base == -kInfinity);

    // A wedge's slanting face (normal 1, 0, 2) is the one nearest to +z, and the only one nearest to +x.
    const Model wedge =
        modelOf(properties() +
                "[[block]]\nname = \"wedge\"\nvertices = [[0, 0, 0], [2, 0, 0], [0, 0, 1], [0, 1, 0], "
                "[2, 1, 0], [0, 1, 1]]\n"
                "[[water]]\nblock = \"wedge\"\nface = \"+z\"\ndepth = 0.01\n");
    const WetFace wall = wedge.waters[0].walls.at(0);
    const Vec3 normal = wedge.blocks[0].shape.faceNormal(static_cast<std::size_t>(wall.face));
    CHECK(normal.dot(Vec3(1, 0, 2).normalized()) == doctest::Approx(1));
}

TEST_CASE("scenario water: a table of triangles from a file, and what is wrong with one") {
    const test::TemporaryFolder folder;
    folder.write("table.obj", "v -9 -9 4\nv 9 -9 4\nv 9 9 5\nv -9 9 5\nf 1 2 3 4\n");
    folder.write("broken.obj", "v -9 -9 4\nv 9 -9 4\nf 1 2 7\n");
    const auto read = [&](const std::string& keys) {
        return parseScenario(properties() + stack() + "[[water]]\n" + keys, folder / "slope.toml");
    };
    const auto good = read("obj = \"table.obj\"\nfactor = 0.9\n");
    REQUIRE(good.ok());
    REQUIRE(good->model.phreatic);
    CHECK(good->model.phreatic->mesh.triangles.size() == 2);
    CHECK(good->model.phreatic->line.empty());
    CHECK(good->model.phreatic->factor == 0.9);
    for (const char* wrong : {"obj = \"none.obj\"\n", "obj = \"broken.obj\"\n"}) {
        const auto bad = read(wrong);
        REQUIRE_FALSE(bad.ok());
        CHECK(bad.errors()[0].field == "water[0].obj");
    }
    CHECK_FALSE(read("obj = \"table.obj\"\ndepth = 1\n").ok());
    CHECK_FALSE(read("obj = \"table.obj\"\nsurface = [[0, 1], [1, 1]]\n").ok());
    CHECK_FALSE(read("fissure = 1\ndepth = 0.1\ndaylights = \"straight\"\n").ok());
}

TEST_CASE("scenario water: a closed volume and what flows into it") {
    const std::string closed = "fissure = 1\ndepth = 0.05\nvolume = \"closed\"\nopening = 0.002\n";
    Water water = watered(closed).waters[0];
    CHECK(water.closed);
    CHECK(water.opening == 0.002);
    CHECK(water.inflow.empty());
    CHECK(water.overflow == kInfinity);
    water = watered(closed + "inflow = 1e-4\noverflow = 0.08\n").waters[0];
    REQUIRE(water.inflow.size() == 1);
    CHECK(water.inflow[0].value == 1e-4);
    CHECK(water.overflow == 0.08);
    water = watered(closed + "inflow = [[0, 0], [2, 1e-3]]\n").waters[0];
    REQUIRE(water.inflow.size() == 2);
    CHECK(water.inflow[1].time == 2);
    CHECK(water.inflow[1].value == 1e-3);
    CHECK_FALSE(watered("fissure = 1\ndepth = 0.05\nvolume = \"held\"\n").waters[0].closed);
    water = watered(closed +
                    "rain = [[0, 36], [60, 0]]\ncatchment = 12.5\nleak_aperture = 2e-4\n"
                    "leak_length = 4\n")
                .waters[0];
    REQUIRE(water.rain.size() == 2);
    CHECK(water.rain[0].value == doctest::Approx(1e-5));  // 36 mm/h in m/s
    CHECK(water.rain[1].time == 60);
    CHECK(water.catchment == 12.5);
    CHECK(water.leak_aperture == 2e-4);
    CHECK(water.leak_length == 4);
}

}  // namespace talus::formats
