#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/polygon.h"
#include "state/incidence.h"
#include "state/placed_shape.h"
#include "state/point_layout.h"
#include "validate/findings.h"

namespace talus {
namespace {

constexpr double kParallelNormals = 1e-9;  // 1 less the cosine
constexpr double kInPlane = 1e-6;          // of a block's radius
constexpr double kSameArea = 1e-9;         // of the area
constexpr double kPatchRounding = 1e-13;   // of the patch's extent, squared for areas

const Vec3& vertexOf(const Polyhedron& shape, std::size_t face) {
    return shape.vertices[static_cast<std::size_t>(shape.faces[face][0])];
}

/// A material point of a block on one of its faces, and the interface's normal out of it.
bool liesOnFace(const State& state, std::int32_t block, std::int32_t face, const Vec3& origin,
                const Vec3& out) {
    const auto b = static_cast<std::size_t>(block), k = static_cast<std::size_t>(face);
    const Polyhedron& shape = state.geometry->shape[b];
    const Vec3 normal = shape.faceNormal(k);
    return normal.dot(out) > 1.0 - kParallelNormals &&
           std::abs(normal.dot(origin - vertexOf(shape, k))) <= kInPlane * state.geometry->radius[b];
}

/// The convex part that a face of a block belongs to.
Polyhedron partWith(const State& state, std::int32_t block, std::int32_t face) {
    const Polyhedron& shape = state.geometry->shape[static_cast<std::size_t>(block)];
    return partsOf(shape)[partOf(shape.faces, static_cast<std::size_t>(face))];
}

/// Of a place for a vertex or edge: no vertex of the reference part lies beyond the contact's plane.
bool isOutermost(const State& state, std::int32_t block, std::int32_t face, const Vec3& origin,
                 const Vec3& out) {
    const auto b = static_cast<std::size_t>(block);
    const std::vector<Vec3> vertices = partWith(state, block, face).vertices;
    return std::all_of(vertices.begin(), vertices.end(), [&](const Vec3& v) {
        return out.dot(v - origin) <= kInPlane * state.geometry->radius[b];
    });
}

/// On the surface of the other part, where its vertex or edge is.
bool isOnSurface(const State& state, std::int32_t block, std::int32_t face, const Vec3& origin) {
    const auto b = static_cast<std::size_t>(block);
    const Polyhedron shape = partWith(state, block, face);
    double highest = -kInfinity;
    for (std::size_t k = 0; k < shape.faces.size(); ++k)
        highest = std::max(highest, shape.faceNormal(k).dot(origin - vertexOf(shape, k)));
    return std::abs(highest) <= kInPlane * state.geometry->radius[b];
}

/// Orthonormal tangents carried into a tilted plane along their normal: e + s n, e' + s' n, so s s' is their
/// product.
bool areCarriedOver(const Vec3& e1, const Vec3& e2) {
    constexpr double kTiltedRounding = 1e-7;
    const auto rise = [](const Vec3& e) { return std::sqrt(std::max(0.0, e.squaredNorm() - 1.0)); };
    return e1.squaredNorm() > 1.0 - kTiltedRounding && e2.squaredNorm() > 1.0 - kTiltedRounding &&
           std::abs(std::abs(e1.dot(e2)) - rise(e1) * rise(e2)) <= kTiltedRounding;
}

void checkFrame(const State& state, std::size_t i, Findings& findings) {
    const Interfaces& f = state.interfaces;
    const InterfaceFrame frame = f.frame(i);
    const bool on_b =
        isVertexEdge(f, i) ? areOrthonormal(frame.e1_b, frame.e2_b) : areCarriedOver(frame.e1_b, frame.e2_b);
    if (!findings.expect(areOrthonormal(frame.e1_a, frame.e2_a) && on_b, "interface", i,
                         "its tangents are not orthonormal"))
        return;
    const Vec3 e3_a = frame.e1_a.cross(frame.e2_a), e3_b = frame.e1_b.cross(frame.e2_b).normalized();
    if (isIdle(f, i)) return;
    if (isVertexEdge(f, i)) {
        findings.expect(isOutermost(state, f.block_a[i], f.face_a[i], frame.origin_a, e3_a), "interface", i,
                        "its normal does not point out of its reference block");
        findings.expect(isOnSurface(state, f.block_b[i], f.face_b[i], frame.origin_b), "interface", i,
                        "its vertex or edge is not one of the other block");
        return;
    }
    findings.expect(liesOnFace(state, f.block_a[i], f.face_a[i], frame.origin_a, e3_a), "interface", i,
                    "its frame does not lie on the face of a");
    findings.expect(liesOnFace(state, f.block_b[i], f.face_b[i], frame.origin_b, -e3_b), "interface", i,
                    "its frame does not lie on the face of b");
}

/// Counter-clockwise and convex but for rounding, about its centroid.
bool isPatch(const std::vector<Eigen::Vector2d>& outline, double patch_area) {
    Polygon polygon;
    for (const Eigen::Vector2d& corner : outline) polygon.push(corner);
    const double length = extent(polygon), rounding = kPatchRounding * length * length;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 in = polygon.next(k) - polygon[k],
                   out = polygon.next((k + 1) % polygon.size()) - polygon.next(k);
        if (in.x() * out.y() - in.y() * out.x() < -rounding) return false;
    }
    const double is = area(polygon);
    return std::abs(is - patch_area) <= kSameArea * patch_area + rounding &&
           centroid(polygon).norm() * is <= kInPlane * length * is + rounding * length;
}

/// Two faces meet once: what contact points remember is handed on by faces.
void checkFacesOnce(const Interfaces& f, Findings& findings) {
    std::vector<std::array<std::int32_t, 5>> faces;
    for (std::size_t i = 0; i < f.size(); ++i)
        if (!isVertexEdge(f, i))
            faces.push_back(
                {f.block_a[i], f.block_b[i], f.face_a[i], f.face_b[i], static_cast<std::int32_t>(i)});
    std::sort(faces.begin(), faces.end());
    for (std::size_t k = 1; k < faces.size(); ++k)
        findings.expect(!std::equal(faces[k].begin(), faces[k].end() - 1, faces[k - 1].begin()), "interface",
                        static_cast<std::size_t>(faces[k].back()), "its two faces have another one");
}

}  // namespace

