// Fixed blocks are found through a tree: against all pairs of boxes, against the same search without it, and
// by the number of visited parts.

#include "contacts/near_pairs.h"

#include <doctest/doctest.h>

#include <memory>

#include "build/build.h"
#include "contacts/pair_search.h"
#include "engine/geometry/random_shapes.h"
#include "state/placed_shape.h"
#include "support/bodies.h"
#include "support/models.h"
#include "support/slower.h"
#include "support/terrains.h"
#include "talus/surface.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr int kTrials = kTriesFew ? 1 : 5;

/// A terrain of 2 n^2 triangles as one fixed body, and hulls above it that may move.
State rocksOver(Ground ground, int n, int rocks, Random& random) {
    Model model = floorModel(30);
    model.blocks.clear();
    addBody(model, "ground", *solidOf(closeTerrain(terrainOf(ground, n), -6)->surface), Motion::fixed);
    addBody(model, "shelf", *makeBox({-9, 0, 0}, {-1, 4, 1}), Motion::fixed);
    for (int k = 0; k < rocks; ++k) {
        std::vector<Vec3> points = randomPoints(random, 9);
        for (Vec3& x : points) x += Vec3(0, 0, 1000 + 10 * k);
        addBody(model, "rock " + std::to_string(k), *convexHull(points));
    }
    addBody(model, "sledge",
            moved(*makeBox({0, 0, 0}, {2, 1, 1}), Eigen::Quaterniond::Identity(), {0, 0, 900}),
            Motion::driven);
    return *buildState(std::move(model), false);
}

/// Anywhere over the terrain, some in the ground, turned by chance.
void scatter(State& state, double extent, Random& random) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::fixed) continue;
        const double x = random.uniform(-9, extent), y = random.uniform(0, extent);
        state.blocks.position.set(b, {x, y, 0.3 * x + random.uniform(-1, 4)});
        const Eigen::Quaterniond turn(random.rotation());
        state.blocks.orientation[b] = {turn.w(), turn.x(), turn.y(), turn.z()};
    }
}

/// The same state without known fixed shapes.
State withoutTree(const State& state) {
    auto geometry = std::make_shared<Geometry>(*state.geometry);
    geometry->fixed = {};
    State same = state;
    same.geometry = geometry;
    return same;
}

PartPairs allPairs(const State& state, double margin) {
    std::vector<Box> boxes;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        for (const Polyhedron& part : partsOf(placedShape(state, b))) {
            Box box;
            for (const Vec3& v : part.vertices) box.add(v);
            boxes.push_back(box.grown(0.5 * margin));
        }
    PartPairs pairs;
    const auto block = [&](std::size_t part) {
        return static_cast<std::size_t>(state.geometry->part_block[part]);
    };
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            const bool can_move = state.blocks.motion[block(i)] != Motion::fixed ||
                                  state.blocks.motion[block(j)] != Motion::fixed;
            if (can_move && boxes[i].meets(boxes[j]))
                pairs.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
        }
    return pairs;
}

PartPairs near(const State& state, const SearchRange& range, bool parallel, SearchWork& work) {
    return nearPairs(state, PlacedShapes(state, range, parallel), range, parallel, work);
}

std::vector<PairFinding> findings(const State& state, const SearchRange& range, SearchWork* work = nullptr) {
    std::vector<PairFinding> found;
    examinePairs(
        state, range, {}, false, false,
        [&](const PairFinding& finding) {
            if (!finding.faces.empty() || finding.may_meet_by_vertices) found.push_back(finding);
        },
        {}, work);
    return found;
}

