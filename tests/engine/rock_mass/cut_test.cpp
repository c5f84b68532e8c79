// Cutting by joints, against answers known otherwise: counted blocks, exact volumes, and for any joints the
// rule that two points are in one block when they lie between the same planes of every set.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <set>

#include "talus/rock_mass.h"

namespace talus {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

JointSet jointSet(double dip_deg, double dip_direction_deg, double spacing,
                  const Vec3& origin = Vec3::Zero()) {
    JointSet set;
    set.dip = dip_deg * kDegree;
    set.dip_direction = dip_direction_deg * kDegree;
    set.spacing = spacing;
    set.origin = origin;
    set.field = "joint_set[0]";
    return set;
}

SingleJoint joint(double dip_deg, double dip_direction_deg, const Vec3& point) {
    SingleJoint single;
    single.dip = dip_deg * kDegree;
    single.dip_direction = dip_direction_deg * kDegree;
    single.point = point;
    single.field = "single_joint[0]";
    return single;
}

RockMass box(const Vec3& max) {
    RockMass rock;
    rock.region = *boxSurface(Vec3::Zero(), max);
    return rock;
}

CutRockMass good(const RockMass& rock) {
    auto cut = cutRockMass(rock);
    for (const Error& error : cut.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(cut.ok());
    return *cut;
}

/// Closed, convex, faces plane and counter-clockwise, every vertex a corner of three faces or more.
void checkShape(const Polyhedron& shape, double tolerance) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    std::map<std::int32_t, int> degree;
    for (const auto& face : shape.faces)
        for (std::size_t i = 0; i < face.size(); ++i) {
            ++edges[{face[i], face[(i + 1) % face.size()]}];
            ++degree[face[i]];
        }
    bool closed = true, plane = true, behind = true;
    for (const auto& [edge, count] : edges)
        closed = closed && count == 1 && edges.count({edge.second, edge.first});
    for (const auto& [vertex, count] : degree) closed = closed && count >= 3;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const Vec3 normal = shape.faceNormal(f),
                   at = shape.vertices[static_cast<std::size_t>(shape.faces[f][0])];
        for (const Vec3& v : shape.vertices) behind = behind && normal.dot(v - at) <= tolerance;
        for (const std::int32_t v : shape.faces[f])
            plane =
                plane && std::abs(normal.dot(shape.vertices[static_cast<std::size_t>(v)] - at)) <= tolerance;
    }
    CHECK(closed);
    CHECK(plane);
    CHECK(behind);
    CHECK(degree.size() == shape.vertices.size());
    CHECK(shape.vertices.size() + shape.faces.size() == edges.size() / 2 + 2);
}

using FaceKey = std::vector<std::array<double, 3>>;

FaceKey keyOf(const Polyhedron& shape, std::size_t face) {
    FaceKey key;
    for (const std::int32_t v : shape.faces[face]) {
        const Vec3& x = shape.vertices[static_cast<std::size_t>(v)];
        key.push_back({x.x(), x.y(), x.z()});
    }
    std::sort(key.begin(), key.end());
    return key;
}

/// Faces of joints that have no twin with the same vertices, bit for bit.
std::size_t facesWithoutTwin(const CutRockMass& cut) {
    std::map<FaceKey, int> count;
    for (const CutBlock& part : cut.blocks)
        for (std::size_t f = 0; f < part.origin.size(); ++f)
            if (part.origin[f].joint >= 0) ++count[keyOf(part.shape, f)];
    std::size_t single = 0;
    for (const auto& [key, times] : count) single += times != 2;
    return single;
}

double plusMinus(std::mt19937_64& random) { return std::uniform_real_distribution<>(-1, 1)(random); }

}  // namespace

