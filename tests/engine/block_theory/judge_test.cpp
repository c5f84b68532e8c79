// Limit equilibrium of one body, against closed forms.

#include "block_theory/judge.h"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/block_theory/drawn_contacts.h"
#include "support/models.h"

using namespace talus;
using namespace talus::keyblocks;
using namespace talus::test;

namespace {

constexpr double kWeight = 1000;  // [N]
const Vec3 kDown = -kWeight * Vec3::UnitZ();

Sliding judgedOn(const std::vector<Contact>& contacts, const std::vector<Joint>& joints,
                 const Vec3& force = kDown) {
    return judge({force, contacts}, joints);
}

Joint cohesive(double friction_deg, double cohesion) {
    Joint made = joint(friction_deg);
    made.cohesion = cohesion;
    return made;
}

}  // namespace

TEST_CASE("one plane: (N tan(phi) + C A) / T, down the dip") {
    const std::vector<Contact> contacts{contactWith(poleOf(30, 270), 2.0)};
    const Sliding found = judgedOn(contacts, {cohesive(25, 40)});
    CHECK((found.mode == SlidingMode::slides));
    const double normal = kWeight * std::cos(radians(30)), driving = kWeight * std::sin(radians(30));
    CHECK(found.driving == doctest::Approx(driving));
    CHECK(found.resisting == doctest::Approx(normal * std::tan(radians(25)) + 80));
    CHECK(found.factor == doctest::Approx(found.resisting / driving));
    CHECK((found.direction - Vec3(-std::cos(radians(30)), 0, -std::sin(radians(30)))).norm() < 1e-12);
    REQUIRE(found.planes.size() == 1);
    CHECK(found.planes[0].normal_force == doctest::Approx(normal));
    CHECK(found.joints == std::vector<std::string>{"default"});
}

TEST_CASE("two planes: the wedge of 40/130 and 60/220") {
    const std::vector<Contact> contacts{contactWith(poleOf(40, 130)), contactWith(poleOf(60, 220))};
    for (const auto& [friction, factor] : {std::pair(30.0, 0.87702), {35.0, 1.06365}, {40.0, 1.27463}}) {
        const Sliding found = judgedOn(contacts, {joint(friction)});
        CHECK((found.mode == SlidingMode::wedge));
        CHECK(found.factor == doctest::Approx(factor).epsilon(1e-5));
        CHECK(found.planes.size() == 2);
        // Equilibrium across the line.
        Vec3 left = kDown - found.driving * found.direction;
        for (const SlidingPlane& plane : found.planes) left += plane.normal_force * plane.normal;
        CHECK(left.norm() < 1e-9 * kWeight);
    }
}

TEST_CASE("a body that nothing presses falls, and cohesion beside it holds it") {
    const Sliding roof = judgedOn({contactWith(-Vec3::UnitZ())}, {cohesive(40, 1e4)});
    CHECK((roof.mode == SlidingMode::falls));
    CHECK(roof.factor == 0);
    CHECK((roof.direction + Vec3::UnitZ()).norm() < 1e-12);
    const std::vector<Contact> walls{contactWith(Vec3::UnitX(), 3), contactWith(-Vec3::UnitX(), 2)};
    const Sliding between = judgedOn(walls, {cohesive(40, 50)});
    CHECK((between.mode == SlidingMode::falls));
    CHECK(between.factor == doctest::Approx(5 * 50 / kWeight));
    CHECK(judgedOn(walls, {joint(40)}).factor == 0);
    CHECK(judgedOn({}, {joint(40)}).factor == 0);
}

TEST_CASE("a body on level ground, in a corner or without any force has no mode") {
    for (const Vec3& force : {kDown, Vec3(Vec3::Zero())}) {
        const Sliding found = judgedOn({contactWith(Vec3::UnitZ())}, {joint(30)}, force);
        CHECK((found.mode == SlidingMode::none));
        CHECK(found.factor == kInfinity);
        CHECK(found.direction.norm() == 0);
    }
    const std::vector<Contact> corner{contactWith(poleOf(40, 0)), contactWith(poleOf(40, 120)),
                                      contactWith(poleOf(40, 240))};
    CHECK((judgedOn(corner, {joint(1)}).mode == SlidingMode::none));
}

TEST_CASE("contacts of one plane share its normal force by their areas") {
    const Joint smooth = joint(10), rough = joint(40);
    const std::vector<Contact> contacts{contactWith(poleOf(30, 90), 3.0, 0),
                                        contactWith(poleOf(30, 90), 1.0, 1)};
    const double mean = 0.75 * std::tan(radians(10)) + 0.25 * std::tan(radians(40));
    CHECK(judgedOn(contacts, {smooth, rough}).factor == doctest::Approx(mean / std::tan(radians(30))));
}

TEST_CASE("a law that is a curve counts with its strength at the mean normal stress") {
    Joint curved = joint(0);
    curved.law = StrengthLaw::power;
    curved.a = 1.3;
    curved.b = 0.8;
    const double area = 0.4, normal = kWeight * std::cos(radians(35));
    const Sliding found = judgedOn({contactWith(poleOf(35, 10), area)}, {curved});
    CHECK(found.factor ==
          doctest::Approx(area * 1.3 * std::pow(normal / area, 0.8) / (kWeight * std::sin(radians(35)))));
}

TEST_CASE("a contact of a vertex has friction and no cohesion") {
    Contact vertex = contactWith(poleOf(30, 90), 2.0);
    vertex.is_patch = false;
    CHECK(judgedOn({vertex}, {cohesive(25, 1e5)}).factor ==
          doctest::Approx(std::tan(radians(25)) / std::tan(radians(30))));
}

TEST_CASE("on more than two planes the least friction in equilibrium counts") {
    // A prism on its axis, which plunges 20 degrees towards +x, in a trough of many sides.
    const double plunge = radians(20);
    const Vec3 axis(std::cos(plunge), 0, -std::sin(plunge)), up(std::sin(plunge), 0, std::cos(plunge));
    const Vec3 beside = axis.cross(up);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(-80, 80), friction(5, 50);
    for (int k = 0; k < 200; ++k) {
        std::vector<Contact> contacts;
        std::vector<Joint> joints;
        std::vector<double> angles;
        for (std::int32_t j = 0; j < 2 + k % 5; ++j) {
            angles.push_back(radians(angle(random)));
            if (j < 2) angles.back() = (j == 0 ? 1 : -1) * std::abs(angles.back());
            joints.push_back(joint(friction(random)));
            contacts.push_back(
                contactWith(std::cos(angles.back()) * up + std::sin(angles.back()) * beside, 1, j));
        }
        // Every pair of sides that carries the load without tension.
        double least = kInfinity;
        const double load = kWeight * std::cos(plunge);
        for (std::size_t i = 0; i < angles.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double opening = std::sin(angles[i] - angles[j]);
                const double at_i = -load * std::sin(angles[j]) / opening,
                             at_j = load * std::sin(angles[i]) / opening;
                if (at_i < 0 || at_j < 0) continue;
                least = std::min(least,
                                 at_i * std::tan(joints[i].friction) + at_j * std::tan(joints[j].friction));
            }
        const Sliding found = judgedOn(contacts, joints);
        CAPTURE(k);
        CHECK(std::abs(found.direction.dot(axis)) == doctest::Approx(1));
        CHECK(found.factor == doctest::Approx(least / (kWeight * std::sin(plunge))));
    }
}
