// [rock_mass], [[joint_set]], [[single_joint]]: what they mean, and what is refused, where.

#include <algorithm>
#include <set>

#include "scenario_texts.h"
#include "talus/simulation.h"

namespace talus::formats {

namespace {

/// Six lines of properties, then [rock_mass] on line 7 and its region on line 8.
std::string rockMass(const std::string& more,
                     const std::string& region = "box = { min = [0, 0, 0], max = [4, 2, 3] }") {
    return properties() + "[rock_mass]\nregion = { " + region + " }\n" + more;
}

std::string grid() {
    return "[[joint_set]]\nname = \"across\"\ndip_deg = 90\ndip_direction_deg = 90\nspacing = 1\n"
           "[[joint_set]]\nname = \"along\"\ndip_deg = 90\ndip_direction_deg = 0\nspacing = 1\n"
           "[[joint_set]]\nname = \"beds\"\ndip_deg = 0\ndip_direction_deg = 0\nspacing = 1\n";
}

std::size_t fixedCount(const Model& model) {
    return static_cast<std::size_t>(std::count_if(model.blocks.begin(), model.blocks.end(),
                                                  [](const Block& b) { return b.motion == Motion::fixed; }));
}

void checkFault(const std::string& text, int line, const std::string& field, const std::string& fragment) {
    CAPTURE(text);
    const auto errors = readBad(text);
    CAPTURE(all(errors));
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].field == field);
    CHECK(errors[0].line == line);
    CHECK(errors[0].column >= 1);
    CHECK_MESSAGE(errors[0].message.find(fragment) != std::string::npos, errors[0].message, " lacks ",
                  fragment);
}

}  // namespace

TEST_CASE("rock mass: blocks, names, strengths by joint") {
    const Scenario scenario =
        readGood(rockMass("names = { key = [3.5, 1.5, 2.5] }\nfixed = [{ boundary = \"-z\" }]\n" + grid() +
                          joint("beds", "friction_deg = 20") + "[run]\nwatch = [\"b1\", \"key\"]\n"));
    const Model& model = scenario.model;
    REQUIRE(model.blocks.size() == 24);
    CHECK(scenario.warnings.empty());
    CHECK(model.blocks[0].name == "b1");
    CHECK(model.blocks[22].name == "b23");
    CHECK(model.blocks[23].name == "key");
    CHECK(fixedCount(model) == 8);
    CHECK(model.blocks[7].motion == Motion::fixed);
    // A joint set takes the strength of its own name, if there is one.
    for (const Block& block : model.blocks)
        for (std::size_t f = 0; f < block.shape.faces.size(); ++f) {
            const double z = block.shape.faceCentroid(f).z();
            const bool on_bed = std::abs(block.shape.faceNormal(f).z()) > 0.9 && z > 0.5 && z < 2.5;
            CHECK(block.face_joint[f] == (on_bed ? 1 : 0));
        }
    CHECK(checkModel(model).empty());
}

TEST_CASE("rock mass: stands beside stacks and blocks, behind them") {
    const Scenario scenario =
        readGood(rockMass("name = \"rock\"\n", "box = { min = [10, 0, 0], max = [11, 1, 1] }") + stack() +
                 block("key", "") + "[[interface]]\nbetween = [\"key\", \"rockb1\"]\njoint = \"default\"\n");
    CHECK(scenario.model.blocks.back().name == "rockb1");
    CHECK(scenario.model.blocks.size() == 15);
    CHECK(scenario.model.pair_joints.back().block_b == 14);
    CHECK_FALSE(scenario.model.stack.has_value());
}

TEST_CASE("rock mass: selections of fixed blocks") {
    const auto fixed = [](const std::string& selections, const std::string& more = "") {
        return fixedCount(readGood(rockMass("fixed = [" + selections + "]\n" + grid() + more)).model);
    };
    CHECK(fixed("{ box = { min = [0, 0, 0], max = [1, 2, 3] } }") == 6);
    CHECK(fixed("{ plane = { point = [0, 0, 1], dip_deg = 0, dip_direction_deg = 0 } }") == 8);
    CHECK(fixed("{ plane = { point = [0, 0, 1], dip_deg = 0, dip_direction_deg = 0 }, side = \"above\" }") ==
          16);
    CHECK(
        fixed(
            "{ plane = { point = [2, 0, 0], dip_deg = 90, dip_direction_deg = 90 }, side = \"touching\" }") ==
        12);
    CHECK(fixed("{ name = \"b3\" }, { boundary = \"+x\" }") == 7);
    CHECK(fixed("{ joint = \"J\" }",
                "[[single_joint]]\nname = \"J\"\npoint = [0, 0, 2]\ndip_deg = 0\ndip_direction_deg = 0\n") ==
          16);
}

