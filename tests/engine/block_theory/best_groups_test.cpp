// The kept groups among many.

#include "block_theory/best_groups.h"

#include <doctest/doctest.h>

#include "block_theory/body_maker.h"

using namespace talus;
using namespace talus::keyblocks;

namespace {

Group group(double factor, std::vector<std::size_t> members) {
    Group made;
    made.identity = BodyMaker::identityOf(members);
    made.mass = static_cast<double>(members.size());
    made.members = std::move(members);
    made.sliding.mode = SlidingMode::slides;
    made.sliding.factor = factor;
    return made;
}

std::vector<double> factorsOf(BestGroups& best) {
    std::vector<double> factors;
    for (const Group& each : best.sorted()) factors.push_back(each.sliding.factor);
    return factors;
}

}  // namespace

TEST_CASE("the weakest groups are kept, each once, whatever the order of their members") {
    BestGroups best(3);
    for (const double factor : {5.0, 2.0, 4.0, 3.0, 1.0}) {
        best.add(group(factor, {1, static_cast<std::size_t>(factor) + 1}));
        best.add(group(factor, {static_cast<std::size_t>(factor) + 1, 1}));
    }
    CHECK(factorsOf(best) == std::vector<double>{1, 2, 3});
    for (std::size_t k = 10; k < 30; ++k) best.add(group(3.5, {k}));
    best.add(group(0.5, {7, 8}));
    CHECK(factorsOf(best) == std::vector<double>{0.5, 1, 2});
    BestGroups others(3);
    others.add(group(0.7, {9}));
    best.add(std::move(others));
    CHECK(factorsOf(best) == std::vector<double>{0.5, 0.7, 1});
}

TEST_CASE("a part of a group with the same factor is left out, a part with another is kept") {
    BestGroups best(10);
    best.add(group(1.5, {2, 3}));
    best.add(group(1.5 + 1e-13, {1, 2, 3, 4}));
    best.add(group(1.5, {4, 5}));
    best.add(group(1.6, {1, 2}));
    const std::vector<Group>& kept = best.sorted();
    REQUIRE(kept.size() == 3);
    CHECK(kept[0].members == std::vector<std::size_t>{1, 2, 3, 4});
    CHECK(kept[1].members == std::vector<std::size_t>{4, 5});
    CHECK(kept[2].members == std::vector<std::size_t>{1, 2});
}

TEST_CASE("groups that cannot move are not kept") {
    BestGroups best(2);
    Group locked = group(1, {1});
    locked.sliding.mode = SlidingMode::none;
    best.add(std::move(locked));
    CHECK(best.take().empty());
}
