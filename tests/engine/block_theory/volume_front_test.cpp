// The weakest groups by volume, against all groups looked at one by one.

#include "block_theory/volume_front.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace talus;
using namespace talus::keyblocks;

namespace {

Group group(double volume, double factor, std::size_t name) {
    Group made;
    made.volume = volume;
    made.sliding.mode = SlidingMode::slides;
    made.sliding.factor = factor;
    made.members = {name};
    return made;
}

/// The least factor of the groups of at least this volume: sorted by factor, the first that is large enough.
double leastOf(std::vector<Group> groups, double volume) {
    std::sort(groups.begin(), groups.end(),
              [](const Group& a, const Group& b) { return a.sliding.factor < b.sliding.factor; });
    const auto first =
        std::find_if(groups.begin(), groups.end(), [&](const Group& each) { return each.volume >= volume; });
    return first == groups.end() ? kInfinity : first->sliding.factor;
}

/// The same as the front says it.
double firstOf(const std::vector<Group>& front, double volume) {
    const auto first =
        std::find_if(front.begin(), front.end(), [&](const Group& each) { return each.volume >= volume; });
    return first == front.end() ? kInfinity : first->sliding.factor;
}

}  // namespace

TEST_CASE("the front of random groups gives the least factor of each volume") {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        // Whole numbers, so that many are equal in volume, in factor, or in both.
        std::uniform_int_distribution<int> whole(1, round % 2 == 0 ? 12 : 1000);
        std::vector<Group> groups;
        VolumeFront front, half;
        for (std::size_t k = 0; k < 200; ++k) {
            groups.push_back(group(whole(random), 0.1 * whole(random), k));
            (k % 2 == 0 ? front : half).add(groups.back());
        }
        front.add(std::move(half));
        const std::vector<Group> kept = front.take();
        for (const Group& each : groups)
            for (const double volume : {each.volume, each.volume + 0.5})
                CHECK(firstOf(kept, volume) == leastOf(groups, volume));
        for (std::size_t k = 1; k < kept.size(); ++k) {
            CHECK(kept[k - 1].volume < kept[k].volume);
            CHECK(kept[k - 1].sliding.factor < kept[k].sliding.factor);
        }
    }
}

TEST_CASE("what cannot move is no part of the front; of equals the first stays; rounding does not count") {
    VolumeFront front;
    Group still = group(9, kInfinity, 0);
    still.sliding.mode = SlidingMode::none;
    front.add(still);
    CHECK(front.take().empty());
    front.add(group(2, 1.5, 1));
    front.add(group(2, 1.5, 2));
    front.add(group(2, 1.5 + 1e-13, 3));
    front.add(group(2 * (1 + 1e-14), 1.6, 4));
    const std::vector<Group> kept = front.take();
    REQUIRE(kept.size() == 1);
    CHECK(kept[0].members == std::vector<std::size_t>{1});
}