void checkSame(const std::vector<PairFinding>& a, const std::vector<PairFinding>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        CHECK(a[k].part_a == b[k].part_a);
        CHECK(a[k].part_b == b[k].part_b);
        CHECK(a[k].may_meet_by_vertices == b[k].may_meet_by_vertices);
        REQUIRE(a[k].faces.size() == b[k].faces.size());
        for (std::size_t f = 0; f < a[k].faces.size(); ++f) {
            CHECK(a[k].faces[f].face_a == b[k].faces[f].face_a);
            CHECK(a[k].faces[f].face_b == b[k].faces[f].face_b);
            CHECK(a[k].faces[f].gap == b[k].faces[f].gap);
            CHECK(area(a[k].faces[f].patch) == area(b[k].faces[f].patch));
        }
    }
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE("nearPairs: of rocks over any terrain all pairs of boxes that meet, in order, and no others") {
        Random random(311);
        std::size_t with_ground = 0;
        for (const Ground ground : kGrounds) {
            State state = rocksOver(ground, 6, 40, random);
            for (int trial = 0; trial < kTrials; ++trial) {
                scatter(state, 12, random);
                const SearchRange range{.margin = random.uniform(0.01, 0.5)};
                const PartPairs expected = allPairs(state, range.margin);
                SearchWork work;
                CHECK(near(state, range, false, work) == expected);
                CHECK(near(state, range, true, work) == expected);
                with_ground += expected.size();
            }
        }
        CHECK(with_ground > 200 * kTrials);
    }

    TEST_CASE("examinePairs: the tree of fixed parts changes nothing in what is found, bit for bit") {
        Random random(312);
        std::size_t found = 0, around = 0;
        for (const Ground ground : kGrounds) {
            State state = rocksOver(ground, 6, 40, random);
            for (int trial = 0; trial < kTrials; ++trial) {
                scatter(state, 12, random);
                SearchRange range{.margin = 0.1, .ahead = 0.001};
                const State plain = withoutTree(state);
                const auto all = findings(state, range);
                checkSame(all, findings(plain, range));
                found += all.size();
                range.around.assign(state.blocks.size(), 0);
                for (std::size_t b = 2; b < state.blocks.size(); b += 5) range.around[b] = 1;
                range.near = blocksNear(state, range.around, range.margin);
                const auto some = findings(state, range);
                checkSame(some, findings(plain, range));
                around += some.size();
            }
        }
        CHECK(found > 100 * kTrials);
        CHECK(around > 10 * kTrials);
        CHECK(around < found);
    }

    TEST_CASE("nearPairs: a fixed block that a frame has put elsewhere is looked for where it is") {
        Random random(313);
        State state = rocksOver(Ground::rough, 6, 40, random);
        scatter(state, 12, random);
        CHECK(standsAsBuilt(state, 0));
        state.blocks.position.set(0, state.blocks.position.get(0) + Vec3(0.5, 0.25, -1));
        CHECK_FALSE(standsAsBuilt(state, 0));
        CHECK(standsAsBuilt(state, 1));
        SearchWork work;
        const PartPairs pairs = near(state, {.margin = 0.1}, false, work), expected = allPairs(state, 0.1);
        for (const BoxPair& pair : expected) CHECK(std::binary_search(pairs.begin(), pairs.end(), pair));
        checkSame(findings(state, {.margin = 0.1}), findings(withoutTree(state), {.margin = 0.1}));
    }

    TEST_CASE("examinePairs: what a search looks at does not grow with the ground") {
        struct Count {
            std::size_t triangles;
            SearchWork work;
        };
        std::vector<Count> counts, above;
        const std::vector<int> sizes = kTriesFew ? std::vector{8, 16} : std::vector{8, 16, 32, 64};
        for (const int n : sizes) {
            Random random(314);
            State state = rocksOver(Ground::hill, n, 20, random);
            // Side by side on the even slope before the hill.
            for (std::size_t b = 2; b < state.blocks.size(); ++b) {
                const double x = 1.0 + 0.5 * static_cast<double>(b);
                state.blocks.position.set(b, {x, 1.0, 0.2 * x + 0.5});
            }
            counts.push_back({static_cast<std::size_t>(2 * n * n), {}});
            CHECK_FALSE(findings(state, {.margin = 0.05}, &counts.back().work).empty());
            for (std::size_t b = 2; b < state.blocks.size(); ++b)
                state.blocks.position.set(b, state.blocks.position.get(b) + Vec3(0, 0, 1000));
            above.push_back({static_cast<std::size_t>(2 * n * n), {}});
            findings(state, {.margin = 0.05}, &above.back().work);
        }
        for (std::size_t k = 0; k < counts.size(); ++k) {
            CAPTURE(counts[k].triangles);
            MESSAGE(counts[k].triangles << " triangles: " << counts[k].work.placed_faces << " faces placed, "
                                        << counts[k].work.boxes << " boxes compared, " << counts[k].work.pairs
                                        << " pairs");
            CHECK(counts[k].work.placed_faces == counts[0].work.placed_faces);
            CHECK(counts[k].work.pairs < 2 * counts[0].work.pairs);
            CHECK(counts[k].work.boxes < 4 * counts[0].work.boxes);  // as the tree is deep
            // Far from the ground one look at the root of the tree a rock.
            CHECK(above[k].work.boxes == 21);
            CHECK(above[k].work.placed_faces == counts[0].work.placed_faces);
        }
    }
}