TEST_CASE("cutting: three sets at right angles give a grid, from the bottom up, each face with its joint") {
    RockMass rock = box({5, 4, 3});
    rock.sets = {jointSet(90, 90, 1), jointSet(90, 0, 1), jointSet(0, 0, 1)};
    const CutRockMass cut = good(rock);
    REQUIRE(cut.blocks.size() == 60);
    CHECK(cut.warnings.empty());
    CHECK(cut.region_volume == 60);
    CHECK(cut.volume == doctest::Approx(60).epsilon(1e-14));
    CHECK(facesWithoutTwin(cut) == 0);
    for (std::size_t p = 0; p < cut.blocks.size(); ++p) {
        const CutBlock& part = cut.blocks[p];
        CHECK(part.volume == doctest::Approx(1).epsilon(1e-13));
        const auto k = static_cast<double>(p);
        const Vec3 expected(std::floor(std::fmod(k, 20) / 4) + 0.5, std::fmod(k, 4) + 0.5,
                            std::floor(k / 20) + 0.5);
        CHECK((massProperties(part.shape).centroid - expected).norm() < 1e-12);
        for (std::size_t f = 0; f < part.origin.size(); ++f) {
            const Vec3 normal = part.shape.faceNormal(f), middle = part.shape.faceCentroid(f);
            Eigen::Index axis = 0;
            normal.cwiseAbs().maxCoeff(&axis);
            const double at = middle[axis], end = Vec3(5, 4, 3)[axis];
            const bool outside = at < 0.5 || at > end - 0.5;
            CHECK(part.origin[f].joint == (outside ? -1 : static_cast<std::int32_t>(axis)));
            if (!outside) CHECK(part.origin[f].plane == static_cast<std::int32_t>(std::lround(at)));
        }
    }
}

TEST_CASE("cutting: joints through vertices and edges part both neighbours alike, without slivers") {
    RockMass rock = box({4, 4, 4});
    // The planes at 45 degrees go through edges and vertices of the cubes, within rounding.
    rock.sets = {jointSet(90, 90, 1),
                 jointSet(90, 0, 1),
                 jointSet(0, 0, 1),
                 jointSet(45, 90, std::sqrt(0.5)),
                 jointSet(45, 270, std::sqrt(0.5)),
                 jointSet(90, 45, std::sqrt(0.5))};
    const CutRockMass cut = good(rock);
    CHECK(cut.warnings.empty());
    CHECK(facesWithoutTwin(cut) == 0);
    CHECK(cut.volume == doctest::Approx(64).epsilon(1e-13));
    for (const CutBlock& part : cut.blocks) {
        checkShape(part.shape, 1e-11);
        CHECK(part.volume > 1.0 / 24 - 1e-12);
    }
    // Two planes cut a cube into four prisms, and the upright diagonal each of these in two, the lesser of
    // 1/24.
    CHECK(cut.blocks.size() == 8 * 64);
}

TEST_CASE("cutting: points between the same planes of every set are in one block, and only these") {
    std::mt19937_64 random(7);
    for (int trial = 0; trial < 12; ++trial) {
        CAPTURE(trial);
        RockMass rock = box({1, 1.2, 0.8});
        rock.min_thickness = 0;
        for (int i = 0; i < 3; ++i) {
            JointSet set = jointSet(45 + 44 * plusMinus(random), 180 + 180 * plusMinus(random), 0.25,
                                    {plusMinus(random), plusMinus(random), plusMinus(random)});
            set.offset = 0.1 * plusMinus(random);
            rock.sets.push_back(set);
        }
        const CutRockMass cut = good(rock);
        CHECK(std::abs(cut.volume - 0.96) < 1e-13);
        CHECK(facesWithoutTwin(cut) == 0);
        for (const CutBlock& part : cut.blocks) checkShape(part.shape, 1e-10);

        std::map<std::array<long, 3>, std::int32_t> block_of;
        std::set<std::int32_t> blocks;
        for (int k = 0; k < 400; ++k) {
            const Vec3 x(0.5 + 0.5 * plusMinus(random), 0.6 + 0.6 * plusMinus(random),
                         0.4 + 0.4 * plusMinus(random));
            std::array<long, 3> cell;
            for (std::size_t i = 0; i < 3; ++i) {
                const JointSet& set = rock.sets[i];
                const Vec3 normal(std::sin(set.dip) * std::sin(set.dip_direction),
                                  std::sin(set.dip) * std::cos(set.dip_direction), std::cos(set.dip));
                cell[i] = std::lround(std::floor((normal.dot(x - set.origin) - set.offset) / set.spacing));
            }
            const std::int32_t block = blockAt(cut, x);
            REQUIRE(block >= 0);
            const auto [known, is_new] = block_of.emplace(cell, block);
            CHECK(known->second == block);
            if (is_new) CHECK(blocks.insert(block).second);
        }
    }
}

