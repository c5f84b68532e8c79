#include "rock_mass/solid.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/box_tree.h"

namespace talus::rock_mass {

namespace {

constexpr double kLeastCommonArea = 1e-9;  // of the smaller face: less common area is none

struct FaceOf {
    std::int32_t plane;
    std::size_t cell, face;
};

/// Faces of all cells, those of one plane together.
std::vector<FaceOf> facesByPlane(const std::vector<Cell>& cells) {
    std::vector<FaceOf> faces;
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (std::size_t f = 0; f < cells[c].faces.size(); ++f)
            faces.push_back({cells[c].faces[f].plane, c, f});
    std::stable_sort(faces.begin(), faces.end(),
                     [](const FaceOf& a, const FaceOf& b) { return a.plane < b.plane; });
    return faces;
}

double faceArea(const CellFace& face, const VertexTable& vertices) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 2; i < face.outline.size(); ++i)
        sum += (vertices[face.outline[i - 1]] - vertices[face.outline[0]])
                   .cross(vertices[face.outline[i]] - vertices[face.outline[0]]);
    return 0.5 * sum.norm();
}

bool touch(const CellFace& a, const CellFace& b, const Knife& knife) {
    const double common = sharedArea(a, b, knife.planes, knife.vertices);
    return common > 0 &&
           common > kLeastCommonArea * std::min(faceArea(a, knife.vertices), faceArea(b, knife.vertices));
}

Box boundsOf(const Cell& piece, const VertexTable& vertices) {
    Box bounds;
    for (const CellFace& face : piece.faces)
        for (const std::int32_t v : face.outline) bounds.add(vertices[v]);
    return bounds;
}

Solid bounded(std::vector<Cell> pieces, const VertexTable& vertices) {
    Box bounds;
    for (const Cell& piece : pieces) bounds.add(boundsOf(piece, vertices));
    return {std::move(pieces), bounds.min, bounds.max};
}

/// Merges pieces that were divided inside the region only, where possible: each with the first later one that
/// it fits. A grown piece tries the others again.
void mergePieces(std::vector<Cell>& pieces, const Knife& knife) {
    std::vector<Box> bounds;
    for (const Cell& piece : pieces) bounds.push_back(boundsOf(piece, knife.vertices));
    const BoxTree tree(bounds);  // those behind a piece still have their own boxes when it is looked at
    std::vector<bool> gone(pieces.size());
    Cell merged;
    std::vector<std::size_t> beside;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        Box grown = bounds[i];
        for (bool again = !gone[i]; again;) {
            again = false;
            beside.clear();
            tree.visit(grown, [&](std::size_t j) {
                if (j > i && !gone[j]) beside.push_back(j);
            });
            std::sort(beside.begin(), beside.end());
            for (const std::size_t j : beside) {
                if (!merge(pieces[i], pieces[j], knife.planes, knife.vertices, merged)) continue;
                pieces[i] = std::move(merged);
                merged = {};
                gone[j] = again = true;
                grown.add(bounds[j]);
                break;
            }
        }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (!gone[i] && kept++ != i) pieces[kept - 1] = std::move(pieces[i]);
    pieces.resize(kept);
}

double thicknessOf(const Solid& solid, const Knife& knife) {
    std::vector<const Cell*> cells;
    for (const Cell& piece : solid.pieces) cells.push_back(&piece);
    return thickness(cells, knife.planes, knife.vertices);
}

std::vector<Vec3> corners(const CellFace& face, const VertexTable& vertices) {
    std::vector<Vec3> points;
    for (const std::int32_t v : face.outline) points.push_back(vertices[v]);
    return points;
}

/// Faces of the region's decomposition become faces of a joint that lies in them.
void giveFacesTo(std::vector<Cell>& cells, std::int32_t index, const Knife& knife) {
    const Plane& plane = knife.planes[static_cast<std::size_t>(index)];
    for (Cell& cell : cells)
        for (CellFace& face : cell.faces) {
            const Plane& own = knife.planes[static_cast<std::size_t>(face.plane)];
            if (own.source != kSurface) continue;
            if (!std::all_of(face.outline.begin(), face.outline.end(),
                             [&](std::int32_t v) { return knife.vertices.side(plane, v) == 0; }))
                continue;
            face.outward = own.normal.dot(plane.normal) > 0 ? face.outward : !face.outward;
            face.plane = index;
        }
}

/// The two sides of a solid, and what parts them.
struct Sides {
    std::vector<Cell> lower, upper;
    bool met = false;     ///< by the finite joint
    bool failed = false;  ///< a piece could not be cut
};

Sides sidesOf(const Solid& solid, std::int32_t plane, const Reach* reach, const Knife& knife) {
    Sides sides;
    for (const Cell& piece : solid.pieces) {
        Split parts = split(piece, knife.planes, plane, knife.vertices);
        if (parts.kind == Split::Kind::failed) sides.failed = true;
        if (parts.kind == Split::Kind::below) sides.lower.push_back(piece);
        if (parts.kind == Split::Kind::above) sides.upper.push_back(piece);
        if (parts.kind != Split::Kind::cut) continue;
        sides.met = sides.met || !reach ||
                    reach->covers(corners(parts.lower.faces.back(), knife.vertices), knife.vertices.weld());
        sides.lower.push_back(std::move(parts.lower));
        sides.upper.push_back(std::move(parts.upper));
    }
    return sides;
}

Box boundsOf(const CellFace& face, const VertexTable& vertices) {
    Box bounds;
    for (const std::int32_t v : face.outline) bounds.add(vertices[v]);
    return bounds;
}

