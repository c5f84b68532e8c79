#include "contacts/neighbours.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "engine/geometry/random_shapes.h"

using namespace talus;
using namespace talus::test;

namespace {

std::vector<BoxPair> findNeighboursBruteForce(const std::vector<Box>& boxes) {
    std::vector<BoxPair> pairs;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            bool apart = false;
            for (int axis = 0; axis < 3; ++axis)
                apart |= boxes[i].max[axis] < boxes[j].min[axis] || boxes[j].max[axis] < boxes[i].min[axis];
            if (!apart) pairs.emplace_back(i, j);
        }
    return pairs;
}

void checkAgainstBruteForce(const std::vector<Box>& boxes) {
    const auto expected = findNeighboursBruteForce(boxes);
    CHECK(findNeighbours(boxes, false) == expected);
    CHECK(findNeighbours(boxes, true) == expected);
}

Box boxAt(const Vec3& min, const Vec3& size) { return {min, min + size}; }

/// A wall of equal boxes that touch exactly, as far as rounding lets them.
std::vector<Box> stack(int nx, int ny, int nz, const Vec3& size, const Vec3& origin) {
    std::vector<Box> boxes;
    for (int x = 0; x < nx; ++x)
        for (int y = 0; y < ny; ++y)
            for (int z = 0; z < nz; ++z)
                boxes.push_back({origin + size.cwiseProduct(Vec3(x, y, z)),
                                 origin + size.cwiseProduct(Vec3(x + 1, y + 1, z + 1))});
    return boxes;
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE("random boxes of similar size") {
        Random random(51);
        for (const int count : {2, 3, 10, 100, 1500}) {
            std::vector<Box> boxes;
            for (int i = 0; i < count; ++i)
                boxes.push_back(boxAt(random.inBox(3), Vec3::Constant(0.5) + random.inBox(0.2)));
            checkAgainstBruteForce(boxes);
        }
    }

    TEST_CASE("random boxes of sizes over six decades, and some huge ones") {
        Random random(52);
        for (int trial = 0; trial < 10; ++trial) {
            std::vector<Box> boxes;
            for (int i = 0; i < 800; ++i) {
                const double scale = std::pow(10, random.uniform(-5, 1));
                boxes.push_back(boxAt(random.inBox(5), scale * (Vec3::Constant(1.1) + random.inBox(1))));
            }
            boxes.push_back({{-100, -100, -100}, {100, 100, -4}});
            boxes.insert(boxes.begin() + 7, {{-1000, -1, -1000}, {1000, 1, 1000}});
            checkAgainstBruteForce(boxes);
        }
    }

    TEST_CASE("a stack on a floor: touching counts, to the last bit of the coordinates") {
        for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(1000, -300, 7), Vec3(-0.7, 1e5, -1e5)}) {
            auto boxes = stack(9, 7, 8, {0.2, 0.1, 0.1}, origin);
            boxes.push_back({origin - Vec3(1, 1, 0.1), origin + Vec3(3, 3, 0)});
            checkAgainstBruteForce(boxes);
        }
        // Powers of two touch without rounding: each inner box has 26 neighbours.
        const auto exact = stack(4, 4, 4, {0.25, 0.25, 0.5}, Vec3::Zero());
        CHECK(findNeighbours(exact, false).size() == (10 * 10 * 10 - 64) / 2);
    }

    TEST_CASE("boxes without width, in one plane, on one line, in one place") {
        Random random(53);
        std::vector<Box> plane, line, points, same(40, boxAt({1, 2, 3}, {1, 1, 1}));
        for (int i = 0; i < 300; ++i) {
            plane.push_back(
                boxAt({random.uniform(0, 9), random.uniform(0, 9), 2}, {random.uniform(0, 1), 0.5, 0}));
            line.push_back(boxAt({random.uniform(0, 50), 0, 0}, {random.uniform(0, 1), 0, 0}));
            points.push_back(boxAt(Vec3(random.integer(0, 3), random.integer(0, 3), 0), Vec3::Zero()));
        }
        for (const auto& boxes : {plane, line, points, same}) checkAgainstBruteForce(boxes);
        CHECK(findNeighbours({}, true).empty());
        CHECK(findNeighbours({boxAt({0, 0, 0}, {1, 1, 1})}, true).empty());
    }

    TEST_CASE("slender boxes in all three directions, and one far away") {
        Random random(54);
        std::vector<Box> boxes{boxAt({1e7, -1e7, 1e7}, {1, 1, 1})};
        for (int i = 0; i < 900; ++i) {
            Vec3 size(0.1, 0.1, 0.1);
            size[i % 3] = random.uniform(0.5, 4);
            boxes.push_back(boxAt(random.inBox(4), size));
        }
        checkAgainstBruteForce(boxes);
    }

    TEST_CASE("any number of threads gives the same pairs") {
        Random random(55);
        std::vector<Box> boxes;
        for (int i = 0; i < 30000; ++i)
            boxes.push_back(boxAt(random.inBox(10), Vec3::Constant(random.uniform(0.2, 1.5))));
        boxes.push_back(boxAt(Vec3::Constant(-20), Vec3(40, 40, 15)));
        const auto serial = findNeighbours(boxes, false);
        CHECK(serial.size() > 100000);
        CHECK(std::is_sorted(serial.begin(), serial.end()));
        // More threads than cores, where there are few.
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        for (const int threads : {1, 2, 4}) {
            tbb::task_arena arena(threads);
            CHECK(arena.execute([&] { return findNeighbours(boxes, true); }) == serial);
        }
    }

    TEST_CASE("findNearMarked: all that overlap a marked box are near it, and of many boxes few others") {
        Random random(83);
        for (int packing = 0; packing < 60; ++packing) {
            const double spread = random.uniform(1, 30);
            std::vector<Box> boxes{boxAt({-50, -50, -2}, {100, 100, 1})};  // a floor under all
            for (int k = 0; k < 300; ++k)
                boxes.push_back(boxAt(random.inBox(spread), Vec3::Constant(1.1) + random.inBox(1)));
            std::vector<char> marked(boxes.size());
            for (std::size_t k = 1; k < boxes.size(); ++k) marked[k] = random.uniform(0, 1) < 0.03;
            const std::vector<char> near = findNearMarked(boxes, marked);
            for (std::size_t i = 0; i < boxes.size(); ++i)
                for (std::size_t j = 0; j < boxes.size(); ++j)
                    if (marked[j] && boxes[i].meets(boxes[j])) REQUIRE(near[i]);
        }
        const std::vector<Box> wall = stack(20, 20, 20, {1, 2, 3}, {5, 6, 7});
        std::vector<char> one(wall.size());
        CHECK(findNearMarked(wall, one) == one);
        one[4321] = 1;
        const std::vector<char> near = findNearMarked(wall, one);
        const auto count = std::count(near.begin(), near.end(), 1);
        CHECK(count == 27);
        CHECK(findNearMarked({}, {}).empty());
        CHECK(findNearMarked({boxAt({1, 1, 1}, {0, 0, 0})}, {1}) == std::vector<char>{1});
    }
}
