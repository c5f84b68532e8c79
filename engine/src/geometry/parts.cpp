#include "geometry/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "geometry/box_tree.h"
#include "geometry/face_frame.h"
#include "geometry/separation.h"

namespace talus {
namespace {

constexpr double kTouchingFaces = 1e-6;  // of the extent: faces of two parts this near lie on each other
constexpr double kOpposite =
    1e-3;  // [rad], likewise, so that small faces are told apart by more than their distance
constexpr double kLeastCover = 1e-9;  // share of a face
constexpr double kWhole = 1e-6;       // likewise: a face with a smaller free share is inside

Box boundsOf(const Polyhedron& shape) {
    Box bounds;
    for (const Vec3& v : shape.vertices) bounds.add(v);
    return bounds;
}

double extentOf(const Polyhedron& shape) {
    const Box bounds = boundsOf(shape);
    return (bounds.max - bounds.min).maxCoeff();
}

bool areNear(const Box& a, const Box& b, double distance) {
    return (a.min.array() <= b.max.array() + distance).all() &&
           (b.min.array() <= a.max.array() + distance).all();
}

std::size_t faceCount(const ConvexPart& part) { return part.faces.size(); }

std::span<const Vec3> verticesOf(const Polyhedron& shape, const ConvexPart& part) {
    return std::span(shape.vertices)
        .subspan(static_cast<std::size_t>(part.first_vertex), static_cast<std::size_t>(part.vertices));
}

bool areOpposite(const Vec3& normal_1, const Vec3& normal_2) {
    constexpr double kClearly = 1.01;  // more than rounding: most pairs need no square root
    const double square = (normal_1 + normal_2).squaredNorm();
    return square <= kClearly * kOpposite * kOpposite && std::sqrt(square) <= kOpposite;
}

Polygon outlineIn(const FaceFrame& frame, const Polyhedron& shape, std::size_t face) {
    Polygon outline;
    for (const std::int32_t v : shape.faces[face])
        outline.push(frame.toPlane(shape.vertices[static_cast<std::size_t>(v)]));
    return outline;
}

/// The part of a face `under` that another part's face covers; empty when it does not.
/// \param normal  of `under`. \pre the normals are opposite
Polygon commonPart(const Polyhedron& shape, std::size_t under, const Vec3& normal, std::size_t over,
                   double touch) {
    const auto& own = shape.faces[under];
    const FaceFrame frame = faceFrame(shape.vertices[static_cast<std::size_t>(own[0])],
                                      shape.vertices[static_cast<std::size_t>(own[1])], normal);
    const auto& outline = shape.faces[over];
    Polygon other;
    for (std::size_t i = outline.size(); i-- > 0;) {
        const Vec3& v = shape.vertices[static_cast<std::size_t>(outline[i])];
        if (std::abs(frame.height(v)) > touch) return {};
        other.push(frame.toPlane(v));
    }
    return intersect(outlineIn(frame, shape, under), other);
}

/// All parts' vertices and faces one after the other; nothing is known of covers yet.
Polyhedron laidTogether(const std::vector<Polyhedron>& parts, std::vector<ConvexPart>& ranges) {
    Polyhedron whole;
    std::vector<FaceList::Outline> outlines;
    for (const Polyhedron& part : parts) {
        const auto first = static_cast<std::int32_t>(whole.vertices.size());
        ranges.push_back({first, static_cast<std::int32_t>(part.vertices.size()),
                          static_cast<std::int32_t>(outlines.size()), part.faces});
        whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (FaceList::Outline outline : part.faces) {
            for (std::int32_t& v : outline) v += first;
            outlines.push_back(std::move(outline));
        }
    }
    whole.faces = FaceList(std::move(outlines), ranges, {});
    return whole;
}

/// Finds which parts touch each other, and by which faces.
class Joiner {
 public:
    Joiner(const std::vector<Polyhedron>& parts)
        : parts_(parts),
          whole_(laidTogether(parts, ranges_)),
          touch_(kTouchingFaces * extentOf(whole_)),
          covered_(whole_.faces.size(), 0.0),
          root_(parts.size()) {
        for (std::size_t f = 0; f < whole_.faces.size(); ++f) normals_.push_back(whole_.faceNormal(f));
        std::iota(root_.begin(), root_.end(), std::size_t{0});
    }

    Result<Polyhedron> run() {
        meetAll([](std::size_t, std::size_t) { return true; });
        for (std::size_t i = 1; i < parts_.size() && errors_.empty(); ++i)
            if (rootOf(i) != rootOf(0))
                errors_.push_back(
                    {"[" + std::to_string(i) + "]",
                     "found a part that shares no face with the others, allowed: parts that share faces"});
        if (!errors_.empty()) return std::move(errors_);
        return finish();
    }