TEST_CASE("cutting: random spacing and orientation are seeded, and follow their laws") {
    RockMass rock = box({200, 1, 1});
    JointSet set = jointSet(90, 90, 0.5);
    set.law = SpacingLaw::exponential;
    rock.sets = {set};
    rock.min_thickness = 0;
    const auto lengths = [&] {
        std::vector<double> values;
        for (const CutBlock& part : good(rock).blocks) values.push_back(part.volume);
        return values;
    };
    const std::vector<double> first = lengths();
    CHECK(first == lengths());
    rock.seed = 2;
    CHECK(first != lengths());
    // Mean and standard deviation of a negative exponential are equal; 400 spacings know them to some 5 %.
    double mean = 0, square = 0;
    for (const double length : first) mean += length / static_cast<double>(first.size());
    for (const double length : first)
        square += (length - mean) * (length - mean) / static_cast<double>(first.size());
    CHECK(mean == doctest::Approx(0.5).epsilon(0.15));
    CHECK(std::sqrt(square) == doctest::Approx(mean).epsilon(0.15));

    rock.sets[0].law = SpacingLaw::uniform;
    rock.sets[0].spread = 0.2;
    std::vector<double> even = lengths();
    even.erase(even.begin());
    even.pop_back();  // the ends are cut by the region
    const auto [least, most] = std::minmax_element(even.begin(), even.end());
    CHECK(*least >= 0.4 - 1e-9);
    CHECK(*most <= 0.6 + 1e-9);
    CHECK(*most - *least > 0.1);
}

TEST_CASE("cutting: scattered orientations have the mean angle of their Fisher constant") {
    RockMass rock = box({1, 1, 1000});
    JointSet set = jointSet(0, 0, 2);
    set.fisher = 200;
    rock.sets = {set};
    const CutRockMass cut = good(rock);
    double resultant = 0;
    std::size_t faces = 0;
    for (const CutBlock& part : cut.blocks)
        for (std::size_t f = 0; f < part.origin.size(); ++f)
            if (part.origin[f].joint == 0 && part.shape.faceNormal(f).z() > 0) {
                resultant += part.shape.faceNormal(f).z();
                ++faces;
            }
    REQUIRE(faces > 400);
    // The mean of cos(angle) is coth k - 1/k; its deviation from 1 is known to 1/sqrt(n).
    CHECK(1 - resultant / static_cast<double>(faces) == doctest::Approx(1.0 / 200).epsilon(0.2));
}

TEST_CASE("cutting: a joint along a face of the region cuts nothing, and says so") {
    RockMass rock = box({1, 1, 1});
    for (const double off : {0.0, 1e-13, -1e-13}) {
        rock.singles = {joint(90, 90, {off, 0, 0})};
        const CutRockMass cut = good(rock);
        CHECK(cut.blocks.size() == 1);
        REQUIRE(cut.warnings.size() == 1);
        CHECK(cut.warnings[0].find("single_joint[0]: cuts no block") == 0);
        CHECK(cut.idle_joints == std::vector<std::string>{"single_joint[0]"});
    }
    rock.singles = {joint(90, 90, {0.5, 0, 0})};
    CHECK(good(rock).idle_joints.empty());
}

