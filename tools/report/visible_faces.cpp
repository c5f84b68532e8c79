#include "report/visible_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace talus::tools {

namespace {

constexpr double kInset = 0.002;  // of the way to the middle: points of a face that are looked at
constexpr double kFlat = 1e-4;    // of a normal: faces that differ by less lie in one plane
constexpr double kCrease = 0.9;   // cosine: edges that turn less are no rims
constexpr int kGrid = 8;          // points a side of a face that its own body covers in part
constexpr double kBeside = 0.02;  // of an edge: how far beside it what lies there is looked at

struct Bounds {
    Vec3 min = Vec3::Constant(kInfinity), max = Vec3::Constant(-kInfinity);

    void add(const Vec3& point) {
        min = min.cwiseMin(point);
        max = max.cwiseMax(point);
    }
};

/// Looks up the block at a point, by a grid over the blocks' bounds.
class BlockFinder {
 public:
    explicit BlockFinder(const Model& model) : model_(model) {
        for (const Block& block : model.blocks) {
            bounds_.emplace_back();
            for (const Vec3& v : block.shape.vertices) bounds_.back().add(v);
            all_.add(bounds_.back().min);
            all_.add(bounds_.back().max);
        }
        const double volume = (all_.max - all_.min).prod();
        cell_ = std::cbrt(volume / static_cast<double>(model.blocks.size()));
        for (std::size_t b = 0; b < bounds_.size(); ++b) {
            const auto low = cellOf(bounds_[b].min), high = cellOf(bounds_[b].max);
            for (auto x = low[0]; x <= high[0]; ++x)
                for (auto y = low[1]; y <= high[1]; ++y)
                    for (auto z = low[2]; z <= high[2]; ++z) blocks_[key(x, y, z)].push_back(b);
        }
    }

    double size() const { return (all_.max - all_.min).norm(); }

    bool isInside(const Vec3& point) const {
        const auto [x, y, z] = cellOf(point);
        const auto found = blocks_.find(key(x, y, z));
        if (found == blocks_.end()) return false;
        return std::any_of(found->second.begin(), found->second.end(),
                           [&](std::size_t b) { return contains(b, point); });
    }

 private:
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

    bool contains(std::size_t b, const Vec3& point) const {
        if ((point.array() < bounds_[b].min.array()).any() || (point.array() > bounds_[b].max.array()).any())
            return false;
        return talus::contains(model_.blocks[b].shape, point);
    }

    const Model& model_;
    std::vector<Bounds> bounds_;
    Bounds all_;
    double cell_ = 1;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> blocks_;
};

/// Whether other blocks lie against the whole face, as far as its middle, its corners and points of its sides tell. What is
/// hidden without being found here is painted over.
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
    // What other parts of the body cover in part may be free anywhere.
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

/// What the edges of one block's faces are.
class EdgeTeller {
 public:
    EdgeTeller(const BlockFinder& finder, const Polyhedron& shape) : finder_(finder), shape_(shape) {
        for (std::size_t f = 0; f < shape.faces.size(); ++f) normals_.push_back(shape.faceNormal(f));
    }

    /// A neighbour narrower than the first look is found by a nearer one.
    Side side(std::size_t f, const Vec3& a, const Vec3& b) const {
        const double length = (b - a).norm();
        for (const double step : {kBeside * length, 0.05 * kBeside * length})
            if (const auto found = sideAt(f, a, b, step)) return *found;
        return Side::rim;
    }

    /// An edge's ends and, between them, corners of the block's other faces that lie on it: there what is beside it changes.
    std::vector<Vec3> stops(std::size_t f, const Vec3& a, const Vec3& b) const {
        const Vec3 along = b - a;
        const double thin = 1e-7 * finder_.size();
        std::vector<double> shares{0, 1};
        for (std::size_t g = 0; g < normals_.size(); ++g) {
            if (g == f || shape_.isInner(g)) continue;
            for (const std::int32_t v : shape_.faces[g]) {
                const Vec3& corner = shape_.vertices[static_cast<std::size_t>(v)];
                const double share = (corner - a).dot(along) / along.squaredNorm();
                if (share * along.norm() < thin || (1 - share) * along.norm() < thin) continue;
                if ((corner - a - share * along).norm() < thin) shares.push_back(share);
            }
        }
        std::sort(shares.begin(), shares.end());
        std::vector<Vec3> points;
        for (std::size_t k = 0; k < shares.size(); ++k)
            if (k == 0 || (shares[k] - shares[k - 1]) * along.norm() > thin)
                points.push_back(a + shares[k] * along);
        return points;
    }

