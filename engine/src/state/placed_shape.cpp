#include "state/placed_shape.h"

#include <algorithm>

namespace talus {
namespace {

constexpr double kTouchingParts = 1e-7;  // of a body's radius: what is nearer touches

/// A part of a block of several.
const ConvexPart& partAt(const Geometry& geometry, std::int32_t part) {
    const auto block = static_cast<std::size_t>(geometry.part_block[static_cast<std::size_t>(part)]);
    return geometry.shape[block].faces.parts()[static_cast<std::size_t>(part - geometry.first_part[block])];
}

std::span<const FacePlane> planesOf(const Geometry& geometry, std::size_t block) {
    return std::span(geometry.face_planes)
        .subspan(geometry.first_plane[block], geometry.shape[block].faces.size());
}

bool isWhole(const Geometry& geometry, std::int32_t part) {
    const auto block = static_cast<std::size_t>(geometry.part_block[static_cast<std::size_t>(part)]);
    return geometry.shape[block].partCount() == 1;
}

void placeShape(const Blocks& blocks, const Geometry& geometry, std::size_t block, Polyhedron& shape) {
    shape = geometry.shape[block];
    const Mat3 turn = blocks.orientation.matrix(block);
    const Vec3 position = blocks.position.get(block);
    for (Vec3& v : shape.vertices) v = position + turn * v;
}

void addBoxes(const Polyhedron& placed, std::vector<Box>& boxes) {
    const auto add = [&](std::size_t first, std::size_t count) {
        Box box;
        for (std::size_t v = first; v < first + count; ++v) box.add(placed.vertices[v]);
        boxes.push_back(box);
    };
    if (placed.partCount() == 1) return add(0, placed.vertices.size());
    for (const ConvexPart& part : placed.faces.parts())
        add(static_cast<std::size_t>(part.first_vertex), static_cast<std::size_t>(part.vertices));
}

}  // namespace

void placeShape(const State& state, std::size_t block, Polyhedron& shape) {
    placeShape(state.blocks, *state.geometry, block, shape);
}

FixedShapes placeFixed(const Blocks& blocks, const Geometry& geometry) {
    FixedShapes fixed;
    fixed.first_vertex.assign(blocks.size(), FixedShapes::kNone);
    fixed.first_normal.assign(blocks.size(), FixedShapes::kNone);
    std::vector<Box> boxes;
    std::vector<Polyhedron> bodies;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.motion[b] != Motion::fixed) continue;
        Polyhedron& shape = bodies.emplace_back();
        placeShape(blocks, geometry, b, shape);
        fixed.first_vertex[b] = fixed.vertices.size();
        fixed.first_normal[b] = fixed.normals.size();
        fixed.vertices.insert(fixed.vertices.end(), shape.vertices.begin(), shape.vertices.end());
        for (std::size_t f = 0; f < shape.faces.size(); ++f) fixed.normals.push_back(shape.faceNormal(f));
        for (auto part = geometry.first_part[b]; part < geometry.first_part[b + 1]; ++part)
            fixed.parts.push_back(part);
        addBoxes(shape, boxes);
    }
    if (auto together = unionOf(bodies)) {
        fixed.together = std::move(*together);
        fixed.planes = facePlanes(fixed.together);
        Box all;
        for (const Box& box : boxes) all.add(box.min), all.add(box.max);
        fixed.tolerance = kTouchingParts * 0.5 * (all.max - all.min).norm();
    }
    fixed.boxes = BoxTree(std::move(boxes));
    return fixed;
}

bool standsAsBuilt(const State& state, std::size_t block) {
    const Geometry& geometry = *state.geometry;
    return state.blocks.motion[block] == Motion::fixed && geometry.fixed.has(block) &&
           state.blocks.position[block] == geometry.initial_position[block] &&
           state.blocks.orientation[block] == geometry.initial_orientation[block];
}

Polyhedron placedShape(const State& state, std::size_t block) {
    Polyhedron shape;
    placeShape(state, block, shape);
    return shape;
}