    /// For bodies given one after the other: known covers stay, and only parts of different bodies are
    /// compared. Overlaps are no errors.
    std::optional<Polyhedron> unite(const std::vector<Polyhedron>& bodies) {
        std::vector<std::size_t> body_of;
        for (std::size_t body = 0; body < bodies.size(); ++body) {
            keep(bodies[body], body_of.size());
            body_of.insert(body_of.end(), bodies[body].partCount(), body);
        }
        if (!meetAll([&](std::size_t i, std::size_t j) { return body_of[i] != body_of[j]; })) return {};
        for (ConvexPart& part : ranges_) std::sort(part.beside.begin(), part.beside.end());
        return finish();
    }

 private:
    Polyhedron finish() {
        std::vector<FaceList::Outline> outlines(whole_.faces.begin(), whole_.faces.end());
        whole_.faces = FaceList(std::move(outlines), std::move(ranges_), covers());
        return std::move(whole_);
    }

    void keep(const Polyhedron& body, std::size_t first_part) {
        if (body.partCount() == 1) return;
        const auto first_face = static_cast<std::size_t>(ranges_[first_part].first_face);
        for (std::size_t p = 0; p < body.partCount(); ++p) {
            for (const std::int32_t beside : body.faces.parts()[p].beside)
                ranges_[first_part + p].beside.push_back(beside + static_cast<std::int32_t>(first_part));
        }
        for (std::size_t f = 0; f < body.faces.size(); ++f)
            for (const Polygon& cover : coversOf(body, f)) covered_[first_face + f] += area(cover);
    }

    std::size_t rootOf(std::size_t part) {
        while (root_[part] != part) part = root_[part] = root_[root_[part]];
        return part;
    }

    /// Compares each with those after it, in order: sums of covers and lists of neighbours depend on that.
    /// \return whether any two of the compared parts touch
    template <class Asked>
    bool meetAll(const Asked& asked) {
        bool any = false;
        std::vector<Box> bounds;
        for (const Polyhedron& part : parts_) bounds.push_back(boundsOf(part));
        const BoxTree tree(std::move(bounds));
        std::vector<std::size_t> behind;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            behind.clear();
            // Twice as wide as near: rounding leaves none out.
            tree.visit(tree[i].grown(2.0 * touch_), [&](std::size_t j) {
                if (j > i && asked(i, j) && areNear(tree[i], tree[j], touch_)) behind.push_back(j);
            });
            std::sort(behind.begin(), behind.end());
            for (const std::size_t j : behind) any = meet(i, j) || any;
        }
        return any;
    }

    /// Of a part, with the normals that are known already.
    WorldShape shapeOf(std::size_t part) const {
        const ConvexPart& range = ranges_[part];
        const auto first = static_cast<std::size_t>(range.first_face);
        return {parts_[part].vertices, parts_[part].faces,
                std::span(normals_).subspan(first, faceCount(range))};
    }

    /// \return whether they touch
    bool meet(std::size_t i, std::size_t j) {
        const double depth = -findSeparation(shapeOf(i), shapeOf(j), -touch_).distance;
        if (depth > touch_) {
            errors_.push_back({"[" + std::to_string(j) + "]", "found a part that overlaps part " +
                                                                  std::to_string(i) +
                                                                  ", allowed: parts that share faces only"});
        } else if (-depth > touch_) {
            return false;
        }
        ranges_[i].beside.push_back(static_cast<std::int32_t>(j));
        ranges_[j].beside.push_back(static_cast<std::int32_t>(i));
        if (shareFaces(ranges_[i], ranges_[j]))
            root_[std::max(rootOf(i), rootOf(j))] = std::min(rootOf(i), rootOf(j));
        return true;
    }

    bool shareFaces(const ConvexPart& first, const ConvexPart& second) {
        bool any = false;
        for (std::size_t f = 0; f < faceCount(first); ++f)
            for (std::size_t g = 0; g < faceCount(second); ++g) {
                const std::size_t under = static_cast<std::size_t>(first.first_face) + f,
                                  over = static_cast<std::size_t>(second.first_face) + g;
                if (!areOpposite(normals_[under], normals_[over])) continue;
                const Polygon common = commonPart(whole_, under, normals_[under], over, touch_);
                if (common.empty()) continue;
                const double shared = area(common);
                covered_[under] += shared;
                covered_[over] += shared;
                any = any || shared > kLeastCover * std::min(whole_.faceArea(under), whole_.faceArea(over));
            }
        return any;
    }

    std::vector<Cover> covers() const {
        std::vector<Cover> covers;
        for (std::size_t f = 0; f < covered_.size(); ++f) {
            const double share = covered_[f] / whole_.faceArea(f);
            covers.push_back(share >= 1.0 - kWhole ? Cover::wholly
                             : share > kLeastCover ? Cover::partly
                                                   : Cover::none);
        }
        return covers;
    }

