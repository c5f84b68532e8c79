// The search of pairs against all pairs of blocks, one by one.

#include "contacts/pair_search.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "build/build.h"
#include "contacts/limits.h"
#include "contacts/vertex_edge_points.h"
#include "engine/geometry/random_shapes.h"
#include "geometry/separation.h"
#include "state/placed_shape.h"
#include "support/bodies.h"
#include "support/models.h"
#include "support/terrains.h"
#include "talus/surface.h"

using namespace talus;
using namespace talus::test;

namespace {

using Findings = std::map<BoxPair, PairFinding>;

Findings examine(const State& state, double margin, bool initial, bool parallel,
                 const KnownPairs& known = {}) {
    Findings findings;
    BoxPair last{-1, -1};
    examinePairs(state, {margin, 0.0}, known, initial, parallel, [&](const PairFinding& finding) {
        if (finding.block_a == finding.block_b) return;  // neither of the two can move
        const BoxPair pair = std::minmax(finding.block_a, finding.block_b);
        CHECK(last < pair);  // in order, each once
        last = pair;
        findings[pair] = finding;
    });
    return findings;
}

/// Hulls and boxes of different sizes over a floor, some of them fixed, apart or overlapping by up to `deep`
/// of their size: built apart, then moved by hand.
State packing(Random& random, int blocks, double spread) {
    Model model = floorModel(30);
    for (int b = 0; b < blocks; ++b) {
        const double size = random.uniform(0.1, 0.5);
        Block block = box("block " + std::to_string(b), Vec3::Zero(), Vec3::Constant(size));
        if (b % 3 != 0) {
            std::vector<Vec3> points = randomPoints(random, 10);
            for (Vec3& x : points) x *= size;
            block.shape = *convexHull(points);
            block.face_joint.assign(block.shape.faces.size(), 0);
        }
        for (Vec3& v : block.shape.vertices) v += Vec3(0, 0, 10.0 + 3.0 * b);
        block.motion = b % 7 == 6 ? Motion::fixed : Motion::free;
        model.blocks.push_back(block);
    }
    State state = *buildState(model, false);
    for (std::size_t b = 1; b < state.blocks.size(); ++b) {
        state.blocks.position.set(
            b, {random.uniform(0, spread), random.uniform(0, spread), random.uniform(0.2, spread)});
        const Eigen::Quaterniond turn(random.rotation());
        state.blocks.orientation[b] = {turn.w(), turn.x(), turn.y(), turn.z()};
    }
    return state;
}

bool moves(const State& state, std::int32_t block) {
    return state.blocks.motion[static_cast<std::size_t>(block)] == Motion::free;
}

template <class Each>
void forAllPairs(const State& state, const Each& each) {
    std::vector<Polyhedron> shapes;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) shapes.push_back(placedShape(state, b));
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(shapes.size()); ++a)
        for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(shapes.size()); ++b)
            if (moves(state, a) || moves(state, b))
                each(a, b, shapes[static_cast<std::size_t>(a)], shapes[static_cast<std::size_t>(b)]);
}

double smallerSize(const State& state, std::int32_t a, std::int32_t b) {
    return std::min(state.geometry->size[static_cast<std::size_t>(a)],
                    state.geometry->size[static_cast<std::size_t>(b)]);
}

/// A rough hillside cut by three joint sets: bodies of many parts beside each other.
Model jointedTerrain(Ground ground, double spacing) {
    RockMass rock;
    rock.region = closeTerrain(terrainOf(ground, 8), -4)->surface;
    for (const auto& [dip, direction] :
         {std::pair(20.0, 270.0), std::pair(75.0, 80.0), std::pair(85.0, 0.0)}) {
        JointSet set;
        set.dip = radians(dip);
        set.dip_direction = radians(direction);
        set.spacing = spacing;
        rock.sets.push_back(set);
    }
    Model model = floorModel(30);
    model.blocks.clear();
    const CutRockMass cut = *cutRockMass(rock);
    for (const CutBlock& block : cut.blocks)
        addBody(model, "b" + std::to_string(model.blocks.size()), block.shape,
                block.volume > 100 ? Motion::fixed : Motion::free);
    return model;
}

