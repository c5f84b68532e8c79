#include "contacts/vertex_edge_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "contacts/separating_axes.h"
#include "geometry/parts.h"

namespace talus {
namespace {

using axes::Edge, axes::Pair, axes::SeparatingAxis;
using axes::faceAxis, axes::findEdges, axes::forEachAxis, axes::vertexOf;

constexpr double kOnOutline = 1e-9;  // of the face's longest edge: a vertex this far outside counts as inside

/// Of the body's faces around a vertex, the one most opposed to a direction; -1: none, the vertex lies
/// inside.
std::int32_t incidentFace(const WorldShape& shape, std::int32_t vertex, const Vec3& direction) {
    std::int32_t best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const auto& outline = shape.faces[face];
        if (shape.isInner(face) || std::find(outline.begin(), outline.end(), vertex) == outline.end())
            continue;
        const double along = shape.normals[face].dot(direction);
        if (along < least) least = along, best = static_cast<std::int32_t>(face);
    }
    return best;
}

/// Two faces, one of each block.
struct Faces {
    std::int32_t first, second;
};

/// The faces that meet along an axis: those most opposed to each other.
Faces meetingFaces(const Pair& pair, const SeparatingAxis& axis) {
    if (!axis.is_edges) {
        const std::int32_t other =
            incidentFace(pair.shape(!axis.second_is_reference), axis.other, axis.normal);
        return axis.second_is_reference ? Faces{other, axis.face} : Faces{axis.face, other};
    }
    const Edge& e = pair.first_edges[static_cast<std::size_t>(axis.face)];
    const Edge& f = pair.second_edges[static_cast<std::size_t>(axis.other)];
    Faces best{-1, -1};
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t of_first : {e.left, e.right})
        for (const std::int32_t of_second : {f.left, f.right}) {
            if (pair.first.isInner(static_cast<std::size_t>(of_first)) ||
                pair.second.isInner(static_cast<std::size_t>(of_second)))
                continue;
            const double along = pair.first.normals[static_cast<std::size_t>(of_first)].dot(
                pair.second.normals[static_cast<std::size_t>(of_second)]);
            if (along < least) least = along, best = {of_first, of_second};
        }
    return best;
}

bool meetsFaceToFace(const Pair& pair, const SeparatingAxis& axis, const VertexEdgeLimits& limits) {
    const Faces faces = meetingFaces(pair, axis);
    const Vec3 &first = pair.first.normals[static_cast<std::size_t>(faces.first)],
               &second = pair.second.normals[static_cast<std::size_t>(faces.second)];
    const double angle = limits.face_angle + limits.angle_per_depth * std::max(0.0, -axis.distance);
    const double chord = (first + second).norm();
    return chord <= angle && chord <= 2.0 * std::sin(0.5 * angle);  // the chord is never longer than the arc
}

/// The nearest points of the lines of two edges, and whether both lie between the edges' ends.
struct Crossing {
    Vec3 first, second;
    bool within;
};

Crossing crossingOf(const Pair& pair, const SeparatingAxis& axis) {
    const Edge& e = pair.first_edges[static_cast<std::size_t>(axis.face)];
    const Edge& f = pair.second_edges[static_cast<std::size_t>(axis.other)];
    const Vec3 &p = vertexOf(pair.first, e.from), &q = vertexOf(pair.second, f.from);
    const double cosine = e.direction.dot(f.direction), sine_squared = 1.0 - cosine * cosine;
    const Vec3 apart = q - p;
    const double s = (apart.dot(e.direction) - cosine * apart.dot(f.direction)) / sine_squared;
    const double t = (cosine * apart.dot(e.direction) - apart.dot(f.direction)) / sine_squared;
    const double length_e = (vertexOf(pair.first, e.to) - p).norm(),
                 length_f = (vertexOf(pair.second, f.to) - q).norm();
    return {p + s * e.direction, q + t * f.direction, !(s < 0 || s > length_e || t < 0 || t > length_f)};
}

bool isInner(const WorldShape& shape, const Edge& edge) {
    return shape.isInner(static_cast<std::size_t>(edge.left)) &&
           shape.isInner(static_cast<std::size_t>(edge.right));
}

