#include "contacts/near_pairs.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "state/placed_shape.h"
#include "state/range.h"

namespace talus {
namespace {

constexpr std::size_t kBlocks = 256, kParts = 1024;  // pieces of parallel work

const ConvexPart* partIn(const Geometry& geometry, std::size_t part) {
    const auto block = static_cast<std::size_t>(geometry.part_block[part]);
    const auto& parts = geometry.shape[block].faces.parts();
    if (parts.empty()) return nullptr;
    return &parts[part - static_cast<std::size_t>(geometry.first_part[block])];
}

}  // namespace

PlacedShapes::PlacedShapes(const State& state, const SearchRange& range, bool parallel)
    : geometry_(*state.geometry) {
    const std::size_t n = state.blocks.size();
    placed_.assign(n, 0);
    first_vertex_.assign(n, 0);
    first_normal_.assign(n, 0);
    std::size_t vertices = 0, normals = 0;
    for (std::size_t b = 0; b < n; ++b) {
        if (!range.isNear(b) || standsAsBuilt(state, b)) continue;
        placed_[b] = 1;
        first_vertex_[b] = vertices;
        first_normal_[b] = normals;
        vertices += geometry_.shape[b].vertices.size();
        normals += geometry_.shape[b].faces.size();
    }
    vertices_.resize(vertices);
    normals_.resize(normals);
    forRange(n, kBlocks, parallel, [&](Range some) {
        Polyhedron shape;
        for (std::size_t b = some.begin; b < some.end; ++b) {
            if (!isPlaced(b)) continue;
            placeShape(state, b, shape);
            std::copy(shape.vertices.begin(), shape.vertices.end(), &vertices_[first_vertex_[b]]);
            for (std::size_t f = 0; f < shape.faces.size(); ++f)
                normals_[first_normal_[b] + f] = shape.faceNormal(f);
        }
    });
}

WorldShape PlacedShapes::whole(std::size_t block) const {
    const Polyhedron& own = geometry_.shape[block];
    const bool is_placed = isPlaced(block);
    const FixedShapes& fixed = geometry_.fixed;
    const std::size_t first_vertex = is_placed ? first_vertex_[block] : fixed.first_vertex[block],
                      first_normal = is_placed ? first_normal_[block] : fixed.first_normal[block];
    return {std::span(is_placed ? vertices_ : fixed.vertices).subspan(first_vertex, own.vertices.size()),
            own.faces,
            std::span(is_placed ? normals_ : fixed.normals).subspan(first_normal, own.faces.size())};
}

WorldShape PlacedShapes::world(std::size_t part, const std::optional<PartOfBody>& body) const {
    const WorldShape block = whole(blockOf(part));
    if (!body) return block;
    const ConvexPart* range = partIn(geometry_, part);
    if (range == nullptr) return {block.vertices, block.faces, block.normals, body->covers(), &*body};
    const auto first = static_cast<std::size_t>(range->first_face), count = range->faces.size();
    return {vertices(part), range->faces, block.normals.subspan(first, count), body->covers(), &*body};
}

std::span<const Vec3> PlacedShapes::vertices(std::size_t part) const {
    const WorldShape block = whole(blockOf(part));
    const ConvexPart* range = partIn(geometry_, part);
    if (range == nullptr) return block.vertices;
    return block.vertices.subspan(static_cast<std::size_t>(range->first_vertex),
                                  static_cast<std::size_t>(range->vertices));
}

bool PlacedShapes::isBeyondFace(std::size_t part, const Vec3& centre, double radius, double distance) const {
    constexpr double kRounding = 1e-9;  // of the lengths that are added
    const WorldShape block = whole(blockOf(part));
    const ConvexPart* range = partIn(geometry_, part);
    const auto first = range == nullptr ? std::size_t{0} : static_cast<std::size_t>(range->first_face);
    const std::size_t count = range == nullptr ? block.faces.size() : range->faces.size();
    for (std::size_t face = first; face < first + count; ++face) {
        const Vec3 from = centre - block.vertices[static_cast<std::size_t>(block.faces[face][0])];
        const double slack = kRounding * (from.norm() + radius);
        if (block.normals[face].dot(from) - radius > distance + slack) return true;
    }
    return false;
}

namespace {

/// The parts that are placed, with their boxes.
struct PlacedParts {
    std::vector<std::int32_t> parts{};  ///< ascending
    std::vector<Box> boxes{};
};

PlacedParts boxesOf(const PlacedShapes& placed, const Geometry& geometry, double margin, bool parallel) {
    PlacedParts found;
    for (std::size_t b = 0; b < geometry.shape.size(); ++b) {
        if (!placed.isPlaced(b)) continue;
        for (auto part = geometry.first_part[b]; part < geometry.first_part[b + 1]; ++part)
            found.parts.push_back(part);
    }
    found.boxes.resize(found.parts.size());
    forRange(found.boxes.size(), kParts, parallel, [&](Range some) {
        for (std::size_t k = some.begin; k < some.end; ++k) {
            Box box;
            for (const Vec3& v : placed.vertices(static_cast<std::size_t>(found.parts[k]))) box.add(v);
            found.boxes[k] = box.grown(margin);
        }
    });
    return found;
}

/// Pairs of a placed part and one that stands as built, those of one placed part after the other.
PartPairs pairsWithFixed(const State& state, const PlacedParts& placed, const SearchRange& range,
                         double margin, bool parallel, std::size_t& compared) {
    const Geometry& geometry = *state.geometry;
    const FixedShapes& fixed = geometry.fixed;
    const std::size_t pieces = (placed.parts.size() + kParts - 1) / kParts;
    std::vector<PartPairs> lists(pieces);
    std::vector<std::size_t> counts(pieces, 0);
    const auto look = [&](std::size_t piece, std::size_t k) {
        const Box& box = placed.boxes[k];
        // The tree's boxes have no margin, so the query is wider by it, and by as much again for rounding.
        counts[piece] += fixed.boxes.visit(box.grown(2.0 * margin), [&](std::size_t f) {
            const std::int32_t other = fixed.parts[f];
            const auto block = static_cast<std::size_t>(geometry.part_block[static_cast<std::size_t>(other)]);
            if (!range.isNear(block) || !standsAsBuilt(state, block)) return;
            if (box.meets(fixed.boxes[f].grown(margin)))
                lists[piece].push_back(std::minmax(placed.parts[k], other));
        });
    };
    forRange(pieces, 1, parallel, [&](Range some) {
        for (std::size_t piece = some.begin; piece < some.end; ++piece)
            for (std::size_t k = piece * kParts; k < std::min((piece + 1) * kParts, placed.parts.size()); ++k)
                look(piece, k);
    });
    PartPairs pairs;
    for (const PartPairs& list : lists) pairs.insert(pairs.end(), list.begin(), list.end());
    for (const std::size_t count : counts) compared += count;
    return pairs;
}

}  // namespace

PartPairs nearPairs(const State& state, const PlacedShapes& placed, const SearchRange& range, bool parallel,
                    SearchWork& work) {
    const double margin = 0.5 * range.margin;
    const PlacedParts parts = boxesOf(placed, *state.geometry, margin, parallel);
    PartPairs pairs = findNeighbours(parts.boxes, parallel);
    for (auto& [first, second] : pairs) {
        first = parts.parts[static_cast<std::size_t>(first)];
        second = parts.parts[static_cast<std::size_t>(second)];
    }
    const PartPairs with_fixed = pairsWithFixed(state, parts, range, margin, parallel, work.boxes);
    if (!with_fixed.empty()) {
        pairs.insert(pairs.end(), with_fixed.begin(), with_fixed.end());
        sortRange(pairs, parallel, std::less<>{});
    }
    work.placed_faces += placed.placedFaces();
    work.pairs += pairs.size();
    return pairs;
}

void dropBeyondFaces(const State& state, const PlacedShapes& placed, double margin, PartPairs& pairs) {
    const auto isBeyond = [&](std::int32_t fixed, std::int32_t moving) {
        const std::size_t part = static_cast<std::size_t>(fixed),
                          block = placed.blockOf(static_cast<std::size_t>(moving));
        return !placed.isPlaced(placed.blockOf(part)) && placed.isPlaced(block) &&
               placed.isBeyondFace(part, state.blocks.position.get(block), state.geometry->radius[block],
                                   margin);
    };
    std::erase_if(pairs, [&](const BoxPair& pair) {
        return isBeyond(pair.first, pair.second) || isBeyond(pair.second, pair.first);
    });
}

}  // namespace talus