void checkFrames(const State& state, Findings& findings) {
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        checkFrame(state, i, findings);
        if (!isVertexEdge(f, i))
            findings.expect(isPatch(patchOutline(f, i), f.area[i]), "interface", i,
                            "its patch is not convex, counter-clockwise and of its area");
    }
    checkFacesOnce(f, findings);
}

void checkPlaces(const State& state, Findings& findings) {
    const Interfaces& f = state.interfaces;
    std::vector<std::array<std::int32_t, 3>> pairs;
    for (const InterfaceGroup& group : f.groups) {
        if (group.corners != 1) continue;
        const auto begin = static_cast<std::size_t>(group.begin), size = static_cast<std::size_t>(group.size);
        if (!findings.expect(size % kPlacesOfPair == 0, "interface", begin,
                             "places for vertices and edges are not four for a pair of parts"))
            return;
        for (std::size_t i = begin; i < begin + size; ++i) {
            const std::size_t first = i - (i - begin) % kPlacesOfPair;
            findings.expect(f.block_a[i] == f.block_a[first] && f.block_b[i] == f.block_b[first] &&
                                f.area[i] == f.area[first] &&
                                partsOf(*state.geometry, f, i) == partsOf(*state.geometry, f, first),
                            "interface", i, "it is not like the other places of its pair of parts");
            if (i == first) {
                const auto [low, high] = partsOf(*state.geometry, f, i);
                pairs.push_back({low, high, static_cast<std::int32_t>(i)});
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t k = 1; k < pairs.size(); ++k)
        findings.expect(!std::equal(pairs[k].begin(), pairs[k].end() - 1, pairs[k - 1].begin()), "interface",
                        static_cast<std::size_t>(pairs[k].back()), "its pair of parts has places elsewhere");
}

void checkPoints(const State& state, Findings& findings) {
    const Interfaces& f = state.interfaces;
    const PointRule& rule = state.geometry->model.points;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const std::vector<contact::PatchPoint> points = interfacePoints(f, i, rule);
        if (!findings.expect(points.size() == f.pointCount(i), "interface", i,
                             "it has not the contact points of its patch"))
            continue;
        double sum = 0;
        bool remembered = true, placed = true;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::size_t slot = f.pointSlot(i, k);
            const contact::PointMemory memory = state.points.memoryAt(slot);
            sum += points[k].area;
            remembered = remembered && memory.bond >= 0 && memory.bond <= 1 &&
                         std::isfinite(memory.offset_1) && std::isfinite(memory.offset_2) &&
                         std::isfinite(memory.dilation);
            if (!state.points.places.empty())
                placed = placed && vectorAt(state.points.places, slot, 0) ==
                                       Vec3(points[k].position.x(), points[k].position.y(), points[k].area);
        }
        findings.expect(std::abs(sum - f.area[i]) <= kSameArea * f.area[i], "interface", i,
                        "its contact points' areas do not add up to the patch's");
        findings.expect(remembered, "interface", i,
                        "a bond is not in 0..1, or a slide or dilation no number");
        findings.expect(placed, "interface", i, "its contact points do not lie where the rule has them");
    }
}

}  // namespace talus