TEST_CASE("cutting planes: those that miss the region are none, scattered or not") {
    RockMass rock = box({60, 60, 60});
    for (const std::optional<double> fisher :
         {std::optional<double>(), std::optional(200.0), std::optional(20.0)}) {
        CAPTURE(fisher.value_or(0));
        rock.sets = {jointSet(0, 270, 7)};
        rock.sets[0].origin = {0, 0, 1};  // no plane along the region's faces
        rock.sets[0].fisher = fisher;
        const CutRockMass cut = good(rock);
        std::set<std::int64_t> cutting;
        for (const CutBlock& block : cut.blocks)
            for (const FaceOrigin& origin : block.origin)
                if (origin.joint == 0) cutting.insert(origin.plane);
        CHECK(cutting.size() >= 9);
        CHECK(cuttingPlanes(rock)->size() == cutting.size());
    }
    rock.sets.clear();
    rock.singles = {joint(48, 220, {1, 0, 200}), joint(48, 220, {1, 0, 20})};
    CHECK(cuttingPlanes(rock)->size() == 1);
    rock.singles[1].point = {-20, 30, 30};  // a disc beside the region, in a plane through it
    rock.singles[1].dip = 0;
    for (const auto& [radius, count] : {std::pair(15.0, 0), std::pair(25.0, 1)}) {
        rock.singles[1].radius = radius;
        CHECK(cuttingPlanes(rock)->size() == static_cast<std::size_t>(count));
    }
}

TEST_CASE("cutting: slivers are left out with a warning, or refused") {
    RockMass rock = box({1, 1, 1});
    rock.singles = {joint(90, 90, {1e-5, 0, 0}), joint(0, 0, {0, 0, 0.5})};
    const CutRockMass cut = good(rock);
    CHECK(cut.min_thickness == doctest::Approx(1e-4));
    CHECK(cut.blocks.size() == 2);
    REQUIRE(cut.warnings.size() == 1);
    CHECK(cut.warnings[0].find("1 cut was left out, because a part would be thinner than 0.0001 m") !=
          std::string::npos);
    rock.min_thickness = 1e-6;
    CHECK(good(rock).blocks.size() == 4);
    rock.min_thickness = 1e-4;
    rock.refuse_slivers = true;
    const auto refused = cutRockMass(rock);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.errors()[0].field == "single_joint[0]");
    CHECK(refused.errors()[0].message.find("1e-05 m thick") != std::string::npos);
}

TEST_CASE("cutting: a thin edge is a sliver, too, a plate cut across its length is not") {
    RockMass rock = box({1, 1, 1});
    rock.singles = {joint(45, 90, {1, 0, 1 - 1e-5})};  // takes off the upper edge at x = 1
    CHECK(good(rock).blocks.size() == 1);
    rock = box({1, 1e-6, 1});
    rock.singles = {joint(90, 90, {0.5, 0, 0})};
    CHECK(good(rock).blocks.size() == 2);
}

TEST_CASE("cutting: a finite joint cuts the blocks it meets, and these from side to side") {
    RockMass rock = box({5, 1, 1});
    rock.sets = {jointSet(90, 90, 1)};
    SingleJoint disc = joint(0, 0, {2.5, 0.5, 0.5});
    struct Row {
        double radius;
        std::size_t blocks;
    };
    for (const Row& row : {Row{0.3, 6}, Row{0.5, 6}, Row{0.6, 8}, Row{1.6, 10}}) {
        CAPTURE(row.radius);
        disc.radius = row.radius;  // 0.5 touches the neighbours only
        rock.singles = {disc};
        const CutRockMass cut = good(rock);
        CHECK(cut.blocks.size() == row.blocks);
        CHECK(cut.volume == doctest::Approx(5).epsilon(1e-13));
    }
    SingleJoint polygon;
    polygon.field = "single_joint[0]";
    polygon.polygon = {{1, 0, 0.5}, {3.2, 0, 0.5}, {3.2, 1, 0.5}, {1, 1, 0.5}};  // blocks 2, 3 and 4
    rock.singles = {polygon};
    CHECK(good(rock).blocks.size() == 8);
    std::reverse(rock.singles[0].polygon.begin(), rock.singles[0].polygon.end());
    CHECK(good(rock).blocks.size() == 8);
    rock.singles[0].polygon = {{0, 0, 0}, {1, 0, 0}, {0.4, 0.4, 0}, {0, 1, 0}};
    auto fault = cutRockMass(rock);
    REQUIRE_FALSE(fault.ok());
    CHECK(fault.errors()[0].field == "single_joint[0].polygon[2]");
    CHECK(fault.errors()[0].message.find("not convex") != std::string::npos);
}

