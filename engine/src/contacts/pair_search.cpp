#include "contacts/pair_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "contacts/limits.h"
#include "contacts/vertex_edge_points.h"
#include "geometry/separation.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"
#include "state/placed_shape.h"
#include "state/range.h"

namespace talus {
namespace {

constexpr double kBears = 0.01;         // of the forces on a block: strips of neighbours have a thousandth
constexpr double kMostFaceAngle = 0.8;  // [rad] however deep: then a box always has one such face

/// The reference face is the fixed block's, else the larger block's, else that of the block with the lower
/// index.
bool firstIsReference(const State& state, std::size_t first, std::size_t second) {
    const bool first_free = state.blocks.motion[first] == Motion::free;
    const bool second_free = state.blocks.motion[second] == Motion::free;
    if (first_free != second_free) return second_free;
    const double radius_1 = state.geometry->radius[first], radius_2 = state.geometry->radius[second];
    return radius_1 >= radius_2 * (1.0 - 1e-9);
}

/// How deep a point lies in a convex shape [m]: below the lowest vertex of each face, so that uneven faces do
/// not add to it. It is not followed below `least`.
double depthIn(const WorldShape& shape, const Vec3& point, double least) {
    double depth = kInfinity;
    for (std::size_t face = 0; face < shape.faces.size() && depth > least; ++face) {
        for (const std::int32_t v : shape.faces[face]) {
            depth =
                std::min(depth, shape.normals[face].dot(shape.vertices[static_cast<std::size_t>(v)] - point));
        }
    }
    return depth;
}

/// How deep two convex shapes overlap at least [m]: as deep as a vertex of one lies in the other, since a ball
/// of that radius about it does, too. 0: no vertex does.
double leastDepth(const WorldShape& a, const WorldShape& b) {
    double most = 0;
    for (const Vec3& vertex : a.vertices) most = std::max(most, depthIn(b, vertex, most));
    for (const Vec3& vertex : b.vertices) most = std::max(most, depthIn(a, vertex, most));
    return most;
}

/// Faces may be opposite through the bodies: the far side of a block and the near side of its neighbour, or
/// faces that are not parallel. A pair whose overlap differs from that of the blocks is left out.
void dropFalsePairs(const WorldShape& a, const WorldShape& b, double closed, PairFinding& finding) {
    constexpr double kRounding = 1e-6;  // of what counts as closed: rounding of the depths is far less
    const double above = (1.0 + kRounding) * closed, below = (1.0 - kRounding) * closed;
    double least = kInfinity, most = 0;  // overlap of the faces that count
    for (const FacePair& face : finding.faces) {
        if (face.least_gap >= -closed) continue;
        least = std::min(least, -face.least_gap);
        most = std::max(most, -face.least_gap);
    }
    if (most == 0) return;
    // The depth takes long to find, and a bound often decides. At this depth or more no face is left out;
    if (most <= 2.0 * leastDepth(a, b) + below) return;
    // at this depth or less all of these faces are.
    const double depth = std::max(0.0, -findSeparation(a, b, -0.5 * (least - above)).distance);
    std::erase_if(finding.faces,
                  [&](const FacePair& face) { return -face.least_gap > 2.0 * depth + closed; });
}

/// Faces partly covered by other parts of their body: a patch on the covered piece is left out.
void dropCovered(const WorldShape& a, const WorldShape& b, PairFinding& finding) {
    const auto isCovered = [](const WorldShape& shape, std::int32_t face, const Vec3& place) {
        const auto f = static_cast<std::size_t>(face);
        return !shape.covers.empty() && shape.covers[f] == Cover::partly && shape.body->isInOther(place);
    };
    if (!a.body && !b.body) return;
    std::erase_if(finding.faces, [&](const FacePair& pair) {
        const FaceFrame frame = faceFrame(a, static_cast<std::size_t>(pair.face_a));
        const Vec3 on_a = frame.toWorld(centroid(pair.patch));
        return isCovered(a, pair.face_a, on_a) || isCovered(b, pair.face_b, on_a + pair.gap * frame.e3);
    });
}

/// Adds faces with a deep contact to those found, and removes those that would push against it: the far sides
/// of a thin body.
void keepDeep(const State& state, const KnownPairs& known, BoxPair parts, const WorldShape& a,
              const WorldShape& b, PairFinding& finding) {
    const auto before = [](const DeepFaces& deep, BoxPair pair) { return deep.parts < pair; };
    auto deep = std::lower_bound(known.deep.begin(), known.deep.end(), parts, before);
    for (; deep != known.deep.end() && deep->parts == parts; ++deep) {
        const bool same_order = deep->block_a == finding.block_a;
        const auto face_a = static_cast<std::size_t>((same_order ? deep->face_a : deep->face_b) -
                                                     firstFace(*state.geometry, finding.part_a)),
                   face_b = static_cast<std::size_t>((same_order ? deep->face_b : deep->face_a) -
                                                     firstFace(*state.geometry, finding.part_b));
        const auto pair =
            findFacePair(a, face_a, b, face_b,
                         {.max_gap = kInfinity, .max_overlap = kInfinity, .max_angle = kMostFaceAngle});
        if (!pair) continue;
        std::erase_if(finding.faces, [&](const FacePair& other) {
            const auto other_a = static_cast<std::size_t>(other.face_a);
            return a.normals[other_a].dot(a.normals[face_a]) < 0 ||
                   (other_a == face_a && static_cast<std::size_t>(other.face_b) == face_b);
        });
        finding.faces.push_back(*pair);
    }
    std::sort(finding.faces.begin(), finding.faces.end(), [](const FacePair& p, const FacePair& q) {
        return std::pair(p.face_a, p.face_b) < std::pair(q.face_a, q.face_b);
    });
}

/// Leaves out patches that are too small for their depth, or negligible. \return whether one is left out, or
/// may be before the next search: then the pair needs places
bool dropSlivers(const State& state, std::size_t a, std::size_t b, double size, double least_share,
                 PairFinding& finding, bool initial) {
    const double least = vertexEdgeArea(*state.geometry, a, b);
    const auto isSliver = [&](const FacePair& face) {
        return area(face.patch) < least && !(initial && std::abs(face.least_gap) <= kClosedGap * size);
    };
    if (std::none_of(finding.faces.begin(), finding.faces.end(), isSliver)) return false;
    std::erase_if(finding.faces, [&](const FacePair& face) {
        return isSliver(face) && (-face.least_gap > kSliverDepth * size || face.share < least_share);
    });
    return true;
}

bool isAmong(const PartPairs& pairs, BoxPair pair) {
    return std::binary_search(pairs.begin(), pairs.end(), pair);
}

/// The least share of a face that counts, see kLeastShare.
double leastShare(const State& state, const KnownPairs& known, BoxPair pair, bool initial) {
    const bool all_count = narrowPatchesCount(state, initial) || isAmong(known.bearing, pair);
    return all_count ? 0.0 : kLeastShare;
}

bool isBonded(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    if (!state.laws[static_cast<std::size_t>(f.joint[i])].bonded) return false;
    for (std::size_t k = 0; k < f.pointCount(i); ++k)
        if (state.points.memoryAt(f.pointSlot(i, k)).bond > 0) return true;
    return false;
}

}  // namespace

std::vector<char> blocksNear(const State& state, const std::vector<char>& around, double margin) {
    constexpr double kWiderForRounding = 1 + 1e-9;
    std::vector<Box> boxes(state.blocks.size());
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        const Vec3 centre = state.blocks.position.get(b);
        const Vec3 half = Vec3::Constant(kWiderForRounding * (state.geometry->radius[b] + 0.5 * margin));
        boxes[b] = {centre - half, centre + half};
    }
    return findNearMarked(boxes, around);
}

