// Cutting by whatever joints are drawn: volumes add up, blocks are convex and apart, and every face is
// parallel to its set.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/separation.h"
#include "support/properties.h"
#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

/// A box or a slope with a bench (which is not convex), with sets and single joints.
RockMass drawRockMass() {
    RockMass rock;
    const bool slope = *rc::gen::arbitrary<bool>();
    if (slope)
        rock.region = *extrudeProfile(
            {{0, 0}, {4, 0}, {4, 1 + *numberIn(0, 0.5)}, {2, 1}, {*numberIn(1, 1.5), 2}, {0, 2}}, 0, 1.5);
    else
        rock.region = *boxSurface({0, 0, 0}, {*numberIn(1, 3), *numberIn(1, 3), *numberIn(1, 2)});
    const int sets = *rc::gen::inRange(0, 4), singles = *rc::gen::inRange(0, 3);
    for (int k = 0; k < sets; ++k) {
        JointSet set;
        set.dip = kDegree * *rc::gen::inRange(0, 91);
        set.dip_direction = kDegree * *rc::gen::inRange(0, 360);
        set.spacing = *numberIn(0.3, 1.2);
        set.offset = *numberIn(-0.3, 0.3);
        set.law = *rc::gen::element(SpacingLaw::constant, SpacingLaw::uniform, SpacingLaw::exponential);
        set.spread = 0.5;
        set.field = "joint_set[" + std::to_string(k) + "]";
        rock.sets.push_back(set);
    }
    for (int k = 0; k < singles; ++k) {
        SingleJoint single;
        single.dip = kDegree * *rc::gen::inRange(0, 91);
        single.dip_direction = kDegree * *rc::gen::inRange(0, 360);
        single.point = {*numberIn(0.2, 1.8), *numberIn(0.2, 1), *numberIn(0.2, 1)};
        if (*rc::gen::arbitrary<bool>()) single.radius = *numberIn(0.3, 2);
        single.field = "single_joint[" + std::to_string(k) + "]";
        rock.singles.push_back(single);
    }
    rock.seed = static_cast<std::uint64_t>(*rc::gen::inRange(1, 1000));
    return rock;
}

bool isConvex(const Polyhedron& shape) {
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const Vec3 normal = shape.faceNormal(f),
                   &at = shape.vertices[static_cast<std::size_t>(shape.faces[f][0])];
        for (const Vec3& v : shape.vertices)
            if (normal.dot(v - at) > 1e-9) return false;
    }
    return true;
}

Vec3 normalOf(const RockMass& rock, std::int32_t joint) {
    const auto k = static_cast<std::size_t>(joint);
    if (k < rock.sets.size()) return upwardNormal(rock.sets[k].dip, rock.sets[k].dip_direction);
    const SingleJoint& single = rock.singles[k - rock.sets.size()];
    return upwardNormal(single.dip, single.dip_direction);
}

}  // namespace

TEST_CASE(
    "property: whatever joints cut, volumes add up, parts are convex and apart, faces parallel to their "
    "joints") {
    int cuts = 0;
    std::size_t all_parts = 0;
    checkProperty("cut rock mass", 60, [&] {
        const RockMass rock = drawRockMass();
        const auto cut = cutRockMass(rock);
        RC_ASSERT(cut.ok());
        ++cuts;
        std::vector<Polyhedron> parts;
        for (const CutBlock& block : cut->blocks)
            for (Polyhedron& part : partsOf(block.shape)) parts.push_back(std::move(part));
        all_parts += parts.size();
        RC_ASSERT(std::abs(cut->region_volume - surfaceVolume(rock.region)) < 1e-9 * cut->region_volume);
        double sum = 0;
        for (const CutBlock& part : cut->blocks) {
            sum += part.volume;
            RC_ASSERT(part.volume > 0);
            RC_ASSERT(std::abs(massProperties(part.shape).volume - part.volume) < 1e-9 * cut->region_volume);
            for (const Polyhedron& convex : partsOf(part.shape)) RC_ASSERT(isConvex(convex));
            RC_ASSERT(part.origin.size() == part.shape.faces.size());
            for (std::size_t f = 0; f < part.origin.size(); ++f)
                if (part.origin[f].joint >= 0)
                    RC_ASSERT(std::abs(std::abs(part.shape.faceNormal(f).dot(
                                           normalOf(rock, part.origin[f].joint))) -
                                       1) < 1e-6);
        }
        RC_ASSERT(std::abs(sum - cut->region_volume) < 1e-9 * cut->region_volume);
        RC_ASSERT(std::abs(cut->volume - sum) < 1e-9 * cut->region_volume);
        for (std::size_t p = 0; p < std::min<std::size_t>(parts.size(), 40); ++p)
            for (std::size_t q = 0; q < p; ++q) RC_ASSERT(separation(parts[p], parts[q]) > -1e-9);
    });
    CHECK(cuts >= 60);
    CHECK(all_parts > 500);
}