/// Largest relative motion before the next look.
struct Ahead {
    double travel = 0;  ///< any point against any other [m]
    double turn = 0;    ///< [rad]
};

/// From a point to a line between two others, seen along a unit vector [m].
double distanceSeenAlong(const Vec3& axis, const Vec3& x, const Vec3& from, const Vec3& to) {
    const auto seen = [&](const Vec3& v) -> Vec3 { return v - axis.dot(v) * axis; };
    const Vec3 line = seen(to - from), way = seen(x - from);
    const double square = line.squaredNorm();
    const double share = square > 0 ? std::clamp(way.dot(line) / square, 0.0, 1.0) : 0.0;
    return (way - share * line).norm();
}

/// How far the cross product of two edges may turn: by their turn over the sine of the angle between them
/// [rad].
double tiltOf(const Edge& first, const Edge& second, const Ahead& ahead) {
    return std::min(1.0, ahead.turn / first.direction.cross(second.direction).norm());
}

/// Whether two edges that do not cross between their ends may do so soon. Seen along the axis, points that
/// will lie on it are apart by the travel of the two, and by the turn of the axis over the distance between
/// the edges.
bool mayCross(const Pair& pair, const SeparatingAxis& axis, const Ahead& ahead) {
    const Edge& e = pair.first_edges[static_cast<std::size_t>(axis.face)];
    const Edge& f = pair.second_edges[static_cast<std::size_t>(axis.other)];
    const Vec3 &a = vertexOf(pair.first, e.from), &b = vertexOf(pair.first, e.to),
               &c = vertexOf(pair.second, f.from), &d = vertexOf(pair.second, f.to);
    const double apart =
        std::min({distanceSeenAlong(axis.normal, a, c, d), distanceSeenAlong(axis.normal, b, c, d),
                  distanceSeenAlong(axis.normal, c, a, b), distanceSeenAlong(axis.normal, d, a, b)});
    return apart <= ahead.travel + (std::abs(axis.distance) + ahead.travel) * tiltOf(e, f, ahead);
}

bool isOutermost(const WorldShape& shape, const Vec3& x, const Vec3& out, double turn) {
    return !shape.body || shape.body->isOutermost(x, out, turn);
}

/// Whether an edge is one of the body somewhere along it.
bool isSharp(const WorldShape& shape, const Edge& edge, const Vec3& out, double turn) {
    return !shape.body ||
           shape.body->isOutermostAlong(vertexOf(shape, edge.from), vertexOf(shape, edge.to), out, turn);
}

/// Whether the bodies themselves can touch along an axis, and not only these parts: faces, edges and vertices
/// between parts of one body cannot be touched. Replaces the other's lowest vertex by one that can be.
/// \param tie   vertices this much higher than the lowest count, too [m]
/// \param ahead  motion by which edges that do not cross yet may do so
bool isReal(const Pair& pair, SeparatingAxis& axis, double tie, const Ahead& ahead) {
    if (!pair.first.body && !pair.second.body) return true;
    if (axis.is_edges) {
        const Edge& e = pair.first_edges[static_cast<std::size_t>(axis.face)];
        const Edge& f = pair.second_edges[static_cast<std::size_t>(axis.other)];
        if (isInner(pair.first, e) || isInner(pair.second, f)) return false;
        const Crossing crossing = crossingOf(pair, axis);
        if (ahead.turn > 0) {
            return (crossing.within || mayCross(pair, axis, ahead)) &&
                   isSharp(pair.first, e, axis.normal, tiltOf(e, f, ahead)) &&
                   isSharp(pair.second, f, -axis.normal, tiltOf(e, f, ahead));
        }
        return crossing.within && isOutermost(pair.first, crossing.first, axis.normal, 0.0) &&
               isOutermost(pair.second, crossing.second, -axis.normal, 0.0);
    }
    const WorldShape &reference = pair.shape(axis.second_is_reference),
                     &other = pair.shape(!axis.second_is_reference);
    if (reference.isInner(static_cast<std::size_t>(axis.face))) return false;
    if (!other.body) return true;
    const double lowest = axis.normal.dot(vertexOf(other, axis.other));
    for (std::size_t v = 0; v < other.vertices.size(); ++v) {
        if (axis.normal.dot(other.vertices[v]) > lowest + tie) continue;
        if (!isOutermost(other, other.vertices[v], -axis.normal, ahead.turn)) continue;
        if (incidentFace(other, static_cast<std::int32_t>(v), axis.normal) < 0) continue;
        axis.other = static_cast<std::int32_t>(v);
        return true;
    }
    return false;
}

