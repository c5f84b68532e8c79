// Sets that end at another joint: each block lies between two of its planes, and the cuts do not go on.

#include "talus/ending_sets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace talus {

namespace {

constexpr double kDeg = std::numbers::pi / 180;

JointSet jointSet(double dip_deg, double dip_direction_deg, double spacing) {
    JointSet set;
    set.dip = dip_deg * kDeg;
    set.dip_direction = dip_direction_deg * kDeg;
    set.spacing = spacing;
    set.field = "joint_set[1]";
    return set;
}

/// Beds 1 m apart from z = 0.5 on in a box of 10 x 2 x 4 m.
RockMass beds() {
    RockMass rock;
    rock.region = *boxSurface({0, 0, 0}, {10, 2, 4});
    rock.sets.push_back(jointSet(0, 0, 1));
    rock.sets[0].origin = {0, 0, 0.5};
    return rock;
}

std::vector<SingleJoint> joints(const EndingSet& ending, const RockMass& rock) {
    auto made = endingJoints(ending, 0, rock);
    for (const Error& error : made.errors()) FAIL_CHECK(error.field, ": ", error.message);
    REQUIRE(made.ok());
    return std::move(*made);
}

CutRockMass cut(const RockMass& rock) {
    auto mass = cutRockMass(rock);
    for (const Error& error : mass.errors()) FAIL_CHECK(error.field, ": ", error.message);
    REQUIRE(mass.ok());
    return std::move(*mass);
}

}  // namespace

TEST_CASE("ending sets: cross joints between beds make bricks, each bed with its own places") {
    RockMass rock = beds();
    rock.singles = joints({jointSet(90, 90, 2), 0}, rock);
    const CutRockMass mass = cut(rock);
    CHECK(mass.warnings.empty());
    std::set<std::pair<int, double>> places;  // bed, x of an upright joint
    for (const CutBlock& block : mass.blocks) {
        double low = 1e9, high = -1e9;
        for (const Vec3& v : block.shape.vertices) low = std::min(low, v.z()), high = std::max(high, v.z());
        CHECK(std::floor(low + 0.5 + 1e-9) == std::ceil(high + 0.5 - 1e-9) - 1);  // within one bed
        for (std::size_t f = 0; f < block.origin.size(); ++f)
            if (block.origin[f].joint >= 1)
                places.emplace(
                    static_cast<int>(std::floor(low + 0.5 + 1e-9)),
                    std::round(1e6 *
                               block.shape.vertices[static_cast<std::size_t>(block.shape.faces[f][0])].x()));
    }
    CHECK(places.size() == 5 * 5);  // five beds, each with five cross joints over 10 m
    CHECK(mass.blocks.size() == 5 * (5 + 1));
    std::set<double> different;
    for (const auto& [bed, x] : places) different.insert(std::fmod(x, 2e6));
    CHECK(different.size() == 5);  // one place of its own in each bed
    for (const JointCut& each : finiteCuts(mass, rock)) CHECK(each.beyond < 1e-9);
    // The same seed makes the same joints, another one others.
    CHECK(joints({jointSet(90, 90, 2), 0}, beds())[0].polygon == rock.singles[0].polygon);
    RockMass other = beds();
    other.seed = 2;
    CHECK(joints({jointSet(90, 90, 2), 0}, other)[0].polygon != rock.singles[0].polygon);
}

TEST_CASE("ending sets: inclined and scattered joints stay between the planes of an inclined set") {
    RockMass rock;
    rock.region = *boxSurface({0, 0, 0}, {10, 10, 10});
    rock.sets.push_back(jointSet(35, 250, 2.5));
    JointSet cross = jointSet(70, 100, 2);
    cross.fisher = 40;
    cross.law = SpacingLaw::exponential;
    rock.singles = joints({cross, 0}, rock);
    CHECK(rock.singles.size() > 20);
    const Vec3 normal = upwardNormal(35 * kDeg, 250 * kDeg);
    double first = 1e9, last = -1e9;  // of the beds' planes, which are numbered by their heights over 2.5 m
    for (const Vec3& corner : rock.region.vertices)
        first = std::min(first, normal.dot(corner) / 2.5), last = std::max(last, normal.dot(corner) / 2.5);
    for (const SingleJoint& joint : rock.singles) {
        double low = 1e9, high = -1e9;
        for (const Vec3& corner : joint.polygon)
            low = std::min(low, normal.dot(corner) / 2.5), high = std::max(high, normal.dot(corner) / 2.5);
        for (double plane = std::ceil(first); plane <= last; ++plane)
            CHECK_FALSE((low + 1e-9 < plane && plane < high - 1e-9));
    }
    const CutRockMass mass = cut(rock);
    CHECK(mass.blocks.size() > 50);
    CHECK(mass.volume == doctest::Approx(1000).epsilon(1e-9));
    for (const JointCut& each : finiteCuts(mass, rock)) CHECK(each.beyond < 1e-9);
}

TEST_CASE("ending sets: at a single plane the joints of its two sides do not meet") {
    RockMass rock = beds();
    rock.sets.clear();
    SingleJoint fault;
    fault.point = {5, 1, 2};
    fault.dip = 60 * kDeg;
    fault.dip_direction = 90 * kDeg;
    rock.singles.push_back(fault);
    std::vector<SingleJoint> made = joints({jointSet(0, 0, 1), 0}, rock);
    rock.singles.insert(rock.singles.end(), made.begin(), made.end());
    const CutRockMass mass = cut(rock);
    std::set<double> left, right;  // heights of the beds
    for (const CutBlock& block : mass.blocks)
        for (std::size_t f = 0; f < block.origin.size(); ++f) {
            if (block.origin[f].joint < 1) continue;
            Vec3 middle = Vec3::Zero();
            for (const std::int32_t v : block.shape.faces[f])
                middle += block.shape.vertices[static_cast<std::size_t>(v)] /
                          static_cast<double>(block.shape.faces[f].size());
            const bool is_above = upwardNormal(fault.dip, fault.dip_direction).dot(middle - fault.point) > 0;
            (is_above ? right : left).insert(std::round(1e6 * middle.z()));
        }
    CHECK(left.size() == 4);
    CHECK(right.size() == 4);
    for (const double z : left) CHECK(right.count(z) == 0);
}

TEST_CASE("ending sets: faults") {
    const auto fault = [](const EndingSet& ending, const RockMass& rock) {
        const auto made = endingJoints(ending, 0, rock);
        REQUIRE_FALSE(made.ok());
        return made.errors()[0].field + ": " + made.errors()[0].message;
    };
    RockMass rock = beds();
    CHECK(fault({jointSet(0, 0, 2), 0}, rock).find("joint_set[1].ends_at: found a joint parallel") !=
          std::string::npos);
    CHECK(fault({jointSet(90, 90, 1e-7), 0}, rock).find("joint_set[1].spacing: found more than") !=
          std::string::npos);
    rock.sets[0].fisher = 100;
    CHECK(fault({jointSet(90, 90, 2), 0}, rock).find("scattered orientation") != std::string::npos);
    rock = beds();
    SingleJoint disc;
    disc.radius = 2;
    rock.singles.push_back(disc);
    CHECK(fault({jointSet(90, 90, 2), 1}, rock).find("found a finite joint") != std::string::npos);
}

}  // namespace talus