/// As far as a block may go, and turn, before it makes a search.
void moveByChance(State& state, std::size_t b, double margin, Random& random) {
    if (state.blocks.motion[b] == Motion::fixed) return;
    const double far = std::min(kTravelLimit * state.geometry->size[b], kShareOfMargin * margin);
    const double turn = random.uniform(0, std::min(kTurnLimit, far / state.geometry->radius[b]));
    const Vec3 axis = random.rotation() * Vec3::UnitX(), way = random.rotation() * Vec3::UnitX();
    const Eigen::Quaterniond old(state.blocks.orientation.matrix(b)),
        now = Eigen::Quaterniond(Eigen::AngleAxisd(turn, axis)) * old;
    state.blocks.orientation[b] = {now.w(), now.x(), now.y(), now.z()};
    state.blocks.position.set(b,
                              state.blocks.position.get(b) + (far - turn * state.geometry->radius[b]) * way);
}

/// How deep two parts are in each other by vertices and edges; 0 where they are not [m].
double vertexEdgeDepth(const State& state, const PairFinding& pair) {
    const PlacedPart first(state, pair.part_a), second(state, pair.part_b);
    const VertexEdgeLimits limits = vertexEdgeLimits(*state.geometry, static_cast<std::size_t>(pair.block_a),
                                                     static_cast<std::size_t>(pair.block_b), 0.0);
    double deepest = 0;
    const VertexEdgePoints points = findVertexEdgePoints(first.world(), second.world(), limits);
    for (const VertexEdgePoint& point : points) deepest = std::max(deepest, -point.gap);
    return deepest;
}

bool has(const Findings& findings, BoxPair pair) {
    const auto found = findings.find(pair);
    return found != findings.end() && (!found->second.faces.empty() || found->second.may_meet_by_vertices);
}

