// Stacks and hand-placed blocks: names, places, joints, block by block.

#include <algorithm>
#include <map>
#include <set>

#include "scenario_texts.h"

namespace talus::formats {

namespace {

Model modelOf(const std::string& text) { return readGood(text).model; }

const Block& blockOf(const Model& model, const std::string& name) {
    const auto found = std::find_if(model.blocks.begin(), model.blocks.end(),
                                    [&](const Block& block) { return block.name == name; });
    REQUIRE_MESSAGE(found != model.blocks.end(), "no block ", name);
    return *found;
}

struct Extent {
    Vec3 min, max;
};

Extent extentOf(const Block& block) {
    Extent extent{Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
    for (const Vec3& vertex : block.shape.vertices) {
        extent.min = extent.min.cwiseMin(vertex);
        extent.max = extent.max.cwiseMax(vertex);
    }
    return extent;
}

void checkExtent(const Block& block, const Vec3& min, const Vec3& max) {
    CAPTURE(block.name);
    const Extent extent = extentOf(block);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        CHECK(extent.min[axis] == doctest::Approx(min[axis]).epsilon(1e-14).scale(1));
        CHECK(extent.max[axis] == doctest::Approx(max[axis]).epsilon(1e-14).scale(1));
    }
}

/// Name of the joint of the face towards a direction.
std::string jointTowards(const Model& model, const std::string& name, const Vec3& direction) {
    const Block& block = blockOf(model, name);
    REQUIRE(block.face_joint.size() == block.shape.faces.size());
    for (std::size_t face = 0; face < block.shape.faces.size(); ++face)
        if (block.shape.faceNormal(face).dot(direction) > 0.999)
            return model.joints[static_cast<std::size_t>(block.face_joint[face])].name;
    return "no such face";
}

const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

/// "upper/lower" -> joint, of the pairs a model names.
std::map<std::string, std::string> pairsOf(const Model& model) {
    std::map<std::string, std::string> pairs;
    for (const PairJoint& pair : model.pair_joints) {
        const std::string name = model.blocks[static_cast<std::size_t>(pair.block_a)].name + "/" +
                                 model.blocks[static_cast<std::size_t>(pair.block_b)].name;
        CHECK(pairs.emplace(name, model.joints[static_cast<std::size_t>(pair.joint)].name).second);
    }
    return pairs;
}

std::vector<std::string> namesOf(const Model& model) {
    std::vector<std::string> names;
    for (const Block& block : model.blocks) names.push_back(block.name);
    return names;
}

std::vector<std::string> jointNames(const Model& model) {
    std::vector<std::string> names;
    for (const Joint& joint : model.joints) names.push_back(joint.name);
    return names;
}

}  // namespace

TEST_CASE("scenario stack: names and order, the floor first") {
    const Model model = modelOf(properties() + stack("", "columns = 2\nrows = 2\nslices = 2\n"));
    CHECK(namesOf(model) == std::vector<std::string>{"floor", "c1r1s1", "c1r1s2", "c1r2s1", "c1r2s2",
                                                     "c2r1s1", "c2r1s2", "c2r2s1", "c2r2s2"});
    CHECK(model.blocks[0].motion == Motion::fixed);
    for (std::size_t i = 1; i < model.blocks.size(); ++i) CHECK(model.blocks[i].motion == Motion::free);
    for (const Block& block : model.blocks) CHECK(block.field == "stack[0]");
}

TEST_CASE("scenario stack: places of the blocks and of the floor") {
    const Model model =
        modelOf(properties() + stack("origin = [1, 2, 3]\n"));  // 3 x 2 x 2 of 0.2 x 0.1 x 0.05
    REQUIRE(model.blocks.size() == 13);
    checkExtent(blockOf(model, "c1r1s1"), {1, 2, 3}, {1.2, 2.1, 3.05});
    checkExtent(blockOf(model, "c3r2s2"), {1.4, 2.1, 3.05}, {1.6, 2.2, 3.1});
    // The stack's length (0.6) beyond both x sides, a block's width (0.1) beyond both y sides, a block's
    // height thick.
    checkExtent(blockOf(model, "floor"), {0.4, 1.9, 2.95}, {2.2, 2.3, 3});
}

TEST_CASE("scenario stack: faces that touch share their plane to the last bit") {
    const Model model = modelOf(properties() +
                                "[[stack]]\ncolumns = 50\nrows = 3\nslices = 1\n"
                                "block = [0.1, 0.3, 0.7]\norigin = [0.3, 0.1, 0.7]\n");
    for (int column = 1; column < 50; ++column)
        CHECK(extentOf(blockOf(model, "c" + std::to_string(column) + "r1s1")).max.x() ==
              extentOf(blockOf(model, "c" + std::to_string(column + 1) + "r1s1")).min.x());
    CHECK(extentOf(blockOf(model, "floor")).max.z() == extentOf(blockOf(model, "c1r1s1")).min.z());
    CHECK(extentOf(blockOf(model, "c1r2s1")).max.z() == extentOf(blockOf(model, "c1r3s1")).min.z());
}

TEST_CASE("scenario stack: a stepped slope") {
    const Model model = modelOf(properties() + stack("heights = [1, 2, 1]\n"));
    CHECK(namesOf(model) == std::vector<std::string>{"floor", "c1r1s1", "c1r1s2", "c2r1s1", "c2r1s2",
                                                     "c2r2s1", "c2r2s2", "c3r1s1", "c3r1s2"});
    checkExtent(blockOf(model, "c3r1s2"), {0.4, 0.1, 0}, {0.6, 0.2, 0.05});
    REQUIRE(model.stack.has_value());
    CHECK(model.stack->heights == std::vector<int>{1, 2, 1});
}

TEST_CASE("scenario stack: running bond") {
    const Model model =
        modelOf(properties() + stack("bond = \"running\"\n", "columns = 3\nrows = 3\nslices = 1\n"));
    CHECK(model.blocks.size() == 10);  // no half blocks
    checkExtent(blockOf(model, "c1r1s1"), {0, 0, 0}, {0.2, 0.1, 0.05});
    checkExtent(blockOf(model, "c1r2s1"), {0.1, 0, 0.05}, {0.3, 0.1, 0.1});
    checkExtent(blockOf(model, "c3r2s1"), {0.5, 0, 0.05}, {0.7, 0.1, 0.1});
    checkExtent(blockOf(model, "c3r3s1"), {0.4, 0, 0.1}, {0.6, 0.1, 0.15});
    checkExtent(blockOf(model, "floor"), {-0.7, -0.1, -0.05}, {1.4, 0.2, 0});
    CHECK(model.stack.value().running);
    CHECK(model.pair_joints.empty());
}

TEST_CASE("scenario stack: what the closed formulas need") {
    const auto shape = modelOf(properties() + stack("origin = [1, 2, 3]\n")).stack;
    REQUIRE(shape.has_value());
    CHECK(shape->columns == 3);
    CHECK(shape->rows == 2);
    CHECK(shape->slices == 2);
    CHECK(shape->block == Vec3(0.2, 0.1, 0.05));
    CHECK(shape->origin == Vec3(1, 2, 3));
    CHECK_FALSE(shape->running);
    CHECK(shape->heights == std::vector<int>{2, 2, 2});
    CHECK_FALSE(modelOf(properties() + stack() + block("a")).stack.has_value());
    CHECK_FALSE(modelOf(properties() + block("a")).stack.has_value());
    CHECK_FALSE(modelOf(properties() + stack() + stack("name = \"b\"\n")).stack.has_value());
}

TEST_CASE("scenario stack: joints of the faces") {
    const Model model = modelOf(properties() + joint("column") + joint("bed") + joint("side") +
                                stack("joint = \"column\"\nbed_joint = \"bed\"\nside_joint = \"side\"\n"));
    for (const char* name : {"c1r1s1", "c2r2s2"}) {
        CHECK(jointTowards(model, name, kX) == "column");
        CHECK(jointTowards(model, name, -kX) == "column");
        CHECK(jointTowards(model, name, kY) == "side");
        CHECK(jointTowards(model, name, -kY) == "side");
        CHECK(jointTowards(model, name, kZ) == "bed");
        CHECK(jointTowards(model, name, -kZ) == "bed");
    }
    for (const Vec3& side : {kX, kY, kZ}) {
        CHECK(jointTowards(model, "floor", side) == "bed");
        CHECK(jointTowards(model, "floor", Vec3(-side)) == "bed");
    }
}

TEST_CASE("scenario stack: friction per bed level") {
    const Model model = modelOf(properties() + stack("bed_friction_deg = [18.5, 30]\n"));
    CHECK(jointNames(model) == std::vector<std::string>{"default", "default@18.5deg"});
    const Joint& derived = model.joints[1];
    CHECK(derived.friction == doctest::Approx(18.5 * 3.14159265358979323846 / 180).epsilon(1e-15));
    CHECK(derived.residual_friction == derived.friction);
    CHECK(derived.normal_stiffness == model.joints[0].normal_stiffness);
    CHECK(derived.shear_stiffness == model.joints[0].shear_stiffness);
    CHECK(jointTowards(model, "floor", kZ) == "default@18.5deg");
    CHECK(jointTowards(model, "floor", kX) == "default");
    CHECK(jointTowards(model, "c2r1s1", -kZ) == "default@18.5deg");
    CHECK(jointTowards(model, "c2r1s1", kZ) == "default");
    CHECK(jointTowards(model, "c2r2s1", -kZ) == "default");
    CHECK(jointTowards(model, "c2r2s1", kZ) == "default");
    CHECK(jointTowards(model, "c2r1s1", kX) == "default");
    CHECK(model.pair_joints.empty());
    CHECK(modelOf(properties() + stack("bed_friction_deg = []\n")).joints.size() == 1);
}

TEST_CASE("scenario stack: a residual friction angle given by hand stays in derived joints") {
    const Model model =
        modelOf(material() + joint("default", "friction_deg = 30\nresidual_friction_deg = 12") +
                stack("bed_friction_deg = [20, 20]\n"));
    REQUIRE(model.joints.size() == 2);
    CHECK(model.joints[1].residual_friction == model.joints[0].residual_friction);
    CHECK(model.joints[1].friction != model.joints[0].friction);
}

TEST_CASE("scenario stack: friction per bed level and column") {
    const Model model = modelOf(properties() + stack("bed_friction_deg = [[10, 20, 10], [30, 20, 25]]\n"));
    CHECK(jointNames(model) ==
          std::vector<std::string>{"default", "default@10deg", "default@20deg", "default@25deg"});
    CHECK(jointTowards(model, "c1r1s1", -kZ) == "default@10deg");
    CHECK(jointTowards(model, "c2r1s2", -kZ) == "default@20deg");
    CHECK(jointTowards(model, "c1r1s1", kZ) == "default");
    CHECK(jointTowards(model, "c1r2s1", -kZ) == "default");
    CHECK(jointTowards(model, "c3r1s1", kZ) == "default@25deg");
    CHECK(jointTowards(model, "c3r2s1", -kZ) == "default@25deg");
    CHECK(jointTowards(model, "floor", kZ) == "default@10deg");
    // The floor's one top face cannot tell column 2, which has more friction.
    CHECK(pairsOf(model) == std::map<std::string, std::string>{{"floor/c2r1s1", "default@20deg"},
                                                               {"floor/c2r1s2", "default@20deg"}});
    for (const PairJoint& pair : model.pair_joints) CHECK_FALSE(pair.must_touch);
}

TEST_CASE("scenario stack: in running bond the upper block's column decides") {
    const Model model = modelOf(properties() + stack("bond = \"running\"\nbed_friction_deg = "
                                                     "[[30, 30], [10, 20], [11, 22]]\n",
                                                     "columns = 2\nrows = 3\nslices = 1\n"));
    // Row 2 is shifted: c1r2 lies on c1r1 and c2r1, c2r2 on c2r1 alone. Row 3: c1r3 on c1r2, c2r3 on c1r2 and
    // c2r2.
    CHECK(jointTowards(model, "c1r2s1", -kZ) == "default@10deg");
    CHECK(jointTowards(model, "c1r1s1", kZ) == "default@10deg");
    CHECK(jointTowards(model, "c2r1s1", kZ) == "default@20deg");
    CHECK(pairsOf(model) == std::map<std::string, std::string>{{"c2r1s1/c1r2s1", "default@10deg"},
                                                               {"c1r2s1/c2r3s1", "default@22deg"}});
}

TEST_CASE("scenario stack: joints derived from two joints stay apart") {
    const Model model = modelOf(
        properties() + joint("bed", "friction_deg = 25") + stack("bed_friction_deg = [20, 20]\n") +
        stack("name = \"b\"\norigin = [0, 9, 0]\nbed_joint = \"bed\"\nbed_friction_deg = [20, 25]\n"));
    CHECK(jointNames(model) == std::vector<std::string>{"default", "bed", "default@20deg", "bed@20deg"});
    CHECK(jointTowards(model, "bc1r1s1", -kZ) == "bed@20deg");
    CHECK(jointTowards(model, "bc1r2s1", -kZ) == "bed");
}

TEST_CASE("scenario: several stacks and blocks") {
    const Model model =
        modelOf(properties() + stack("", "columns = 1\nrows = 1\nslices = 1\n") +
                stack("name = \"b\"\norigin = [0, 9, 0]\n", "columns = 1\nrows = 1\nslices = 1\n") +
                block("key") + block("c9r9s9"));
    CHECK(namesOf(model) ==
          std::vector<std::string>{"floor", "c1r1s1", "bfloor", "bc1r1s1", "key", "c9r9s9"});
    CHECK(model.blocks[3].field == "stack[1]");
    CHECK(model.blocks[5].field == "block[1]");
}

TEST_CASE("scenario block: boxes and hulls, fixed, driven, moving") {
    const Model model = modelOf(
        properties() + joint("soft") +
        "[[block]]\nname = \"floor\"\nbox = { min = [-1, -1.0, -0.1], max = [2.0, 1.0, 0] }\nfixed = true\n"
        "[[block]]\nname = \"wedge\"\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0.1, 0.1, "
        "0.1]]\n"
        "joint = \"soft\"\n"
        "[[block]]\nname = \"press\"\nbox = { min = [0, 0, 3], max = [1, 1, 4] }\ndriven = true\nvelocity = "
        "[0, 0, -1]\n"
        "[[block]]\nname = \"thrown\"\nbox = { min = [0, 0, 5], max = [1, 1, 6] }\nvelocity = [1, 2, "
        "3]\nfixed = false\nangular_velocity = [0, 0.5, -4]\n");
    REQUIRE(model.blocks.size() == 4);
    checkExtent(model.blocks[0], {-1, -1, -0.1}, {2, 1, 0});
    CHECK(model.blocks[0].motion == Motion::fixed);
    CHECK(model.blocks[0].face_joint == std::vector<std::int32_t>(6, 0));
    CHECK(model.blocks[1].shape.vertices.size() == 4);
    CHECK(model.blocks[1].face_joint == std::vector<std::int32_t>(4, 1));
    CHECK(model.blocks[1].motion == Motion::free);
    CHECK(model.blocks[1].velocity == Vec3(0, 0, 0));
    CHECK(model.blocks[2].motion == Motion::driven);
    CHECK(model.blocks[2].velocity == Vec3(0, 0, -1));
    CHECK(model.blocks[3].motion == Motion::free);
    CHECK(model.blocks[3].velocity == Vec3(1, 2, 3));
    CHECK(model.blocks[1].angular_velocity == Vec3(0, 0, 0));
    CHECK(model.blocks[3].angular_velocity == Vec3(0, 0.5, -4));
}

TEST_CASE("scenario interface: a joint by hand, in place of what a stack derived") {
    const std::string hand =
        "[[interface]]\nbetween = [\"c2r1s1\", \"floor\"]\njoint = \"weak\"\n"
        "[[interface]]\nbetween = [\"c1r1s1\", \"c1r2s1\"]\njoint = \"weak\"\n";
    const Model model = modelOf(properties() + joint("weak") +
                                stack("bed_friction_deg = [[10, 20, 10], [30, 30, 30]]\n") + hand);
    CHECK(pairsOf(model) == std::map<std::string, std::string>{{"floor/c2r1s2", "default@20deg"},
                                                               {"c2r1s1/floor", "weak"},
                                                               {"c1r1s1/c1r2s1", "weak"}});
    for (const PairJoint& pair : model.pair_joints)
        CHECK(pair.must_touch == (model.joints[static_cast<std::size_t>(pair.joint)].name == "weak"));
    CHECK(model.pair_joints.back().field == "interface[1]");
}

}  // namespace talus::formats