/// The axes they meet along, at best.
struct Meeting {
    SeparatingAxis faces, sharp;
    bool apart = false;
    double apart_by = 0;  // [m], at least
    bool met = true;      // along a real axis, or apart
};

/// The axis of two parts may be one along which the bodies do not meet. The real axis is at most this deeper,
/// times the tie.
constexpr double kDeeperThanParts = 200.0;

/// Axes of faces or edges along which they are no farther apart than this change nothing in what
/// findVertexEdgePoints makes of the meeting, real or not. Nearer than the sharp axis by more than the tie, an
/// axis could only replace the faces, which lose against the sharp axis either way. Nearer than the faces, it
/// could only replace a sharp axis that loses against these. For a face's normal that has to be clear by twice
/// the tie, since edges win against it only by more than the tie.
double floorOf(bool of_edges, const Meeting& best, double tie) {
    const double sharp = best.sharp.distance, faces = best.faces.distance;
    if (of_edges) return std::max(faces, sharp - 2.0 * tie);
    return std::max(std::min(sharp, faces), std::max(sharp, faces) - 2.0 * tie);
}

Meeting findMeeting(Pair& pair, const VertexEdgeLimits& limits) {
    Meeting best;
    double most = -std::numeric_limits<double>::infinity();
    const auto look = [&](SeparatingAxis axis) {
        best.apart = axis.distance > limits.reach;
        best.apart_by = axis.distance;
        if (best.apart) return false;
        most = std::max(most, axis.distance);
        if (axis.distance <= floorOf(axis.is_edges, best, limits.tie)) return true;
        if (!isReal(pair, axis, limits.tie, {})) return true;
        if (meetsFaceToFace(pair, axis, limits)) {
            if (axis.distance > best.faces.distance) best.faces = axis;
        } else if (axis.distance >
                   best.sharp.distance + (axis.is_edges && !best.sharp.is_edges ? limits.tie : 0.0)) {
            best.sharp = axis;
        }
        return true;
    };
    forEachAxis(pair, look, [&](bool of_edges) { return floorOf(of_edges, best, limits.tie); });
    const double deepest = most - kDeeperThanParts * limits.tie;
    best.met = best.apart || std::max(best.sharp.distance, best.faces.distance) >= deepest;
    return best;
}

void addPoint(VertexEdgePoints& found, const VertexEdgePoint& point) {
    if (found.count < VertexEdgePoints::kMost) {
        found.points[found.count++] = point;
        return;
    }
    VertexEdgePoint* widest =
        std::max_element(found.points.begin(), found.points.end(),
                         [](const VertexEdgePoint& a, const VertexEdgePoint& b) { return a.gap < b.gap; });
    if (point.gap < widest->gap) *widest = point;
}

/// A face's plane and the lines of its outline.
struct FaceOutline {
    const WorldShape& shape;
    const std::vector<std::int32_t>& outline;
    Vec3 normal;
    std::pmr::vector<Vec3> outward;  ///< of each line, unit
    double size = 0;

    FaceOutline(const WorldShape& placed, std::size_t face, std::pmr::polymorphic_allocator<> memory)
        : shape(placed), outline(placed.faces[face]), normal(placed.normals[face]), outward(memory) {
        outward.reserve(outline.size());
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vec3 line = corner(i + 1) - corner(i);
            outward.push_back(line.cross(normal).normalized());
            size = std::max(size, line.norm());
        }
    }
    const Vec3& corner(std::size_t i) const { return vertexOf(shape, outline[i % outline.size()]); }
    double height(const Vec3& x) const { return normal.dot(x - corner(0)); }
    /// Distance beyond the i-th line, positive outside [m].
    double beyond(std::size_t i, const Vec3& x) const { return outward[i].dot(x - corner(i)); }
    bool covers(const Vec3& x) const {
        for (std::size_t i = 0; i < outline.size(); ++i)
            if (beyond(i, x) > kOnOutline * size) return false;
        return true;
    }
};