/// Pairs of cells that share a face.
std::vector<std::array<std::size_t, 2>> sharedFaces(const std::vector<Cell>& cells, const Knife& knife) {
    std::vector<std::array<std::size_t, 2>> pairs;
    const auto faces = facesByPlane(cells);
    const auto face_of = [&](const FaceOf& f) -> const CellFace& { return cells[f.cell].faces[f.face]; };
    // Points lie in a plane to within the weld distance.
    const double margin = 4 * knife.vertices.weld();
    std::vector<FaceOf> below;  // the plane, whose normal points out of them; those above it face them
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        below.clear();
        std::vector<Box> bounds;
        for (end = begin; end < faces.size() && faces[end].plane == faces[begin].plane; ++end) {
            if (!face_of(faces[end]).outward) continue;
            below.push_back(faces[end]);
            bounds.push_back(boundsOf(face_of(faces[end]), knife.vertices));
        }
        if (below.empty() || below.size() == end - begin) continue;
        const BoxTree tree(std::move(bounds));
        for (std::size_t i = begin; i < end; ++i) {
            const CellFace& face = face_of(faces[i]);
            if (face.outward) continue;
            tree.visit(boundsOf(face, knife.vertices).grown(margin), [&](std::size_t k) {
                const CellFace& other = face_of(below[k]);
                // In their order, which gives the plane's frame.
                const bool is_first =
                    std::pair(faces[i].cell, faces[i].face) < std::pair(below[k].cell, below[k].face);
                if (is_first ? touch(face, other, knife) : touch(other, face, knife))
                    pairs.push_back(
                        {std::min(faces[i].cell, below[k].cell), std::max(faces[i].cell, below[k].cell)});
            });
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

Polyhedron shapeOf(const Cell& cell, const VertexTable& vertices) {
    Polyhedron shape;
    std::vector<std::int32_t> used;
    for (const CellFace& face : cell.faces) used.insert(used.end(), face.outline.begin(), face.outline.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::int32_t v : used) shape.vertices.push_back(vertices[v]);
    std::vector<FaceList::Outline> faces;
    for (const CellFace& face : cell.faces) {
        FaceList::Outline outline;
        for (const std::int32_t v : face.outline)
            outline.push_back(
                static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin()));
        faces.push_back(std::move(outline));
    }
    shape.faces = std::move(faces);
    return shape;
}

/// Whether a joint along the faces between whole pieces is met: one of them has an outline in the plane.
bool metAlongFaces(const std::vector<Cell>& lower, std::int32_t index, const Reach* reach,
                   const Knife& knife) {
    if (!reach) return true;
    const Plane& plane = knife.planes[static_cast<std::size_t>(index)];
    for (const Cell& cell : lower)
        for (const CellFace& face : cell.faces)
            if (std::all_of(face.outline.begin(), face.outline.end(),
                            [&](std::int32_t v) { return knife.vertices.side(plane, v) == 0; }) &&
                reach->covers(corners(face, knife.vertices), knife.vertices.weld()))
                return true;
    return false;
}

}  // namespace

std::vector<Solid> joined(std::vector<Cell> cells, const Knife& knife) {
    std::vector<std::size_t> root(cells.size());
    std::iota(root.begin(), root.end(), 0);
    const auto rootOf = [&](std::size_t c) {
        while (root[c] != c) c = root[c] = root[root[c]];
        return c;
    };
    if (cells.size() > 1)
        for (const auto& [a, b] : sharedFaces(cells, knife)) {
            const auto [low, high] = std::minmax({rootOf(a), rootOf(b)});
            root[high] = low;
        }
    std::vector<std::vector<Cell>> groups(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) groups[rootOf(c)].push_back(std::move(cells[c]));
    std::vector<Solid> solids;
    for (auto& group : groups) {
        if (group.empty()) continue;
        if (group.size() > 1) mergePieces(group, knife);
        solids.push_back(bounded(std::move(group), knife.vertices));
    }
    return solids;
}

Result<Polyhedron> shapeOf(const Solid& solid, const VertexTable& vertices) {
    std::vector<Polyhedron> parts;
    for (const Cell& piece : solid.pieces) parts.push_back(shapeOf(piece, vertices));
    return joinParts(parts);
}

CutOutcome cutSolid(const Solid& solid, std::int32_t plane, const Reach* reach, const Knife& knife) {
    Sides sides = sidesOf(solid, plane, reach, knife);
    if (!sides.failed && (sides.lower.empty() || sides.upper.empty())) return {};
    if (!sides.failed && !sides.met && !metAlongFaces(sides.lower, plane, reach, knife)) return {};
    if (sides.failed) return {CutOutcome::Kind::sliver, {}, 0.5 * (solid.min + solid.max), 0};
    if (solid.pieces.size() > 1) {
        giveFacesTo(sides.lower, plane, knife);
        giveFacesTo(sides.upper, plane, knife);
    }
    CutOutcome outcome{CutOutcome::Kind::cut, joined(std::move(sides.lower), knife)};
    for (Solid& part : joined(std::move(sides.upper), knife)) outcome.parts.push_back(std::move(part));
    for (const Solid& part : outcome.parts) {
        const double thin = thicknessOf(part, knife);
        // The region itself may be that thin; only a part that the cut makes thinner is a sliver.
        if (thin < knife.min_thickness && thin < (1 - 1e-9) * thicknessOf(solid, knife))
            return {CutOutcome::Kind::sliver, {}, 0.5 * (part.min + part.max), thin};
    }
    return outcome;
}

}  // namespace talus::rock_mass