TEST_CASE("rock mass: water stands on the faces a joint made") {
    const Model all = readGood(rockMass(grid() + "[[water]]\njoint = \"across\"\nelevation = 2\n")).model;
    CHECK(all.waters.at(0).walls.size() == 2 * 3 * 2 * 3);
    const Model one =
        readGood(rockMass(grid() + "[[water]]\njoint = \"across\"\nplane = 2\ndepth = 1.5\nbase = 1\n"))
            .model;
    REQUIRE(one.waters.at(0).walls.size() == 2 * 2 * 3);
    CHECK(one.waters[0].base == 1);
    for (const WetFace& wall : one.waters[0].walls)
        CHECK(one.blocks[static_cast<std::size_t>(wall.block)]
                  .shape.faceCentroid(static_cast<std::size_t>(wall.face))
                  .x() == doctest::Approx(2));
    CHECK(checkModel(one).empty());
}

TEST_CASE("rock mass: a closed volume of water stands in one plane, and does not drain of itself") {
    const std::string closed = "[[water]]\njoint = \"across\"\nvolume = \"closed\"\nopening = 0.01\n";
    const Model model = readGood(rockMass(grid() + closed + "plane = 2\ndepth = 1.5\n")).model;
    CHECK(model.waters.at(0).closed);
    CHECK(model.waters[0].drains_at_aperture == kInfinity);
    CHECK(checkModel(model).empty());
    const auto all = parseScenario(rockMass(grid() + closed + "elevation = 2\n"), "slope.toml");
    REQUIRE(all.errors().size() == 1);
    CHECK(all.errors()[0].field == "water[0].joint");
    CHECK(all.errors()[0].message ==
          "found a closed volume in all planes of the joint set \"across\", allowed: plane = NUMBER for one "
          "of them");
}

TEST_CASE("rock mass: a block that is not convex is one block of several parts") {
    const Model model =
        readGood(rockMass("names = { toe = [1.1, 0.5, 0.9] }\n",
                          "profile = [[0, 0], [2, 0], [2, 2], [1, 2], [1, 1], [0, 1]], y = [0, 1]"))
            .model;
    REQUIRE(model.blocks.size() == 1);
    CHECK(model.blocks[0].name == "toe");
    CHECK(model.blocks[0].shape.partCount() == 2);
    CHECK(massProperties(model.blocks[0].shape).volume == doctest::Approx(3).epsilon(1e-14));
    CHECK(model.pair_joints.empty());
    CHECK(model.joints.size() == 1);
    CHECK(checkModel(model).empty());
}

TEST_CASE("rock mass: faults of the region") {
    const auto fault = [](const std::string& region, const std::string& field, const std::string& fragment) {
        checkFault(rockMass("", region), 8, "rock_mass.region" + field, fragment);
    };
    fault("", ".box", "missing; one of these is required: box, profile, mesh, stl, obj, ply, asc");
    fault("box = { min = [0, 0, 0], max = [1, 1, 0] }", ".box", "min must be below max");
    fault("profile = [[0, 0], [1, 0], [0, 1]]", ".y", "missing");
    fault("profile = [[0, 0], [1, 0], [0, 1]], y = [1, 0]", ".y",
          "found 1 to 0, allowed: the smaller one first");
    fault("profile = [[0, 0], [1, 1], [1, 0], [0, 1]], y = [0, 1]", ".profile[2]",
          "meets the one behind point [0]");
    fault("stl = \"none.stl\"", ".stl", "none.stl: error: cannot be opened");
    fault("stl = 3", ".stl", "found an integer 3, allowed: a string");
    fault("bx = 3", ".bx", "did you mean \"box\"?");
    checkFault(properties() + "[rock_mass]\n", 7, "rock_mass.region", "missing");
    checkFault("rock_mass = 3\n" + properties(), 1, "rock_mass", "found an integer 3, allowed: a table");
    checkFault(properties() + stack() + "[[joint_set]]\n", 12, "joint_set", "without [rock_mass]");
}