 private:
    /// Nothing: no face of the block goes on so far beside the edge.
    std::optional<Side> sideAt(std::size_t f, const Vec3& a, const Vec3& b, double step) const {
        const Vec3 middle = 0.5 * (a + b), out = (b - a).cross(normals_[f]).normalized();
        std::optional<Side> found;
        bool is_joint = false;
        for (std::size_t g = 0; g < normals_.size(); ++g) {
            if (g == f || shape_.isInner(g)) continue;
            const Vec3& normal = normals_[g];
            if (std::abs(normal.dot(middle - corner(g))) > 1e-6 * finder_.size()) continue;
            const bool flat = (normal - normals_[f]).norm() < kFlat;
            // Into the neighbour, in its own plane: down behind a ridge, up beyond a valley.
            const Vec3 down = (-normals_[f] + normals_[f].dot(normal) * normal).normalized();
            for (const Vec3& into : flat ? std::array{out, out} : std::array{down, Vec3(-down)}) {
                const Vec3 beside = middle + step * into, above = beside + 1e-5 * finder_.size() * normal;
                // Of a face that other parts of the body cover in part only what is free is surface.
                if (!isInOutline(shape_, g, normal, beside) || contains(shape_, above)) continue;
                if (flat) return Side::none;
                is_joint = is_joint || finder_.isInside(above);
                found = normal.dot(normals_[f]) > kCrease ? Side::crease : found.value_or(Side::rim);
            }
        }
        return is_joint ? Side::joint : found;
    }

    const Vec3& corner(std::size_t g) const {
        return shape_.vertices[static_cast<std::size_t>(shape_.faces[g].front())];
    }

    const BlockFinder& finder_;
    const Polyhedron& shape_;
    std::vector<Vec3> normals_;
};

PaintedPolygon polygonOf(const Polyhedron& shape, std::size_t f, const EdgeTeller& edges,
                         const Camera& camera) {
    PaintedPolygon polygon;
    const auto& outline = shape.faces[f];
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3& a = shape.vertices[static_cast<std::size_t>(outline[k])];
        const Vec3& b = shape.vertices[static_cast<std::size_t>(outline[(k + 1) % outline.size()])];
        const std::vector<Vec3> stops = edges.stops(f, a, b);
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
            polygon.corners.push_back(camera.seen(stops[i]));
            polygon.sides.push_back(edges.side(f, stops[i], stops[i + 1]));
        }
    }
    return polygon;
}

}  // namespace

Camera::Camera(const View& view)
    : right(-std::cos(view.azimuth), std::sin(view.azimuth), 0),
      towards(std::sin(view.azimuth) * std::cos(view.elevation),
              std::cos(view.azimuth) * std::cos(view.elevation), std::sin(view.elevation)) {
    up = towards.cross(right);
}

VisibleFaces visibleFaces(const Model& model, const Camera& camera) {
    const BlockFinder finder(model);
    VisibleFaces visible;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Polyhedron& shape = model.blocks[b].shape;
        const EdgeTeller edges(finder, shape);
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
            if (shape.isInner(f)) continue;
            const Vec3 normal = shape.faceNormal(f), centroid = shape.faceCentroid(f);
            if (normal.dot(camera.towards) <= 1e-9 || isCovered(finder, shape, f, normal, centroid)) continue;
            visible.polygons.push_back(polygonOf(shape, f, edges, camera));
            visible.polygons.back().source = visible.faces.size();
            visible.faces.push_back({b, f, normal});
        }
    }
    return visible;
}

}  // namespace talus::tools
