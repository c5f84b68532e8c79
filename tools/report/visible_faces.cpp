#include "report/visible_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace talus::tools {

namespace {

constexpr double kInset = 0.002;  // of the way to the middle: points of a face that are looked at
constexpr double kFlat = 1e-4;    // of a normal: faces that differ by less lie in one plane
constexpr double kCrease = 0.9;   // cosine: edges that turn less are no rims
constexpr int kGrid = 8;          // points a side of a face that its own body covers in part
constexpr double kBeside = 0.02;  // of an edge: how far beside it what lies there is looked at
constexpr int kAlong = 16;  // places of an edge that is looked at where other parts cover its faces in part
constexpr int kBisections = 6;  // to where it changes between two of them

struct Bounds {
    Vec3 min = Vec3::Constant(kInfinity), max = Vec3::Constant(-kInfinity);

    void add(const Vec3& point) {
        min = min.cwiseMin(point);
        max = max.cwiseMax(point);
    }
};

/// Looks up what is at a point, by a grid over the bounds of the blocks' convex parts.
class BlockFinder {
 public:
    explicit BlockFinder(const Model& model) {
        for (std::size_t b = 0; b < model.blocks.size(); ++b)
            for (const Polyhedron& shape : partsOf(model.blocks[b].shape)) addPart(b, shape);
        const double volume = (all_.max - all_.min).prod();
        cell_ = std::cbrt(volume / static_cast<double>(parts_.size()));
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const auto low = cellOf(parts_[p].bounds.min), high = cellOf(parts_[p].bounds.max);
            for (auto x = low[0]; x <= high[0]; ++x)
                for (auto y = low[1]; y <= high[1]; ++y)
                    for (auto z = low[2]; z <= high[2]; ++z) cells_[key(x, y, z)].push_back(p);
        }
    }

    double size() const { return (all_.max - all_.min).norm(); }

    bool isInside(const Vec3& point) const {
        return any(point, [](const Part&) { return true; });
    }
    bool isInside(const Vec3& point, std::size_t block) const {
        return any(point, [block](const Part& part) { return part.block == block; });
    }

 private:
    struct Part {
        std::size_t block;
        Bounds bounds;
        std::vector<std::pair<Vec3, Vec3>> planes;  ///< outward normal and a point
    };

    void addPart(std::size_t block, const Polyhedron& shape) {
        Part part{block, {}, {}};
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
            part.planes.emplace_back(shape.faceNormal(f),
                                     shape.vertices[static_cast<std::size_t>(shape.faces[f].front())]);
        }
        for (const Vec3& v : shape.vertices) part.bounds.add(v);
        all_.add(part.bounds.min);
        all_.add(part.bounds.max);
        parts_.push_back(std::move(part));
    }

    std::array<std::int64_t, 3> cellOf(const Vec3& point) const {
        std::array<std::int64_t, 3> cell;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<Eigen::Index>(i);
            cell[i] = static_cast<std::int64_t>(std::floor((point[axis] - all_.min[axis]) / cell_));
        }
        return cell;
    }
    static std::int64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
        return x + (y + (z << 21)) * (std::int64_t{1} << 21);
    }

    template <typename Counts>
    bool any(const Vec3& point, const Counts& counts) const {
        const auto [x, y, z] = cellOf(point);
        const auto found = cells_.find(key(x, y, z));
        return found != cells_.end() &&
               std::any_of(found->second.begin(), found->second.end(),
                           [&](std::size_t p) { return counts(parts_[p]) && contains(parts_[p], point); });
    }

    static bool contains(const Part& part, const Vec3& point) {
        return (point.array() >= part.bounds.min.array()).all() &&
               (point.array() <= part.bounds.max.array()).all() &&
               std::none_of(part.planes.begin(), part.planes.end(),
                            [&](const auto& plane) { return plane.first.dot(point - plane.second) > 0; });
    }

    std::vector<Part> parts_;
    Bounds all_;
    double cell_ = 1;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