TEST_CASE("rock mass: faults of joints") {
    const auto set = [](const std::string& more, int line, const std::string& field,
                        const std::string& fragment) {
        checkFault(rockMass("[[joint_set]]\ndip_deg = 30\ndip_direction_deg = 0\n" + more), line,
                   "joint_set[0]" + field, fragment);
    };
    set("spacing = 0\n", 12, ".spacing", "found 0, allowed: greater than 0");
    set("", 9, ".spacing", "missing");
    set("spacing = 1e-9\n", 12, ".spacing", "planes through the region");
    set("spacing = 1\nspacing_spread = 0.1\n", 13, ".spacing_spread", "only with spacing_law = \"uniform\"");
    set("spacing = 1\njoint = \"defualt\"\n", 13, ".joint", "did you mean \"default\"?");
    set("spacing = 1\ndip = 3\n", 13, ".dip", "unknown key");
    const auto single = [](const std::string& keys, int line, const std::string& field,
                           const std::string& fragment) {
        checkFault(rockMass("[[single_joint]]\n" + keys), line, "single_joint[0]" + field, fragment);
    };
    single("point = [0, 0, 1]\ndip_deg = 91\ndip_direction_deg = 0\n", 11, ".dip_deg",
           "found 91, allowed: at least 0");
    single("polygon = [[0, 0, 0], [1, 0, 0]]\n", 10, ".polygon", "found 2 corners");
    single("polygon = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]]\n", 10, ".polygon[1]", "off the plane");
    single("polygon = [[0, 0, 1], [1, 0, 1], [1, 1, 1]]\nradius = 2\n", 11, ".radius",
           "together with polygon");
}

TEST_CASE("rock mass: slivers can be refused") {
    const std::string sliver = "[[single_joint]]\npoint = [0, 0, 1e-5]\ndip_deg = 0\ndip_direction_deg = 0\n";
    CHECK(readGood(rockMass(sliver)).warnings.size() == 1);
    checkFault(rockMass("slivers = \"refuse\"\n" + sliver), 10, "single_joint[0]", "1e-05 m thick");
    CHECK(readGood(rockMass("min_thickness = 1e-6\n" + sliver)).model.blocks.size() == 2);
}

TEST_CASE("rock mass: selections and names that find no block") {
    const auto fixed = [](const std::string& selection, const std::string& field,
                          const std::string& fragment) {
        checkFault(rockMass("fixed = [" + selection + "]\n" + grid()), 9, "rock_mass.fixed[0]" + field,
                   fragment);
    };
    fixed("{ box = { min = [5, 0, 0], max = [6, 1, 1] } }", "", "cut away");
    fixed("{ plane = { point = [0, 0, 0.5], dip_deg = 0, dip_direction_deg = 0 } }", "",
          "cut it differently, or it was cut away");
    fixed("{ name = \"b25\" }", ".name", "found the unknown block \"b25\", allowed: \"b1\" to \"b24\"");
    fixed("{ joint = \"beds\" }", ".joint", "found the joint set \"beds\", allowed: a single joint");
    fixed("{ joint = \"bed\" }", ".joint", "did you mean \"beds\"?");
    fixed("{ boundary = \"up\" }", ".boundary", "allowed: \"-x\"");
    fixed("{ side = \"above\" }", ".box", "missing; one of these is required");
    checkFault(rockMass("names = { key = [0, 0, 9] }\n"), 9, "rock_mass.names.key",
               "found a point outside every block");
    checkFault(rockMass("names = { a = [1, 1, 1], b = [2, 1, 1] }\n"), 9, "rock_mass.names.b",
               "named \"a\" already");
}

TEST_CASE("rock mass: faults of water in joints") {
    const auto water = [](const std::string& keys, const std::string& field, const std::string& fragment) {
        checkFault(rockMass(grid() + "[[water]]\n" + keys), 25, "water[0]" + field, fragment);
    };
    water("joint = \"acros\"\nelevation = 1\n", ".joint", "did you mean \"across\"?");
    water("joint = \"across\"\ndepth = 1\n", ".joint", "allowed: elevation, or plane = NUMBER");
    checkFault(properties() + stack() + "[[water]]\njoint = \"J\"\ndepth = 1\n", 13, "water[0].joint",
               "without [rock_mass]");
    checkFault(properties() + stack() + "[[water]]\nfissure = 1\nplane = 2\ndepth = 0.01\n", 14,
               "water[0].plane", "found plane without joint");
}

}  // namespace talus::formats
