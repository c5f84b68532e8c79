// Candidate axes of two convex parts against their definitions, one by one.

#include "contacts/separating_axes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "contacts/vertex_edge_points.h"
#include "engine/geometry/random_shapes.h"
#include "geometry/separation.h"

using namespace talus;
using namespace talus::axes;
using namespace talus::test;

namespace {

constexpr int kTrials = 40;

/// A hull of so many points at most, somewhere about the origin.
Placed hull(Random& random, int points, double spread) {
    return Placed(moved(randomPolyhedron(random, points), random.rotation(), random.inBox(spread)));
}

bool differ(double a, double b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

/// Whether the arcs of two edges cross on the Gauss map, by all four normals.
bool arcsCross(const Pair& pair, const Edge& first, const Edge& second) {
    const auto of_second = [&](std::int32_t face) {
        return pair.second.normals[static_cast<std::size_t>(face)].dot(first.arc);
    };
    const auto of_first = [&](std::int32_t face) {
        return pair.first.normals[static_cast<std::size_t>(face)].dot(second.arc);
    };
    return differ(of_second(second.left), of_second(second.right)) &&
           differ(of_first(first.left), of_first(first.right)) &&
           differ(of_second(second.left), of_first(first.right));
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE("GaussMap: the edges that cross an edge are those whose arcs do, in order") {
        Random random(401);
        std::size_t crossings = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            // Some need more memory than the pair has itself.
            const Placed first = hull(random, 4 + 3 * trial, 1), second = hull(random, 10, 1);
            const WorldShape world_1 = first.world(), world_2 = second.world();
            Pair pair(world_1, world_2);
            findEdges(world_1, pair.first_edges);
            findEdges(world_2, pair.second_edges);
            GaussMap map(pair);
            for (std::size_t e = 0; e < pair.first_edges.size(); ++e) {
                std::vector<std::size_t> expected, found;
                for (std::size_t f = 0; f < pair.second_edges.size(); ++f)
                    if (arcsCross(pair, pair.first_edges[e], pair.second_edges[f])) expected.push_back(f);
                CHECK(map.eachCrossing(e, [&](std::size_t f) {
                    found.push_back(f);
                    return true;
                }));
                CHECK(found == expected);
                CHECK(map.eachCrossing(e, [](std::size_t) { return false; }) == expected.empty());
                crossings += expected.size();
            }
        }
        CHECK(crossings > 20 * kTrials);
    }

    TEST_CASE("forEachAxis: the farthest of the axes is the separation, also in pairs that overlap") {
        Random random(402);
        for (int trial = 0; trial < kTrials; ++trial) {
            CAPTURE(trial);
            const Placed first = hull(random, 9, 1), second = hull(random, 9, 1);
            const WorldShape world_1 = first.world(), world_2 = second.world();
            Pair pair(world_1, world_2);
            double most = -1e300;
            forEachAxis(pair, [&](const SeparatingAxis& axis) {
                most = std::max(most, axis.distance);
                return true;
            });
            const double apart = separation(first.shape, second.shape);
            if (apart < 0) CHECK(most == within(1e-9, apart));
            if (apart >= 0) CHECK(most <= apart * (1 + 1e-9));
        }
    }

    TEST_CASE("mostAlong: no axis of an edge is farther, whichever vertex is asked") {
        Random random(404);
        std::size_t bounded = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            CAPTURE(trial);
            const Placed first = hull(random, 12, 0.7), second = hull(random, 9, 0.7);
            const WorldShape world_1 = first.world(), world_2 = second.world();
            Pair pair(world_1, world_2);
            std::vector<double> farthest(1000, -1e300);  // by edge of the first
            forEachAxis(pair, [&](const SeparatingAxis& axis) {
                double& most = farthest[static_cast<std::size_t>(axis.face)];
                if (axis.is_edges) most = std::max(most, axis.distance);
                return true;
            });
            for (std::size_t e = 0; e < pair.first_edges.size(); ++e)
                for (std::size_t v = 0; v < world_2.vertices.size(); ++v) {
                    const double bound = mostAlong(pair, pair.first_edges[e], static_cast<std::int32_t>(v));
                    CHECK(farthest[e] <= bound);
                    bounded += bound < 0 ? 1 : 0;
                }
        }
        CHECK(bounded > 100 * kTrials);
    }

    TEST_CASE("forEachAxis: what a floor leaves out, or knows no better, lies below it") {
        Random random(405);
        std::size_t left_out = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            CAPTURE(trial);
            const Placed first = hull(random, 12, 0.7), second = hull(random, 9, 0.7);
            const WorldShape world_1 = first.world(), world_2 = second.world();
            const double floor = random.uniform(-0.8, 0.1);
            const auto above = [&](const auto& floor_of) {
                Pair pair(world_1, world_2);
                std::vector<double> distances;
                std::size_t looked_at = 0;
                forEachAxis(
                    pair,
                    [&](const SeparatingAxis& axis) {
                        ++looked_at;
                        if (axis.distance > floor) distances.push_back(axis.distance);
                        return true;
                    },
                    floor_of);
                return std::pair(distances, looked_at);
            };
            const auto all = above([](bool) { return -1e300; }), some = above([&](bool) { return floor; });
            CHECK(some.first == all.first);
            left_out += all.second - some.second;
        }
        CHECK(left_out > 5 * kTrials);
    }

    TEST_CASE("areApart: where a face's plane parts them by more than the distance, and only there") {
        Random random(403);
        int apart = 0;
        for (int trial = 0; trial < 5 * kTrials; ++trial) {
            const Placed first = hull(random, 9, 1.5), second = hull(random, 9, 1.5);
            const WorldShape world_1 = first.world(), world_2 = second.world();
            const Pair pair(world_1, world_2);
            double most = -1e300;
            for (const bool of_second : {false, true})
                for (std::size_t face = 0; face < pair.shape(of_second).faces.size(); ++face)
                    most = std::max(most, faceAxis(pair, of_second, face).distance);
            CHECK_FALSE(areApart(world_1, world_2, most));
            CHECK(areApart(world_1, world_2, most - 1e-9));
            for (const double distance : {-0.1, 0.0, 0.3})
                CHECK(areApart(world_1, world_2, distance) == (most > distance));
            apart += most > 0 ? 1 : 0;
        }
        CHECK(apart > kTrials);
        CHECK(apart < 4 * kTrials);
    }
}