/// The part of a segment above the face, as shares of its length; empty when begin >= end.
struct Share {
    double begin = 0, end = 1;
};

Share clip(const FaceOutline& face, const Vec3& from, const Vec3& to) {
    Share share;
    for (std::size_t i = 0; i < face.outline.size(); ++i) {
        const double a = face.beyond(i, from), b = face.beyond(i, to);
        if (a > 0 && b > 0) return {1, 0};
        if (a > 0) share.begin = std::max(share.begin, a / (a - b));
        if (b > 0) share.end = std::min(share.end, a / (a - b));
    }
    return share;
}

/// Of an edge's two faces, as far as they are surface, the one most opposed to a direction.
std::int32_t faceOf(const WorldShape& shape, const Edge& edge, const Vec3& direction) {
    if (shape.isInner(static_cast<std::size_t>(edge.left))) return edge.right;
    if (shape.isInner(static_cast<std::size_t>(edge.right))) return edge.left;
    const auto along = [&](std::int32_t f) {
        return shape.normals[static_cast<std::size_t>(f)].dot(direction);
    };
    return along(edge.left) <= along(edge.right) ? edge.left : edge.right;
}

VertexEdgePoints pointsOnFace(Pair& pair, const SeparatingAxis& axis, double reach) {
    const WorldShape& other = pair.shape(!axis.second_is_reference);
    const FaceOutline face(pair.shape(axis.second_is_reference), static_cast<std::size_t>(axis.face),
                           pair.first_edges.get_allocator());
    const Vec3 e1 = (face.corner(1) - face.corner(0)).normalized(), e2 = face.normal.cross(e1);
    VertexEdgePoints found;
    const auto add = [&](const Vec3& x, std::int32_t other_face) {
        const double gap = face.height(x);
        if (gap <= reach && (!other.body || other.body->isOutermost(x, -face.normal)))
            addPoint(found, {axis.second_is_reference, x - gap * face.normal, x, e1, e2, axis.face,
                             other_face, gap});
    };
    for (std::size_t v = 0; v < other.vertices.size(); ++v)
        if (face.height(other.vertices[v]) <= reach && face.covers(other.vertices[v]))
            if (const auto at = incidentFace(other, static_cast<std::int32_t>(v), face.normal); at >= 0)
                add(other.vertices[v], at);
    auto& edges = axis.second_is_reference ? pair.first_edges : pair.second_edges;
    if (edges.empty()) findEdges(other, edges);
    const PartOfBody* body = pair.shape(axis.second_is_reference).body;
    // Where the reference body's surface continues in another part, it has no edge.
    const auto addCrossing = [&](const Vec3& x, const Vec3& outward, std::int32_t other_face) {
        const Vec3 along = (outward - outward.dot(face.normal) * face.normal).normalized();
        if (!body || !body->goesOnFlat(x - face.height(x) * face.normal, along, face.normal))
            add(x, other_face);
    };
    for (const Edge& edge : edges) {
        const Vec3 &from = vertexOf(other, edge.from), &to = vertexOf(other, edge.to);
        if (std::min(face.height(from), face.height(to)) > reach || isInner(other, edge)) continue;
        const Share share = clip(face, from, to);
        if (share.begin >= share.end) continue;
        const std::int32_t other_face = faceOf(other, edge, face.normal);
        if (share.begin > 0 && !face.covers(from))
            addCrossing(from + share.begin * (to - from), from - to, other_face);
        if (share.end < 1 && !face.covers(to))
            addCrossing(from + share.end * (to - from), to - from, other_face);
    }
    return found;
}

VertexEdgePoints pointBetweenEdges(const Pair& pair, const SeparatingAxis& axis) {
    const Vec3& along = pair.first_edges[static_cast<std::size_t>(axis.face)].direction;
    const Crossing crossing = crossingOf(pair, axis);
    VertexEdgePoints found;
    if (!crossing.within) return found;
    const Faces faces = meetingFaces(pair, axis);
    addPoint(found, {false, crossing.first, crossing.second, along, axis.normal.cross(along), faces.first,
                     faces.second, axis.distance});
    return found;
}

}  // namespace