/// Whether other blocks lie against the whole face, by its middle, its corners and points of its sides.
/// Hidden faces missed here are painted over.
bool isCovered(const BlockFinder& finder, const Polyhedron& shape, std::size_t f, const Vec3& normal,
               const Vec3& centroid) {
    const Vec3 off = 1e-5 * finder.size() * normal;
    if (!finder.isInside(centroid + off)) return false;
    const auto& outline = shape.faces[f];
    const auto covered = [&](const Vec3& rim) {
        return finder.isInside(rim + kInset * (centroid - rim) + off);
    };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3& a = shape.vertices[static_cast<std::size_t>(outline[i])];
        const Vec3& b = shape.vertices[static_cast<std::size_t>(outline[(i + 1) % outline.size()])];
        for (const double share : {0.0, 0.25, 0.5, 0.75})
            if (!covered(a + share * (b - a))) return false;
    }
    // A face partly covered by other parts of its body may be free anywhere.
    const bool is_partly = !shape.faces.covers().empty() && shape.faces.covers()[f] == Cover::partly;
    for (std::size_t i = 1; is_partly && i + 1 < outline.size(); ++i) {
        const Vec3& origin = shape.vertices[static_cast<std::size_t>(outline[0])];
        const Vec3 one = shape.vertices[static_cast<std::size_t>(outline[i])] - origin,
                   other = shape.vertices[static_cast<std::size_t>(outline[i + 1])] - origin;
        for (int m = 0; m < kGrid; ++m) {
            for (int n = 0; m + n < kGrid; ++n) {
                if (!finder.isInside(origin + (m + 0.3) / kGrid * one + (n + 0.3) / kGrid * other + off))
                    return false;
            }
        }
    }
    return true;
}

/// Whether a point of the face's plane lies in its outline, which is convex.
bool isInOutline(const Polyhedron& shape, std::size_t f, const Vec3& normal, const Vec3& point) {
    const auto& outline = shape.faces[f];
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3& a = shape.vertices[static_cast<std::size_t>(outline[k])];
        const Vec3& b = shape.vertices[static_cast<std::size_t>(outline[(k + 1) % outline.size()])];
        if ((b - a).cross(point - a).dot(normal) < -1e-6 * (b - a).squaredNorm()) return false;
    }
    return true;
}

/// The kinds of the edges of one block's faces.
class EdgeTeller {
 public:
    EdgeTeller(const BlockFinder& finder, const Polyhedron& shape, std::size_t block)
        : finder_(finder), shape_(shape), block_(block) {
        for (std::size_t f = 0; f < shape.faces.size(); ++f) normals_.push_back(shape.faceNormal(f));
    }