void checkSame(const Findings& a, const Findings& b) {
    REQUIRE(a.size() == b.size());
    for (const auto& [pair, one] : a) {
        const auto other = b.find(pair);
        REQUIRE(other != b.end());
        CHECK(one.block_a == other->second.block_a);
        CHECK(one.may_meet_by_vertices == other->second.may_meet_by_vertices);
        CHECK(one.overlaps == other->second.overlaps);
        CHECK(one.depth == other->second.depth);
        REQUIRE(one.faces.size() == other->second.faces.size());
        for (std::size_t k = 0; k < one.faces.size(); ++k) {
            CHECK(one.faces[k].face_a == other->second.faces[k].face_a);
            CHECK(one.faces[k].gap == other->second.faces[k].gap);
        }
    }
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE(
        "examinePairs: of random packings no pair that touches is missed and none that is far is found") {
        Random random(91);
        int touching = 0, far = 0;
        for (int trial = 0; trial < 6; ++trial) {
            CAPTURE(trial);
            const State state = packing(random, 30, trial % 2 == 0 ? 2.0 : 3.5);
            const double margin = 0.02;
            const Findings findings = examine(state, margin, false, false);
            forAllPairs(state, [&](std::int32_t a, std::int32_t b, const Polyhedron& first,
                                   const Polyhedron& second) {
                CAPTURE(a);
                CAPTURE(b);
                const double apart = separation(first, second), size = smallerSize(state, a, b);
                if (apart <= 0) {
                    ++touching;
                    CHECK(has(findings, {a, b}));
                }
                // What it foresees beside the margin.
                const double reach = margin + 2.0 * (kTravelLimit + kTurnLimit) * size;
                if (apart <= reach) return;
                ++far;
                CHECK_FALSE(has(findings, {a, b}));
            });
            for (const auto& [pair, finding] : findings)
                CHECK((moves(state, pair.first) || moves(state, pair.second)));
            checkSame(findings, examine(state, margin, false, true));
        }
        CHECK(touching > 50);
        CHECK(far > 1000);
    }

    TEST_CASE("examinePairs: at the start it finds every overlap, and its depth") {
        Random random(92);
        int overlapping = 0;
        for (int trial = 0; trial < 4; ++trial) {
            const State state = packing(random, 30, 2.2);
            const Findings findings = examine(state, 0.02, true, trial % 2 == 0);
            forAllPairs(state, [&](std::int32_t a, std::int32_t b, const Polyhedron& first,
                                   const Polyhedron& second) {
                CAPTURE(a);
                CAPTURE(b);
                const double depth = -separation(first, second);
                const auto found = findings.find({a, b});
                const bool said = found != findings.end() && found->second.overlaps;
                CHECK(said == (depth > kClosedGap * smallerSize(state, a, b)));
                if (!said) return;
                ++overlapping;
                CHECK(found->second.depth == within(1e-9, depth));
            });
        }
        CHECK(overlapping > 30);
    }

    TEST_CASE(
        "examinePairs: faces are left out by the whole depth of their blocks, however little is looked at") {
        Random random(95);
        std::size_t kept = 0, left_out = 0;
        for (int trial = 0; trial < 6; ++trial) {
            const State state = packing(random, 30, 1.2);
            const double margin = 0.02;
            const Findings findings = examine(state, margin, false, false);
            for (const auto& [blocks, finding] : findings) {
                const auto a = static_cast<std::size_t>(finding.block_a),
                           b = static_cast<std::size_t>(finding.block_b);
                const double size = smallerSize(state, finding.block_a, finding.block_b);
                const Placed first(placedShape(state, a)), second(placedShape(state, b));
                std::vector<FacePair> expected = findFacePairs(first.world(), second.world(),
                                                               {.max_gap = margin,
                                                                .max_overlap = 0.5 * size,
                                                                .max_angle = 0.8,
                                                                .touching_angle = kFaceAngle,
                                                                .angle_per_depth = kFaceAnglePerDepth,
                                                                .size = size});
                const double closed = kClosedGap * size;
                const double depth = std::max(0.0, -separation(first.shape, second.shape));
                left_out += expected.size();
                std::erase_if(expected,
                              [&](const FacePair& pair) { return -pair.least_gap > 2.0 * depth + closed; });
                left_out -= expected.size();
                const auto faces = [&](const std::vector<FacePair>& pairs) {
                    std::vector<std::pair<std::int32_t, std::int32_t>> numbers;  // but of slivers
                    for (const FacePair& pair : pairs)
                        if (area(pair.patch) >= vertexEdgeArea(*state.geometry, a, b))
                            numbers.emplace_back(pair.face_a, pair.face_b);
                    return numbers;
                };
                CHECK(faces(finding.faces) == faces(expected));
                kept += expected.size();
            }
        }
        CHECK(kept > 50);
        CHECK(left_out > 20);
    }

    TEST_CASE("examinePairs: the faces of a pressed pair are those that findFacePairs finds there") {
        const State state = *buildState(stackModel(5, 4, 3, 30), false);
        const double margin = 0.005;
        const Findings findings = examine(state, margin, false, false);
        std::size_t faces = 0;
        forAllPairs(
            state, [&](std::int32_t a, std::int32_t b, const Polyhedron& first, const Polyhedron& second) {
                const Placed placed_1(first), placed_2(second);
                const auto expected =
                    findFacePairs(placed_1.world(), placed_2.world(),
                                  {.max_gap = margin, .max_overlap = margin, .max_angle = 1e-3});
                const auto found = findings.find({a, b});
                REQUIRE((found == findings.end() ? 0 : found->second.faces.size()) == expected.size());
                faces += expected.size();
                if (expected.empty()) return;
                const bool in_order = found->second.block_a == a;
                CHECK(expected[0].face_a ==
                      (in_order ? found->second.faces[0].face_a : found->second.faces[0].face_b));
                CHECK(expected[0].face_b ==
                      (in_order ? found->second.faces[0].face_b : found->second.faces[0].face_a));
                CHECK(area(found->second.faces[0].patch) == within(1e-9, area(expected[0].patch)));
            });
        CHECK(faces == 4 * 4 * 3 + 5 * 3 * 3 + 5 * 3 + 5 * 4 * 2);
    }

    TEST_CASE(
        "examinePairs: once the model has moved, faces that share next to nothing have places and no patch, "
        "but in "
        "histories") {
        for (const double share : {1e-5, 1e-4, 0.99 * kLeastShare, 1.01 * kLeastShare, 1e-3, 1e-2, 0.4})
            for (const double depth : {-1e-5, 0.0, 1e-5}) {
                CAPTURE(share);
                CAPTURE(depth);
                Model model = floorModel(30);
                addBox(model, "below", {0, 0, 0}, {2, 1, 1});
                addBox(model, "beside", {2, 0, 0}, {2, 1, 1});
                addBox(model, "above", {0, 0, 1}, {2, 1, 1});
                State state = *buildState(model, false);
                state.blocks.position.set(3, state.blocks.position.get(3) + Vec3(2 * share, 0, -depth));
                const auto find = [&state](Springs springs, bool initial) {
                    state.springs = springs;
                    return examine(state, 0.05, initial, false)[{2, 3}];
                };
                CHECK_FALSE(find(Springs::keep_energy, false).faces.empty());
                CHECK_FALSE(find(Springs::follow_gaps, true).faces.empty());
                const PairFinding quasi_static = find(Springs::follow_gaps, false);
                CHECK(quasi_static.faces.empty() == (share < kLeastShare));
                const KnownPairs bearing{{}, {{2, 3}}};
                CHECK_FALSE(examine(state, 0.05, false, false, bearing)[{2, 3}].faces.empty());
                CHECK((share > 1e-2 || quasi_static.may_meet_by_vertices));
            }
    }

    TEST_CASE("examinePairs: a pair without places meets by no vertex or edge before the next search") {
        Random random(93);
        std::vector<State> states;
        for (const double spread : {2.0, 2.6, 3.2}) states.push_back(packing(random, 30, spread));
        for (const Ground ground : kGrounds)
            for (const double spacing : {2.5, 4.0})
                states.push_back(*buildState(jointedTerrain(ground, spacing), false));
        std::size_t met = 0, looked_at = 0, with_places = 0;
        for (const State& state : states) {
            const double margin = 0.05 * state.geometry->length_scale;
            std::vector<PairFinding> without;
            examinePairs(state, {margin, 0.0}, {}, false, false, [&](const PairFinding& pair) {
                if (pair.block_a == pair.block_b) return;
                if (pair.may_meet_by_vertices) ++with_places;
                if (!pair.may_meet_by_vertices) without.push_back(pair);
            });
            State moved = state;
            for (const PairFinding& pair : without) {
                CAPTURE(pair.part_a);
                CAPTURE(pair.part_b);
                const auto a = static_cast<std::size_t>(pair.block_a),
                           b = static_cast<std::size_t>(pair.block_b);
                for (int trial = 0; trial < 20; ++trial, ++looked_at) {
                    for (const std::size_t block : {a, b}) {
                        moved.blocks.position.set(block, state.blocks.position.get(block));
                        moved.blocks.orientation[block] = state.blocks.orientation[block];
                        moveByChance(moved, block, margin, random);
                    }
                    if (vertexEdgeDepth(moved, pair) > 0) ++met;
                }
                for (const std::size_t block : {a, b}) {
                    moved.blocks.position.set(block, state.blocks.position.get(block));
                    moved.blocks.orientation[block] = state.blocks.orientation[block];
                }
            }
        }
        CHECK(met == 0);
        CHECK(looked_at > 300000);
        CHECK(with_places > 1000);  // the others are not simply all of them
    }

    TEST_CASE("examinePairs: a pair keeps its places for vertices and edges as long as it is near") {
        const State state = *buildState(stackModel(2, 1, 1, 30), false);
        const auto mayMeet = [&](const PartPairs& with_places) {
            return examine(state, 0.005, false, false, {with_places, {}}).at({1, 2}).may_meet_by_vertices;
        };
        CHECK_FALSE(mayMeet({}));
        CHECK(mayMeet({{0, 1}, {1, 2}}));
        CHECK_FALSE(mayMeet({{0, 1}}));
    }
}