VertexEdgePoints findVertexEdgePoints(const WorldShape& first, const WorldShape& second,
                                      const VertexEdgeLimits& limits) {
    Pair pair{first, second};
    const Meeting meeting = findMeeting(pair, limits);
    VertexEdgePoints found;
    if (meeting.apart) {
        found.distance = meeting.apart_by;
        return found;
    }
    if (!meeting.met) {
        found.near = true;
        return found;
    }
    const bool sharp = meeting.sharp.distance > meeting.faces.distance + limits.tie;
    const SeparatingAxis& axis = sharp ? meeting.sharp : meeting.faces;
    if (sharp) found = axis.is_edges ? pointBetweenEdges(pair, axis) : pointsOnFace(pair, axis, limits.reach);
    const Faces faces = meetingFaces(pair, axis);
    found.near = true;
    found.distance = axis.distance;
    found.axis = axis.second_is_reference ? Vec3(-axis.normal) : axis.normal;
    found.first_face = faces.first;
    found.second_face = faces.second;
    return found;
}

namespace {

/// Parallelepipeds with parallel faces: any axis along which they meet is the normal of a face of each.
bool areParallelSided(const WorldShape& first, const WorldShape& second, double angle) {
    if (first.faces.size() != 6 || second.faces.size() != 6 || first.vertices.size() != 8 ||
        second.vertices.size() != 8)
        return false;
    const double chord = 2.0 * std::sin(0.5 * angle);
    return std::all_of(first.normals.begin(), first.normals.end(), [&](const Vec3& n) {
        return std::any_of(second.normals.begin(), second.normals.end(),
                           [&](const Vec3& m) { return (n + m).squaredNorm() <= chord * chord; });
    });
}

/// At least half of the largest distance between two vertices, at most all of it [m].
double widthOf(const WorldShape& shape) {
    double most = 0;
    for (const Vec3& v : shape.vertices) most = std::max(most, (v - shape.vertices[0]).norm());
    return most;
}

/// Whether a plane at this distance over a face of a part has the other part beyond it.
bool isBeyondFaceOf(const WorldShape& reference, const WorldShape& other, double distance) {
    for (std::size_t face = 0; face < reference.faces.size(); ++face) {
        const Vec3 &normal = reference.normals[face], &origin = vertexOf(reference, reference.faces[face][0]);
        // Most faces are passed over after one vertex.
        if (std::all_of(other.vertices.begin(), other.vertices.end(),
                        [&](const Vec3& v) { return normal.dot(v - origin) > distance; }))
            return true;
    }
    return false;
}

}  // namespace

bool areApart(const WorldShape& first, const WorldShape& second, double distance) {
    return isBeyondFaceOf(first, second, distance) || isBeyondFaceOf(second, first, distance);
}

Approach approachOf(const WorldShape& first, const WorldShape& second, const VertexEdgeLimits& limits,
                    double travel, double turn) {
    if (areParallelSided(first, second, limits.face_angle - turn)) return Approach::faces;
    Pair pair{first, second};
    VertexEdgeLimits narrow = limits;
    narrow.face_angle -= turn;
    narrow.angle_per_depth = 0;
    double of_parts = -std::numeric_limits<double>::infinity(), most = of_parts, sharpest = of_parts;
    bool apart = false;
    forEachAxis(pair, [&](SeparatingAxis axis) {
        apart = axis.distance > limits.reach + travel;
        if (apart) return false;
        of_parts = std::max(of_parts, axis.distance);
        if (axis.distance <= most - travel || !isReal(pair, axis, limits.tie + travel, {travel, turn}))
            return true;
        most = std::max(most, axis.distance);
        if (axis.distance > sharpest && !meetsFaceToFace(pair, axis, narrow)) sharpest = axis.distance;
        return true;
    });
    if (apart) return Approach::apart;
    // As in findMeeting: parts that touch where their bodies do not, now or before the next look.
    const double deepest = of_parts - travel - kDeeperThanParts * limits.tie;
    if (most < deepest && most < deepest - turn * (widthOf(first) + widthOf(second))) return Approach::faces;
    return sharpest > most - travel ? Approach::vertex_edge : Approach::faces;
}

}  // namespace talus