    /// The corners and sides of a face as they are seen: a side for each stretch of an edge that is of one
    /// kind.
    PaintedPolygon polygon(std::size_t f, const Camera& camera) const {
        PaintedPolygon polygon;
        const auto& outline = shape_.faces[f];
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const Edge edge =
                edgeOf(f, shape_.vertices[static_cast<std::size_t>(outline[k])],
                       shape_.vertices[static_cast<std::size_t>(outline[(k + 1) % outline.size()])]);
            const std::vector<double> stops = stopsOf(edge);
            for (std::size_t i = 0; i + 1 < stops.size(); ++i)
                addSides(edge, stops[i], stops[i + 1], camera, polygon);
        }
        return polygon;
    }

 private:
    struct Edge {
        std::size_t face;
        Vec3 from, to;
        std::vector<std::size_t> others;  ///< faces of the body in whose planes it lies
        /// Other parts of the body cover these faces in part: the neighbour may change anywhere.
        bool changes;

        Vec3 at(double share) const { return from + share * (to - from); }
        double length() const { return (to - from).norm(); }
    };

    Edge edgeOf(std::size_t f, const Vec3& from, const Vec3& to) const {
        const auto is_partly = [&](std::size_t g) {
            return !shape_.faces.covers().empty() && shape_.faces.covers()[g] == Cover::partly;
        };
        Edge edge{f, from, to, {}, is_partly(f)};
        for (std::size_t g = 0; g < normals_.size(); ++g) {
            if (g == f || shape_.isInner(g) || !isInPlane(g, from) || !isInPlane(g, to)) continue;
            edge.others.push_back(g);
            edge.changes = edge.changes || is_partly(g);
        }
        return edge;
    }

    /// Shares of an edge: its ends and the corners of other faces on it, where its neighbour changes.
    std::vector<double> stopsOf(const Edge& edge) const {
        const Vec3 along = edge.to - edge.from;
        const double thin = 1e-7 * finder_.size() / edge.length();
        std::vector<double> shares{0};
        for (const std::size_t g : edge.others) {
            for (const std::int32_t v : shape_.faces[g]) {
                const Vec3& corner = shape_.vertices[static_cast<std::size_t>(v)];
                const double share = (corner - edge.from).dot(along) / along.squaredNorm();
                if (share < thin || 1 - share < thin) continue;
                if ((corner - edge.at(share)).norm() < thin * edge.length()) shares.push_back(share);
            }
        }
        std::sort(shares.begin(), shares.end());
        shares.erase(
            std::unique(shares.begin(), shares.end(), [&](double a, double b) { return b - a <= thin; }),
            shares.end());
        shares.push_back(1);
        return shares;
    }

    void addSides(const Edge& edge, double begin, double end, const Camera& camera,
                  PaintedPolygon& polygon) const {
        const auto add = [&](double share, Side side) {
            polygon.corners.push_back(camera.seen(edge.at(share)));
            polygon.sides.push_back(side);
        };
        const double look = kBeside * (end - begin) * edge.length();
        if (!edge.changes) return add(begin, side(edge, 0.5 * (begin + end), look).value_or(Side::rim));
        // The surface beyond may lie under other parts by less than this distance: then the edge is no rim.
        const auto at = [&](double share) { return side(edge, share, look).value_or(Side::none); };
        const auto place = [&](int k) { return begin + (k + 0.5) / kAlong * (end - begin); };
        Side last = at(place(0));
        add(begin, last);
        for (int k = 1; k < kAlong; ++k) {
            const Side next = at(place(k));
            if (next != last) add(changeBetween(at, place(k - 1), place(k), last), next);
            last = next;
        }
    }

    /// The share between two of them at which `at` is no longer `first`.
    template <typename At>
    static double changeBetween(const At& at, double from, double to, Side first) {
        for (int k = 0; k < kBisections; ++k) {
            const double middle = 0.5 * (from + to);
            (at(middle) == first ? from : to) = middle;
        }
        return to;
    }

    /// Kind of an edge at a share of it. A neighbour narrower than the first distance is found at a smaller
    /// one.
    std::optional<Side> side(const Edge& edge, double share, double look) const {
        for (const double step : {look, 0.05 * look})
            if (const auto found = sideAt(edge, share, step)) return found;
        return std::nullopt;
    }

    bool isInPlane(std::size_t g, const Vec3& point) const {
        return std::abs(normals_[g].dot(point - corner(g))) <= 1e-6 * finder_.size();
    }

    /// Nothing: no face of the block continues so far beside the edge.
    std::optional<Side> sideAt(const Edge& edge, double share, double step) const {
        const Vec3& own = normals_[edge.face];
        const Vec3 middle = edge.at(share), out = (edge.to - edge.from).cross(own).normalized();
        const double off = 1e-5 * finder_.size();
        // Where other parts of the body cover the face nothing is to be seen of its edge.
        if (edge.changes && finder_.isInside(middle - step * out + off * own, block_)) return Side::none;
        std::optional<Side> found;
        bool is_joint = false;
        for (const std::size_t g : edge.others) {
            const Vec3& normal = normals_[g];
            const bool flat = (normal - own).norm() < kFlat;
            // Into the neighbour, in its own plane: down behind a ridge, up beyond a valley.
            const Vec3 down = (-own + own.dot(normal) * normal).normalized();
            for (const Vec3& into : flat ? std::array{out, out} : std::array{down, Vec3(-down)}) {
                const Vec3 beside = middle + step * into, above = beside + off * normal;
                // Of a face that other parts of the body cover in part only what is free is surface.
                if (!isInOutline(shape_, g, normal, beside) || finder_.isInside(above, block_)) continue;
                if (flat) return Side::none;
                is_joint = is_joint || finder_.isInside(above);
                found = normal.dot(own) > kCrease ? Side::crease : found.value_or(Side::rim);
            }
        }
        return is_joint ? Side::joint : found;
    }

    const Vec3& corner(std::size_t g) const {
        return shape_.vertices[static_cast<std::size_t>(shape_.faces[g].front())];
    }

    const BlockFinder& finder_;
    const Polyhedron& shape_;
    std::size_t block_;
    std::vector<Vec3> normals_;
};

}  // namespace

Camera::Camera(const View& view)
    : right(-std::cos(view.azimuth), std::sin(view.azimuth), 0),
      towards(std::sin(view.azimuth) * std::cos(view.elevation),
              std::cos(view.azimuth) * std::cos(view.elevation), std::sin(view.elevation)) {
    up = towards.cross(right);
    const double c = std::cos(view.tilt), s = std::sin(view.tilt);
    for (Vec3* axis : {&right, &up, &towards})
        *axis = Vec3(c * axis->x() + s * axis->z(), axis->y(), c * axis->z() - s * axis->x());
    level = Vec3(s, 0, c);
}

VisibleFaces visibleFaces(const Model& model, const Camera& camera) {
    const BlockFinder finder(model);
    VisibleFaces visible;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Polyhedron& shape = model.blocks[b].shape;
        const EdgeTeller edges(finder, shape, b);
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
            if (shape.isInner(f)) continue;
            const Vec3 normal = shape.faceNormal(f), centroid = shape.faceCentroid(f);
            if (normal.dot(camera.towards) <= 1e-9 || isCovered(finder, shape, f, normal, centroid)) continue;
            visible.polygons.push_back(edges.polygon(f, camera));
            visible.polygons.back().source = visible.faces.size();
            visible.faces.push_back({b, f, normal});
        }
    }
    return visible;
}

}  // namespace talus::tools