Vec3 toOwn(const Blocks& blocks, std::int32_t block, const Vec3& x) {
    const auto b = static_cast<std::size_t>(block);
    return blocks.orientation.matrix(b).transpose() * (x - blocks.position.get(b));
}

std::int32_t partOf(const Geometry& geometry, std::int32_t block, std::int32_t face) {
    const auto b = static_cast<std::size_t>(block);
    if (geometry.first_part[b + 1] == geometry.first_part[b] + 1) return geometry.first_part[b];
    return geometry.first_part[b] +
           static_cast<std::int32_t>(partOf(geometry.shape[b].faces, static_cast<std::size_t>(face)));
}

std::int32_t firstFace(const Geometry& geometry, std::int32_t part) {
    return isWhole(geometry, part) ? 0 : partAt(geometry, part).first_face;
}

std::pair<std::int32_t, std::int32_t> partsOf(const Geometry& geometry, const Interfaces& f, std::size_t i) {
    return std::minmax(
        {partOf(geometry, f.block_a[i], f.face_a[i]), partOf(geometry, f.block_b[i], f.face_b[i])});
}

std::optional<PartOfBody> partOfBody(const State& state, std::int32_t part) {
    const Geometry& geometry = *state.geometry;
    const auto block = static_cast<std::size_t>(geometry.part_block[static_cast<std::size_t>(part)]);
    const FixedShapes& fixed = geometry.fixed;
    if (!fixed.together.faces.empty() && standsAsBuilt(state, block)) {
        const auto place = static_cast<std::size_t>(
            std::lower_bound(fixed.parts.begin(), fixed.parts.end(), part) - fixed.parts.begin());
        if (fixed.together.faces.parts()[place].beside.empty()) return std::nullopt;
        return PartOfBody{fixed.together,   fixed.planes, place,
                          Mat3::Identity(), Vec3::Zero(), fixed.tolerance};
    }
    if (isWhole(geometry, part)) return std::nullopt;
    return PartOfBody{geometry.shape[block],
                      planesOf(geometry, block),
                      static_cast<std::size_t>(part - geometry.first_part[block]),
                      state.blocks.orientation.matrix(block),
                      state.blocks.position.get(block),
                      kTouchingParts * geometry.radius[block]};
}

PlacedPart::PlacedPart(const State& state, std::int32_t part)
    : body_(partOfBody(state, part)), first_face_(talus::firstFace(*state.geometry, part)) {
    const Geometry& geometry = *state.geometry;
    const auto p = static_cast<std::size_t>(part), first_edge = geometry.first_edge[p];
    const auto block = static_cast<std::size_t>(geometry.part_block[p]);
    edges_ = std::span(geometry.part_edges).subspan(first_edge, geometry.first_edge[p + 1] - first_edge);
    const Polyhedron& own = geometry.shape[block];
    std::span<const Vec3> vertices = own.vertices;
    faces_ = &own.faces;
    if (body_) {
        if (!isWhole(geometry, part)) {
            const ConvexPart& range = partAt(geometry, part);
            vertices = vertices.subspan(static_cast<std::size_t>(range.first_vertex),
                                        static_cast<std::size_t>(range.vertices));
            faces_ = &range.faces;
        }
        covers_ = body_->covers();
    }
    const Mat3 turn = state.blocks.orientation.matrix(block);
    const Vec3 position = state.blocks.position.get(block);
    vertices_.reserve(vertices.size());
    normals_.reserve(faces_->size());
    for (const Vec3& v : vertices) vertices_.push_back(position + turn * v);
    const auto planes =
        planesOf(geometry, block).subspan(static_cast<std::size_t>(first_face_), faces_->size());
    for (const FacePlane& plane : planes) normals_.push_back(turn * plane.normal);
}

WorldShape PlacedPart::world() const {
    return {vertices_, *faces_, normals_, covers_, body_ ? &*body_ : nullptr, edges_};
}

}  // namespace talus