PartPairs pairsWithPlaces(const Geometry& geometry, const Interfaces& interfaces, const SearchRange& range) {
    PartPairs pairs;
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        const auto a = static_cast<std::size_t>(interfaces.block_a[i]),
                   b = static_cast<std::size_t>(interfaces.block_b[i]);
        if (isVertexEdge(interfaces, i) && range.has(a, b)) pairs.push_back(partsOf(geometry, interfaces, i));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

PartPairs pairsThatBear(const State& state, const SearchRange& range) {
    const Interfaces& f = state.interfaces;
    std::vector<double> carried(state.blocks.size(), 0.0);
    for (std::size_t i = 0; i < f.size(); ++i) {
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        if (!range.isNear(a) && !range.isNear(b)) continue;
        const double force = f.wrench(i).force.norm();
        carried[a] += force;
        carried[b] += force;
    }
    PartPairs pairs;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        if (isVertexEdge(f, i) || !range.has(a, b)) continue;
        if (f.area[i] >= vertexEdgeArea(*state.geometry, a, b)) continue;
        if (f.wrench(i).force.norm() >= kBears * std::min(carried[a], carried[b]) || isBonded(state, i))
            pairs.push_back(partsOf(*state.geometry, f, i));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

namespace {

/// Displacement at which a block causes a search, with what it may exceed that by when noticed [m].
double wayAhead(const State& state, std::size_t block, double margin) {
    constexpr double kNoticed = 1.5;
    if (state.blocks.motion[block] == Motion::fixed) return 0.0;
    return kNoticed * std::min(kTravelLimit * state.geometry->size[block], kShareOfMargin * margin);
}

PairFinding examinePair(const State& state, const PlacedShapes& placed, BoxPair pair,
                        const SearchRange& range, const KnownPairs& known, bool initial) {
    PairFinding finding;
    const auto part_1 = static_cast<std::size_t>(pair.first), part_2 = static_cast<std::size_t>(pair.second);
    const std::size_t first = placed.blockOf(part_1), second = placed.blockOf(part_2);
    if (first == second || !range.has(first, second)) return finding;
    if (state.blocks.isRemoved(first) || state.blocks.isRemoved(second)) return finding;
    if (state.blocks.motion[first] != Motion::free && state.blocks.motion[second] != Motion::free)
        return finding;
    const bool first_is_a = firstIsReference(state, first, second);
    const std::size_t a = first_is_a ? first : second, b = first_is_a ? second : first;
    finding.block_a = static_cast<std::int32_t>(a);
    finding.block_b = static_cast<std::int32_t>(b);
    finding.part_a = first_is_a ? pair.first : pair.second;
    finding.part_b = first_is_a ? pair.second : pair.first;
    const double size = std::min(state.geometry->size[a], state.geometry->size[b]);
    const double closed = kClosedGap * size;
    const std::optional<PartOfBody> body_a = partOfBody(state, finding.part_a),
                                    body_b = partOfBody(state, finding.part_b);
    const WorldShape placed_a = placed.world(static_cast<std::size_t>(finding.part_a), body_a),
                     placed_b = placed.world(static_cast<std::size_t>(finding.part_b), body_b);
    if (!initial && areApart(placed_a, placed_b, range.margin)) return finding;
    finding.faces = findFacePairs(placed_a, placed_b,
                                  {.max_gap = range.margin,
                                   .max_overlap = 0.5 * size,
                                   .max_angle = kMostFaceAngle,
                                   .touching_angle = kFaceAngle,
                                   .angle_per_depth = kFaceAnglePerDepth,
                                   .size = size});
    dropFalsePairs(placed_a, placed_b, closed, finding);
    dropCovered(placed_a, placed_b, finding);
    if (!known.deep.empty()) keepDeep(state, known, pair, placed_a, placed_b, finding);
    const bool slivers =
        dropSlivers(state, a, b, size, leastShare(state, known, pair, initial), finding, initial);
    // A pair that has places keeps them as long as it is near.
    const double fast = kFasterAhead * range.ahead * (speedBound(state, a) + speedBound(state, b));
    const VertexEdgeLimits sharp = vertexEdgeLimits(*state.geometry, a, b, fast);
    const double travel = wayAhead(state, a, range.margin) + wayAhead(state, b, range.margin);
    finding.may_meet_by_vertices =
        slivers || isAmong(known.with_places, pair) ||
        approachOf(placed_a, placed_b, sharp, travel, 2.0 * kTurnLimit) == Approach::vertex_edge;
    for (FacePair& face : finding.faces) {
        face.face_a += firstFace(*state.geometry, finding.part_a);
        face.face_b += firstFace(*state.geometry, finding.part_b);
    }
    if (!initial) return finding;
    for (const FacePair& face :
         finding.faces)  // parallel faces that do not overlap: a plane between the blocks
        if (face.least_gap >= -closed && face.most_gap - face.least_gap <= closed) return finding;
    finding.depth = -findSeparation(placed_a, placed_b, -closed).distance;
    finding.overlaps = finding.depth > closed;
    return finding;
}

}  // namespace

bool examinePairs(const State& state, const SearchRange& range, const KnownPairs& known, bool initial,
                  bool parallel, const std::function<void(const PairFinding&)>& take, const Control& control,
                  SearchWork* work) {
    constexpr std::size_t kPairsAtOnce = 16384;
    assert(range.margin > 0 && range.ahead >= 0 &&
           std::is_sorted(known.with_places.begin(), known.with_places.end()));
    const PlacedShapes placed(state, range, parallel);
    if (isStopped(control)) return false;
    SearchWork done;
    PartPairs pairs = nearPairs(state, placed, range, parallel, work != nullptr ? *work : done);
    if (!initial) dropBeyondFaces(state, placed, range.margin, pairs);  // examinePair finds these apart
    std::vector<PairFinding> findings;
    for (std::size_t begin = 0; begin < pairs.size(); begin += kPairsAtOnce) {
        if (isStopped(control)) return false;
        if (control.progress) {
            control.progress({"contacts", static_cast<double>(begin) / static_cast<double>(pairs.size()),
                              "between " + std::to_string(state.blocks.size()) + " blocks"});
        }
        findings.assign(std::min(kPairsAtOnce, pairs.size() - begin), {});
        forRange(findings.size(), 64, parallel, [&](Range piece) {
            for (std::size_t k = piece.begin; k < piece.end; ++k)
                findings[k] = examinePair(state, placed, pairs[begin + k], range, known, initial);
        });
        for (const PairFinding& finding : findings) take(finding);
    }
    return true;
}

}  // namespace talus
