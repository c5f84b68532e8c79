// Cuts of finite joints: what lies within the joints, and what beyond, is what discs and polygons say by
// themselves.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "model/joint_choice.h"
#include "support/properties.h"
#include "talus/fractures.h"
#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kPi = std::numbers::pi;

SingleJoint discOf(const Fracture& disc) {
    SingleJoint joint;
    joint.field = "single_joint[0]";
    joint.point = disc.centre;
    joint.dip = disc.dip;
    joint.dip_direction = disc.dip_direction;
    joint.radius = disc.radius;
    return joint;
}

JointSet setOf(double dip, double direction, double spacing) {
    JointSet set;
    set.field = "joint_set[0]";
    set.dip = dip;
    set.dip_direction = direction;
    set.spacing = spacing;
    set.origin = Vec3(0.3, 0.2, 0.1);
    return set;
}

double within(const std::vector<JointCut>& cuts) {
    return std::accumulate(cuts.begin(), cuts.end(), 0.0,
                           [](double sum, const JointCut& cut) { return sum + (1 - cut.beyond) * cut.area; });
}

double allOf(const std::vector<JointCut>& cuts) {
    return std::accumulate(cuts.begin(), cuts.end(), 0.0,
                           [](double sum, const JointCut& cut) { return sum + cut.area; });
}

std::vector<JointCut> cutsOf(const RockMass& rock) {
    const auto mass = cutRockMass(rock);
    REQUIRE(mass.ok());
    const auto cuts = finiteCuts(*mass, rock);
    for (const JointCut& cut : cuts) {
        CHECK(cut.beyond >= 0);
        CHECK(cut.beyond <= 1);
        CHECK(cut.block_a != cut.block_b);
        const auto normal = [&](std::int32_t block, std::int32_t face) {
            return mass->blocks[static_cast<std::size_t>(block)].shape.faceNormal(
                static_cast<std::size_t>(face));
        };
        CHECK(normal(cut.block_a, cut.face_a).dot(normal(cut.block_b, cut.face_b)) ==
              doctest::Approx(-1).epsilon(1e-9));
    }
    return cuts;
}

}  // namespace

TEST_CASE("bridges: a disc within one block leaves rock around it, a polygon beside it") {
    RockMass rock;
    rock.region = *boxSurface(Vec3::Zero(), Vec3::Constant(10));
    for (const double radius : {0.5, 2.0, 4.9}) {
        rock.singles = {discOf({{5, 5, 5}, 0, 0, radius})};
        const auto cuts = cutsOf(rock);
        REQUIRE(cuts.size() == 1);
        CHECK(cuts[0].area == doctest::Approx(100));
        CHECK(cuts[0].beyond == doctest::Approx(1 - kPi * radius * radius / 100).epsilon(1e-12));
    }
    rock.singles = {discOf({{5, 5, 5}, 0, 0, 8})};
    CHECK(cutsOf(rock)[0].beyond == 0);  // sqrt(50) to the corners
    SingleJoint polygon;
    polygon.field = "single_joint[0]";
    for (const double end : {2.0, 7.0, 9.0}) {
        polygon.polygon = {{0, 0, 5}, {end, 0, 5}, {end, 10, 5}, {0, 10, 5}};
        rock.singles = {polygon};
        CHECK(cutsOf(rock)[0].beyond == doctest::Approx(1 - end / 10).epsilon(1e-12));
        std::reverse(rock.singles[0].polygon.begin(), rock.singles[0].polygon.end());
        CHECK(cutsOf(rock)[0].beyond == doctest::Approx(1 - end / 10).epsilon(1e-12));
    }
    rock.singles.clear();
    rock.sets = {setOf(0.3, 1, 2)};
    CHECK(cutsOf(rock).empty());
}

TEST_CASE("property: what lies within discs is what they have of the region, however joint sets cut it") {
    checkProperty("area within discs", 25, [&] {
        RockMass rock;
        rock.region = *extrudeProfile({{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}}, 0, 5);
        rock.min_thickness = 1e-9;
        const int sets = *rc::gen::inRange(0, 3);
        for (int k = 0; k < sets; ++k)
            rock.sets.push_back(setOf(*numberIn(0.2, 1.5), *numberIn(0, 6), *numberIn(1, 3)));
        double wanted = 0;
        for (int k = 0; k < 3; ++k) {
            const Fracture disc{{*numberIn(-1, 7), *numberIn(-1, 6), *numberIn(-1, 7)},
                                *numberIn(0.1, 1.5),
                                *numberIn(0.1, 6.1),
                                *numberIn(0.5, 5)};
            wanted += areaInside(disc, rock.region);
            rock.singles.push_back(discOf(disc));
        }
        const auto mass = cutRockMass(rock);
        RC_PRE(mass.ok());
        for (const std::string& warning : mass->warnings)
            RC_PRE(warning.find("left out") == std::string::npos);
        const auto cuts = finiteCuts(*mass, rock);
        RC_ASSERT(std::abs(within(cuts) - wanted) < 1e-7 * (1 + wanted));
        RC_ASSERT(allOf(cuts) >= within(cuts));
    });
}

TEST_CASE("joint choice: a joint of two faces holds for these alone, in either order") {
    Model model;
    for (const double friction : {0.3, 0.5, 0.7}) {
        Joint joint;
        joint.friction = friction;
        model.joints.push_back(joint);
    }
    Block block;
    block.face_joint = {0, 0, 0, 0, 0, 0};
    model.blocks = {block, block, block};
    model.pair_joints = {{2, 1, 1, false, "", 4, 3}, {1, 2, 2, false, "", 5, 4}};
    const JointChoice choice(model);
    CHECK(choice.between(2, 4, 1, 3) == 1);
    CHECK(choice.between(1, 3, 2, 4) == 1);
    CHECK(choice.between(1, 5, 2, 4) == 2);
    CHECK(choice.between(2, 3, 1, 4) == 0);
    CHECK(choice.between(0, 4, 1, 3) == 0);
    model.pair_joints.push_back({1, 2, 2, true, ""});  // by hand, of all their faces
    CHECK(JointChoice(model).between(2, 3, 1, 4) == 2);
}