    const std::vector<Polyhedron>& parts_;
    std::vector<ConvexPart> ranges_;
    Polyhedron whole_;
    double touch_;
    std::vector<double> covered_;  ///< of each face [m^2]
    std::vector<Vec3> normals_{};  ///< likewise, outward
    std::vector<std::size_t> root_;
    std::vector<Error> errors_;
};

/// Whether a convex part holds a point, within a distance.
bool holds(std::span<const FacePlane> part, const Vec3& point, double distance) {
    return std::all_of(part.begin(), part.end(),
                       [&](const FacePlane& face) { return !(face.normal.dot(point - face.at) > distance); });
}

/// How far a part reaches beyond a point along a direction, less `slack` for each metre of distance [m].
double reachBeyond(const Polyhedron& shape, const ConvexPart& part, const Vec3& point, const Vec3& direction,
                   double slack) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : verticesOf(shape, part))
        most = std::max(most, direction.dot(v - point) - slack * (v - point).norm());
    return most;
}

/// Along the line from one point to another.
struct Share {
    double begin = 0, end = 1;
};

/// The part of it in a convex part, within a distance; empty when begin > end.
Share heldBetween(std::span<const FacePlane> part, const Vec3& from, const Vec3& to, double distance) {
    Share held;
    for (const FacePlane& face : part) {
        const double a = face.normal.dot(from - face.at) - distance,
                     b = face.normal.dot(to - face.at) - distance;
        if (a > 0 && b > 0) return {1, 0};
        if (a > 0) held.begin = std::max(held.begin, a / (a - b));
        if (b > 0) held.end = std::min(held.end, a / (a - b));
        if (held.begin > held.end) break;
    }
    return held;
}

}  // namespace

Result<Polyhedron> joinParts(const std::vector<Polyhedron>& parts) {
    if (parts.empty()) return Error{"", "found no parts, allowed: at least one"};
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].partCount() > 1)
            return Error{"[" + std::to_string(i) + "]", "found a part made of parts, allowed: convex ones"};
    if (parts.size() == 1) return parts[0];
    return Joiner(parts).run();
}

std::optional<Polyhedron> unionOf(const std::vector<Polyhedron>& bodies) {
    if (bodies.size() < 2) return {};
    std::vector<Polyhedron> parts;
    for (const Polyhedron& body : bodies)
        for (Polyhedron& part : partsOf(body)) parts.push_back(std::move(part));
    return Joiner(parts).unite(bodies);
}

std::vector<Polyhedron> partsOf(const Polyhedron& shape) {
    if (shape.partCount() == 1) return {shape};
    std::vector<Polyhedron> parts;
    for (const ConvexPart& part : shape.faces.parts()) {
        const auto vertices = verticesOf(shape, part);
        parts.push_back({{vertices.begin(), vertices.end()}, part.faces});
    }
    return parts;
}

std::vector<FacePlane> facePlanes(const Polyhedron& shape) {
    std::vector<FacePlane> planes;
    planes.reserve(shape.faces.size());
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        planes.push_back(
            {shape.faceNormal(face), shape.vertices[static_cast<std::size_t>(shape.faces[face][0])]});
    }
    return planes;
}

bool contains(const Polyhedron& shape, const Vec3& point, double tolerance) {
    // Face by face: the first few exclude most.
    const auto is_within = [&](std::size_t face) {
        return !(shape.faceNormal(face).dot(
                     point - shape.vertices[static_cast<std::size_t>(shape.faces[face][0])]) > tolerance);
    };
    const auto is_held = [&](std::size_t first, std::size_t count) {
        std::size_t face = first;
        while (face < first + count && is_within(face)) ++face;
        return face == first + count;
    };
    if (shape.partCount() == 1) return is_held(0, shape.faces.size());
    const auto& parts = shape.faces.parts();
    return std::any_of(parts.begin(), parts.end(), [&](const ConvexPart& part) {
        return is_held(static_cast<std::size_t>(part.first_face), faceCount(part));
    });
}

std::vector<std::int32_t> sideTowards(const Polyhedron& shape, const Vec3& direction) {
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        if (shape.isInner(face)) continue;
        const double along = shape.faceNormal(face).dot(direction);
        if (along > most) most = along, best = face;
    }
    std::vector<std::int32_t> side{static_cast<std::int32_t>(best)};
    if (shape.partCount() == 1) return side;
    const FaceFrame plane = faceFrame(shape, best);
    const double touch = kTouchingFaces * extentOf(shape);
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const auto& outline = shape.faces[face];
        if (face != best && !shape.isInner(face) && (shape.faceNormal(face) - plane.e3).norm() <= kOpposite &&
            std::all_of(outline.begin(), outline.end(), [&](std::int32_t v) {
                return std::abs(plane.height(shape.vertices[static_cast<std::size_t>(v)])) <= touch;
            }))
            side.push_back(static_cast<std::int32_t>(face));
    }
    return side;
}

