// Directions that contacts leave: against brute force, and Goodman and Shi's joint pyramids.

#include "block_theory/cone.h"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "engine/block_theory/drawn_contacts.h"

using namespace talus;
using namespace talus::keyblocks;
using namespace talus::test;

namespace {

double clearance(const Vec3& s, const std::vector<Contact>& contacts) {
    double least = kInfinity;
    for (const Contact& contact : contacts) least = std::min(least, s.dot(contact.normal));
    return least;
}

/// The nearest point of the cone by its definition: of all faces, edges and the corner the one whose
/// projection lies in the cone and is nearest to the force.
Vec3 nearestByEnumeration(const Vec3& force, const std::vector<Contact>& contacts) {
    Vec3 best = Vec3::Zero();
    const auto look = [&](const Vec3& s) {
        if (clearance(s, contacts) >= -1e-9 && (s - force).norm() < (best - force).norm()) best = s;
    };
    look(force);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Vec3& n = contacts[i].normal;
        look(force - force.dot(n) * n);
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3 line = n.cross(contacts[j].normal).normalized();
            look(force.dot(line) * line);
        }
    }
    return best;
}

/// Points spread evenly over the sphere (Fibonacci's spiral).
std::vector<Vec3> sphere(int count) {
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        const double z = 1 - (2.0 * k + 1) / count, turn = k * M_PI * (3 - std::sqrt(5.0));
        points.emplace_back(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    }
    return points;
}

double widestClearance(const std::vector<Vec3>& directions, const std::vector<Contact>& contacts) {
    double widest = -1;
    for (const Vec3& s : directions) widest = std::max(widest, clearance(s, contacts));
    return widest;
}

}  // namespace

TEST_CASE("the direction of sliding is the nearest that contacts leave to the resultant") {
    std::mt19937 random(1);
    int moving = 0;
    for (int k = 0; k < 4000; ++k) {
        const auto contacts = drawnContacts(random, 1 + k % 9);
        const Vec3 force = drawnDirection(random);
        const Vec3 nearest = nearestByEnumeration(force, contacts);
        const Projection found = project(force, contacts);
        CAPTURE(k);
        CHECK((found.along - nearest).norm() < 1e-3);
        // What is pressed is what the direction lies in.
        for (const int pressed : found.pressed)
            if (pressed >= 0)
                CHECK(std::abs(found.along.dot(contacts[static_cast<std::size_t>(pressed)].normal)) < 1e-9);
        if (nearest.norm() > 1e-3) ++moving;
    }
    CHECK(moving > 1000);
    CHECK(moving < 3900);
}

TEST_CASE("a block is removable exactly where some direction of the sphere has no obstructing neighbour") {
    std::mt19937 random(2);
    const std::vector<Vec3> directions = sphere(20000);
    int removable = 0, locked = 0;
    for (int k = 0; k < 300; ++k) {
        const auto contacts = drawnContacts(random, 3 + k % 6);
        const double widest = widestClearance(directions, contacts);
        CAPTURE(k);
        CAPTURE(widest);
        if (isRemovable(contacts)) {
            ++removable;
            CHECK(clearance(freeDirection(contacts), contacts) > -2e-4);
            CHECK(widest > -0.03);  // two points of the sphere are 0.03 apart
        } else {
            ++locked;
            CHECK(widest < 0);
        }
        if (widest > 0) CHECK(isRemovable(contacts));
    }
    CHECK(removable > 50);
    CHECK(locked > 50);
}

TEST_CASE("of the eight joint pyramids of three joints one has no direction into the rock below a face") {
    // Goodman and Shi: the block of a joint pyramid is finite where pyramid and excavation pyramid meet in
    // the origin only, and removable where the joint pyramid itself is not empty.
    const std::vector<Vec3> joints{poleOf(71, 163), poleOf(68, 243), poleOf(45, 280)};
    for (const Vec3& face : {poleOf(60, 90), poleOf(90, 0), poleOf(0, 0), poleOf(60, 300)}) {
        // Each edge of the pyramid that qualifies points out of the face.
        Vec3 edges[3];
        for (std::size_t j = 0; j < 3; ++j) {
            edges[j] = joints[(j + 1) % 3].cross(joints[(j + 2) % 3]);
            if (edges[j].dot(face) < 0) edges[j] = -edges[j];
        }
        int finite = 0;
        for (int code = 0; code < 8; ++code) {
            std::vector<Contact> pyramid;
            bool qualifies = true;
            for (std::size_t j = 0; j < 3; ++j) {
                const double side = (code >> j) % 2 == 0 ? 1.0 : -1.0;  // above or below joint j
                pyramid.push_back(contactWith(side * joints[j]));
                qualifies = qualifies && side * joints[j].dot(edges[j]) > 0;
            }
            CAPTURE(code);
            CHECK(isRemovable(pyramid));
            pyramid.push_back(contactWith(-face));
            CHECK(isRemovable(pyramid) == !qualifies);
            if (qualifies) ++finite;
        }
        CHECK(finite == 1);
    }
}

TEST_CASE("a block between parallel joints slides along them, between three pairs it is locked") {
    const std::vector<Vec3> joints{poleOf(71, 163), poleOf(68, 243), poleOf(45, 280)};
    std::vector<Contact> contacts;
    for (std::size_t pairs = 0; pairs < 3; ++pairs) {
        contacts.push_back(contactWith(joints[pairs]));
        CHECK(isRemovable(contacts));
        contacts.push_back(contactWith(-joints[pairs]));
        CHECK(isRemovable(contacts) == (pairs < 2));
    }
    CHECK(freeDirection(contacts).norm() == 0);
    contacts.resize(4);
    CHECK(std::abs(freeDirection(contacts).dot(joints[0].cross(joints[1]).normalized())) ==
          doctest::Approx(1));
}