TEST_CASE("cutting: a block with a reflex edge is one block of convex parts, and only such a block") {
    // An L: 2 x 2 less its upper left quarter, one deep.
    RockMass rock;
    rock.region = *extrudeProfile({{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, 0, 1);
    CutRockMass cut = good(rock);
    REQUIRE(cut.blocks.size() == 1);
    CHECK(cut.blocks[0].shape.partCount() == 2);
    CHECK(cut.volume == doctest::Approx(3).epsilon(1e-14));

    // A joint along the face the region was decomposed along parts the block for good.
    for (const auto& along : {joint(0, 0, {0, 0, 1}), joint(90, 90, {1, 0, 0})}) {
        rock.singles = {along};
        cut = good(rock);
        REQUIRE(cut.blocks.size() == 2);
        for (const CutBlock& block : cut.blocks) CHECK(block.shape.partCount() == 1);
    }
    // Below the reflex edge: one plain block, one with the edge.
    rock.singles = {joint(0, 0, {0, 0, 0.5})};
    cut = good(rock);
    REQUIRE(cut.blocks.size() == 2);
    CHECK(cut.blocks[0].shape.partCount() == 1);
    CHECK(cut.blocks[1].shape.partCount() == 2);
}

TEST_CASE("cutting: a joint across the arms of a U leaves two arms and a base") {
    RockMass rock;
    rock.region = *extrudeProfile({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0, 1);
    rock.singles = {joint(0, 0, {0, 0, 1.5})};
    CutRockMass cut = good(rock);
    CHECK(cut.blocks.size() == 3);
    CHECK(cut.volume == doctest::Approx(5).epsilon(1e-14));
    rock.singles = {joint(0, 0, {0, 0, 0.5})};
    cut = good(rock);
    CHECK(cut.blocks.size() == 2);
}

TEST_CASE("cutting: faults of the joints name their field") {
    RockMass rock = box({1, 1, 1});
    rock.sets = {jointSet(0, 0, 0)};
    auto fault = cutRockMass(rock);
    REQUIRE_FALSE(fault.ok());
    CHECK(fault.errors()[0].field == "joint_set[0].spacing");
    rock.sets = {jointSet(0, 0, 1e-9)};
    fault = cutRockMass(rock);
    REQUIRE_FALSE(fault.ok());
    CHECK(fault.errors()[0].message.find("planes through the region") != std::string::npos);
    rock.sets = {jointSet(0, 0, 0.1), jointSet(90, 0, 0.1), jointSet(90, 90, 0.1)};
    rock.max_blocks = 500;
    fault = cutRockMass(rock);
    REQUIRE_FALSE(fault.ok());
    CHECK(fault.errors()[0].message.find("more than 500 blocks") != std::string::npos);
    rock.max_blocks = 400;  // far too many are refused before they are cut
    fault = cutRockMass(rock);
    REQUIRE_FALSE(fault.ok());
    CHECK(fault.errors()[0].field == "joint_set[0].spacing");
    CHECK(fault.errors()[0].message.find("into about 1000 blocks") != std::string::npos);
}

TEST_CASE("cutting: joints that are far too many are refused before they are cut") {
    RockMass rock = box({1, 1, 1});
    for (int k = 0; k < 500; ++k) rock.sets.push_back(jointSet(10.0 + 0.15 * k, 0.7 * k, 0.05));
    const auto sets = cutRockMass(rock);
    REQUIRE_FALSE(sets.ok());
    CHECK(sets.errors()[0].message.find("GB of memory") != std::string::npos);
    rock.sets = {jointSet(40, 120, 1e-4)};
    rock.sets[0].fisher = 20;
    CHECK_FALSE(cutRockMass(rock).ok());
    rock.sets[0].spacing = 0.4;
    CHECK(cutRockMass(rock).ok());
}

TEST_CASE("cutting: many finite joints are refused before they are cut, and the time it would take is said") {
    RockMass rock = box({10, 10, 10});
    for (int k = 0; k < 2000; ++k) {
        SingleJoint disc = joint(std::fmod(7.3 * k, 90), std::fmod(31.7 * k, 360),
                                 {std::fmod(1.31 * k, 10), std::fmod(2.77 * k, 10), std::fmod(3.93 * k, 10)});
        disc.radius = 1;
        rock.singles.push_back(disc);
    }
    rock.max_blocks = 1000;
    const auto refused = cutRockMass(rock);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.errors()[0].message.find("blocks or more") != std::string::npos);
    CHECK(refused.errors()[0].message.find("to cut") != std::string::npos);

    // What is expected is what is cut, within a factor.
    rock.singles.resize(400);
    rock.max_blocks = 100'000;
    std::string first;
    double share = 0;
    rock.progress = [&](const Progress& progress) {
        if (first.empty()) first = progress.detail;
        if (progress.stage == "cutting") {
            CHECK(progress.fraction >= share);
            share = progress.fraction;
        }
    };
    const auto cut = cutRockMass(rock);
    REQUIRE(cut.ok());
    CHECK(share > 0.9);
    double expected = 0;
    REQUIRE(std::sscanf(first.c_str(), "1 of some %lf blocks", &expected) == 1);
    const double found = static_cast<double>(cut->blocks.size());
    CHECK(expected > 0.4 * found);
    CHECK(expected < 2.5 * found);
}

TEST_CASE("cutting: ends at once when it is stopped") {
    RockMass rock = box({1, 1, 1});
    rock.sets = {jointSet(0, 0, 0.1)};
    const std::atomic<bool> stop{true};
    rock.stop = &stop;
    const auto cut = cutRockMass(rock);
    REQUIRE_FALSE(cut.ok());
    CHECK(cut.errors()[0].message.find("interrupted") != std::string::npos);
}

TEST_CASE("selecting: by box, by plane, by the boundary") {
    RockMass rock = box({2, 2, 2});
    rock.sets = {jointSet(90, 90, 1), jointSet(90, 0, 1), jointSet(0, 0, 1)};
    const CutRockMass cut = good(rock);
    const auto count = [&](const BlockSelection& selection) {
        const auto taken = selectBlocks(cut, selection, 1e-9);
        return std::count(taken.begin(), taken.end(), true);
    };
    using Kind = BlockSelection::Kind;
    CHECK(count({Kind::box, {0, 0, 0}, {1, 1, 2}}) == 2);
    CHECK(count({Kind::below, {}, {}, {0, 0, 1}, Vec3::UnitZ()}) == 4);
    CHECK(count({Kind::below, {}, {}, {0, 0, 0.9}, Vec3::UnitZ()}) == 0);
    CHECK(count({Kind::above, {}, {}, {0, 0, 1}, Vec3::UnitZ()}) == 4);
    CHECK(count({Kind::touching, {}, {}, {2, 0, 0}, Vec3::UnitX()}) == 4);
    CHECK(blockAt(cut, {1.5, 1.5, 1.5}) == 7);
    CHECK(blockAt(cut, {1.5, 1.5, 2.5}) == -1);
}

}  // namespace talus
