// Closures of blocks against their definition.

#include "block_theory/closures.h"

#include <doctest/doctest.h>

#include <random>
#include <set>

#include "block_theory/body_maker.h"
#include "block_theory/directions.h"
#include "engine/block_theory/drawn_contacts.h"

using namespace talus;
using namespace talus::keyblocks;
using namespace talus::test;

namespace {

/// Blocks that touch each other at random; the first two are held.
Slope drawnSlope(std::mt19937& random, std::size_t blocks, int contacts) {
    std::vector<std::vector<Contact>> seen(blocks);
    std::uniform_int_distribution<std::size_t> block(0, blocks - 1);
    for (int k = 0; k < contacts; ++k) {
        const std::size_t a = block(random), b = block(random);
        if (a == b) continue;
        Contact contact = contactWith(drawnDirection(random));
        contact.other = static_cast<std::int32_t>(a);
        seen[b].push_back(contact);
        contact.other = static_cast<std::int32_t>(b);
        contact.normal = -contact.normal;
        seen[a].push_back(contact);
    }
    Slope slope;
    slope.begin = {0};
    for (std::size_t b = 0; b < blocks; ++b) {
        slope.contacts.insert(slope.contacts.end(), seen[b].begin(), seen[b].end());
        slope.begin.push_back(slope.contacts.size());
        slope.free.push_back(b > 1);
        slope.mass.push_back(1);
        slope.volume.push_back(1);
        slope.force.emplace_back(0, 0, -10);
    }
    slope.acceleration = Vec3(0, 0, -10);
    return slope;
}

/// By repeating the definition until nothing is added; empty where a held block is among them.
std::set<std::size_t> closureByDefinition(const Slope& slope, std::size_t block, const Vec3& s) {
    std::set<std::size_t> members{block};
    for (std::size_t before = 0; before != members.size();) {
        before = members.size();
        for (const std::size_t b : std::set<std::size_t>(members))
            for (const Contact& contact : slope.contactsOf(b))
                if (contact.normal.dot(s) < -1e-4) members.insert(static_cast<std::size_t>(contact.other));
    }
    for (const std::size_t b : members)
        if (!slope.free[b]) return {};
    return members;
}

}  // namespace

TEST_CASE("the closures of the components' seeds are those of all blocks that can move") {
    std::mt19937 random(4);
    std::size_t moving = 0, locked = 0, shared = 0;
    for (int k = 0; k < 200; ++k) {
        const Slope slope = drawnSlope(random, 30, 40 + k % 30);
        const Vec3 s = drawnDirection(random);
        std::set<std::set<std::size_t>> wanted, found;
        const Movable movable = movableAlong(slope, s);
        for (std::size_t b = 2; b < slope.size(); ++b) {
            const auto closure = closureByDefinition(slope, b, s);
            CHECK((movable.can_move[b] != 0) == !closure.empty());
            closure.empty() ? ++locked : ++moving;
            if (!closure.empty() && !wanted.insert(closure).second) ++shared;
        }
        Marks marks(slope.size());
        for (const std::size_t seed : movable.seeds) {
            std::vector<std::size_t> members{seed};
            marks.clear();
            marks.mark(seed);
            REQUIRE(closeOver(slope, s, 0, slope.size(), marks, members));
            CHECK(found.insert({members.begin(), members.end()}).second);  // each component once
        }
        CHECK(found == wanted);
    }
    CHECK(moving > 500);
    CHECK(locked > 500);
    CHECK(shared > 5);
}

TEST_CASE("a closure with more blocks than wanted, or with a held one, is not complete") {
    Slope slope;
    slope.begin = {0, 1, 3, 4};
    slope.contacts = {contactWith(Vec3::UnitX()), contactWith(-Vec3::UnitX()), contactWith(Vec3::UnitX()),
                      contactWith(-Vec3::UnitX())};
    slope.contacts[0].other = 1;
    slope.contacts[2].other = 2;
    slope.contacts[3].other = 1;
    slope.free = {1, 1, 1};
    slope.mass = {1, 1, 1};
    Marks marks(3);
    const auto closes = [&](const Vec3& s, std::size_t most) {
        std::vector<std::size_t> members{0};
        marks.clear();
        marks.mark(0);
        return closeOver(slope, s, 0, most, marks, members);
    };
    CHECK(closes(-Vec3::UnitX(), 3));
    CHECK(!closes(-Vec3::UnitX(), 2));
    slope.free[2] = 0;
    CHECK(!closes(-Vec3::UnitX(), 3));
    CHECK(closes(Vec3::UnitX(), 3));
}

TEST_CASE("directions are bounded, different, and each drives") {
    std::mt19937 random(5);
    const Slope slope = drawnSlope(random, 300, 1500);
    const Directions directions = directionsOf(slope);
    CHECK(directions.everywhere.size() == kMostDirections);
    CHECK(!directions.own.empty());
    for (std::size_t k = 0; k < directions.everywhere.size(); ++k) {
        CHECK(directions.everywhere[k].norm() == doctest::Approx(1));
        CHECK(directions.everywhere[k].dot(slope.acceleration) > 0);
        for (std::size_t j = 0; j < k; ++j)
            CHECK((directions.everywhere[k] - directions.everywhere[j]).norm() > 1e-6);
    }
}