Polygon outlineOf(const Polyhedron& shape, std::size_t face) {
    return outlineIn(faceFrame(shape, face), shape, face);
}

std::vector<Polygon> coversOf(const Polyhedron& shape, std::size_t face) {
    std::vector<Polygon> covers;
    if (shape.faces.covers().empty() || shape.faces.covers()[face] == Cover::none) return covers;
    const auto& parts = shape.faces.parts();
    const double touch = kTouchingFaces * extentOf(shape);
    const Vec3 normal = shape.faceNormal(face);
    for (const std::int32_t beside : parts[partOf(shape.faces, face)].beside) {
        const ConvexPart& other = parts[static_cast<std::size_t>(beside)];
        for (std::size_t f = 0; f < faceCount(other); ++f) {
            const std::size_t over = static_cast<std::size_t>(other.first_face) + f;
            if (!areOpposite(normal, shape.faceNormal(over))) continue;
            Polygon common = commonPart(shape, face, normal, over, touch);
            if (!common.empty()) covers.push_back(std::move(common));
        }
    }
    return covers;
}

std::size_t partOf(const FaceList& faces, std::size_t face) {
    const auto& parts = faces.parts();
    if (parts.empty()) return 0;
    const auto next = std::upper_bound(
        parts.begin(), parts.end(), static_cast<std::int32_t>(face),
        [](std::int32_t wanted, const ConvexPart& part) { return wanted < part.first_face; });
    return static_cast<std::size_t>(next - parts.begin()) - 1;
}

std::span<const Cover> PartOfBody::covers() const {
    const ConvexPart& own_part = shape.faces.parts()[part];
    return std::span(shape.faces.covers())
        .subspan(static_cast<std::size_t>(own_part.first_face), faceCount(own_part));
}

bool PartOfBody::isOutermost(const Vec3& point, const Vec3& direction, double slack) const {
    const Vec3 x = own(point), along = turn.transpose() * direction;
    const auto& parts = shape.faces.parts();
    return std::none_of(parts[part].beside.begin(), parts[part].beside.end(), [&](std::int32_t beside) {
        const ConvexPart& other = parts[static_cast<std::size_t>(beside)];
        return holds(planesOf(other), x, tolerance) && reachBeyond(shape, other, x, along, slack) > tolerance;
    });
}

bool PartOfBody::isOutermostAlong(const Vec3& from, const Vec3& to, const Vec3& direction,
                                  double slack) const {
    const Vec3 a = own(from), b = own(to), along = turn.transpose() * direction;
    const auto& parts = shape.faces.parts();
    std::vector<Share> covered;  // by parts that reach farther, tested at both ends of their interval
    for (const std::int32_t beside : parts[part].beside) {
        const ConvexPart& other = parts[static_cast<std::size_t>(beside)];
        const Share held = heldBetween(planesOf(other), a, b, tolerance);
        if (held.begin > held.end) continue;
        const auto reaches_from = [&](double share) {
            return reachBeyond(shape, other, a + share * (b - a), along, slack) > tolerance;
        };
        if (reaches_from(held.begin) && reaches_from(held.end)) covered.push_back(held);
    }
    std::sort(covered.begin(), covered.end(),
              [](const Share& s, const Share& t) { return s.begin < t.begin; });
    const double least = tolerance / std::max(tolerance, (b - a).norm());
    double done = 0;
    for (const Share& share : covered) {
        if (share.begin > done + least) return true;
        done = std::max(done, share.end);
    }
    return done < 1 - least;
}

bool PartOfBody::goesOnFlat(const Vec3& point, const Vec3& outward, const Vec3& normal) const {
    constexpr double kAhead = 10.0;  // of the tolerance
    const Vec3 x = own(point) + kAhead * tolerance * (turn.transpose() * outward),
               up = turn.transpose() * normal;
    const auto& parts = shape.faces.parts();
    return std::any_of(parts[part].beside.begin(), parts[part].beside.end(), [&](std::int32_t beside) {
        const ConvexPart& other = parts[static_cast<std::size_t>(beside)];
        return holds(planesOf(other), x, tolerance) && reachBeyond(shape, other, x, up, 0.0) <= tolerance;
    });
}

bool PartOfBody::isInOther(const Vec3& point) const {
    const Vec3 x = own(point);
    const auto& parts = shape.faces.parts();
    return std::any_of(parts[part].beside.begin(), parts[part].beside.end(), [&](std::int32_t beside) {
        return holds(planesOf(parts[static_cast<std::size_t>(beside)]), x, tolerance);
    });
}

}  // namespace talus
