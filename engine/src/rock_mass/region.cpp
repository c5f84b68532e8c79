#include "rock_mass/region.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "geometry/box_tree.h"

namespace talus::rock_mass {

namespace {

constexpr std::size_t kCandidates = 24;      // cutting planes compared for one cell
constexpr std::size_t kMostCells = 200'000;  // of a region: one for each reflex edge and more
constexpr double kRounding = 1e-12;          // of the region, of a clipped corner's height; see reachesInto
constexpr double kSameVolume = 1e-6;  // of a region against its surface, beyond what its flatness allows

/// A triangle of the surface and its place among the planes.
struct Facet {
    std::array<Vec3, 3> corner;
    std::int32_t plane = 0;
};

using EdgeOwners = std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>;

class Decomposer {
 public:
    Decomposer(const TriangleSurface& surface, std::vector<Plane>& planes, VertexTable& vertices,
               const std::atomic<bool>* stop)
        : surface_(surface), planes_(planes), vertices_(vertices), stop_(stop) {
        min_ = max_ = surface.vertices[0];
        for (const Vec3& v : surface.vertices) min_ = min_.cwiseMin(v), max_ = max_.cwiseMax(v);
        extent_ = (max_ - min_).maxCoeff();
    }

    Result<std::vector<Cell>> run() {
        Cell root = boxCell(min_, max_, planes_, vertices_);
        findPlanes();
        std::vector<Box> boxes(facets_.size());
        for (std::size_t t = 0; t < facets_.size(); ++t)
            for (const Vec3& corner : facets_[t].corner) boxes[t].add(corner);
        const BoxTree tree(boxes);
        tree_ = &tree;
        if (stopped()) return interrupted();
        depth_ = std::max(16 * vertices_.weld(), 4 * deviation_);
        std::vector<std::size_t> reflex;
        if (!cutByHull(root, reflex)) return crossing();
        if (!cutByFacets(std::move(root), reflex)) return tooMany();
        if (stopped()) return interrupted();
        double sum = 0;
        for (const Cell& cell : cells_) sum += volume(cell, vertices_);
        const double expected = surfaceVolume(surface_);
        const double slack = kSameVolume * expected + 8 * deviation_ * extent_ * extent_;
        if (cells_.empty() || std::abs(sum - expected) > slack) return crossing();
        return std::move(cells_);
    }

 private:
    static Error crossing() {
        return {"",
                "found a surface that crosses itself (its parts do not add up to its volume), allowed: a "
                "surface that separates inside from outside"};
    }
    bool stopped() const { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }
    static Error interrupted() { return {"", "interrupted"}; }
    static Error tooMany() {
        return {"", "found a surface with so many reflex edges that it is divided into more than " +
                        std::to_string(kMostCells) + " convex parts, allowed: a coarser surface"};
    }

    Facet facetOf(std::size_t t) const {
        Facet facet;
        for (std::size_t i = 0; i < 3; ++i)
            facet.corner[i] = surface_.vertices[static_cast<std::size_t>(surface_.triangles[t][i])];
        return facet;
    }

    /// One plane for all neighbouring triangles that lie in it within the flatness.
    void findPlanes() {
        EdgeOwners owner;
        for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
            facets_.push_back(facetOf(t));
            facets_.back().plane = -1;
            for (std::size_t i = 0; i < 3; ++i)
                owner[{surface_.triangles[t][i], surface_.triangles[t][(i + 1) % 3]}] = t;
        }
        // The largest triangles first: their normals are the most accurate.
        std::vector<std::size_t> order(facets_.size());
        std::vector<double> size(facets_.size());
        for (std::size_t t = 0; t < order.size(); ++t) order[t] = t, size[t] = areaVector(t).norm();
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] > size[b]; });
        for (const std::size_t seed : order)
            if (facets_[seed].plane < 0 && !stopped()) growFace(seed, owner);
    }

    Vec3 areaVector(std::size_t t) const {
        const auto& c = facets_[t].corner;
        return (c[1] - c[0]).cross(c[2] - c[0]);
    }

    void growFace(std::size_t seed, const EdgeOwners& owner) {
        const std::int32_t plane = planeOf(seed);
        std::vector<std::size_t> todo{seed};
        facets_[seed].plane = plane;
        while (!todo.empty()) {
            const std::size_t t = todo.back();
            todo.pop_back();
            for (std::size_t i = 0; i < 3; ++i) {
                const auto& corner = surface_.triangles[t];
                const std::size_t other = owner.at({corner[(i + 1) % 3], corner[i]});
                if (facets_[other].plane >= 0 || !liesIn(plane, other)) continue;
                facets_[other].plane = plane;
                todo.push_back(other);
            }
        }
    }

    /// The plane of a triangle; that of the box where the triangle lies in it.
    std::int32_t planeOf(std::size_t t) {
        for (std::int32_t p = 0; p < 6; ++p)
            if (liesIn(p, t)) return p;
        Vec3 normal = areaVector(t).normalized();
        for (double& component : normal)
            if (std::abs(component) < 1e-15) component = 0;
        planes_.push_back({normal, normal.dot(facets_[t].corner[0]), kSurface, 0});
        return static_cast<std::int32_t>(planes_.size()) - 1;
    }

    bool liesIn(std::int32_t index, std::size_t t) {
        const Plane& plane = planes_[static_cast<std::size_t>(index)];
        if (plane.normal.dot(areaVector(t)) <= 0) return false;
        double off = 0;
        for (const Vec3& corner : facets_[t].corner) off = std::max(off, std::abs(plane.height(corner)));
        if (off > kFlatness * extent_) return false;
        deviation_ = std::max(deviation_, off > vertices_.weld() ? off : 0);
        return true;
    }

    /// Cuts the box by the planes of the hull; `reflex` gets the triangles in other planes.
    bool cutByHull(Cell& root, std::vector<std::size_t>& reflex) {
        std::vector<std::int8_t> is_hull(planes_.size(), -1);
        for (std::size_t t = 0; t < facets_.size() && !stopped(); ++t) {
            const auto p = static_cast<std::size_t>(facets_[t].plane);
            if (is_hull[p] < 0) {
                const double allowed = std::max(4 * vertices_.weld(), 2 * deviation_);
                is_hull[p] = std::all_of(surface_.vertices.begin(), surface_.vertices.end(),
                                         [&](const Vec3& v) { return planes_[p].height(v) <= allowed; });
                if (is_hull[p] == 1) {
                    Split parts = split(root, planes_, facets_[t].plane, vertices_);
                    if (parts.kind == Split::Kind::above) return false;
                    if (parts.kind == Split::Kind::cut) root = std::move(parts.lower);
                }
            }
            if (is_hull[p] == 0) reflex.push_back(t);
        }
        return true;
    }

    bool cutByFacets(Cell root, std::vector<std::size_t> reflex) {
        struct Task {
            Cell cell;
            std::vector<std::size_t> facets;
        };
        std::vector<Task> todo;
        todo.push_back({std::move(root), std::move(reflex)});
        while (!todo.empty() && !stopped()) {
            if (todo.size() + cells_.size() > kMostCells) return false;
            Task task = std::move(todo.back());
            todo.pop_back();
            std::erase_if(task.facets, [&](std::size_t t) { return !reachesInto(task.cell, facets_[t]); });
            if (task.facets.empty()) {
                if (isInside(centre(task.cell, vertices_))) cells_.push_back(std::move(task.cell));
                continue;
            }
            const std::size_t best = bestFacet(task.facets);
            Split parts = split(task.cell, planes_, facets_[best].plane, vertices_);
            if (parts.kind != Split::Kind::cut) {  // it lies in a face after all
                const std::int32_t plane = facets_[best].plane;
                std::erase_if(task.facets, [&](std::size_t t) { return facets_[t].plane == plane; });
                todo.push_back(std::move(task));
                continue;
            }
            todo.push_back({std::move(parts.upper), task.facets});
            todo.push_back({std::move(parts.lower), std::move(task.facets)});
        }
        return true;
    }

    /// How far a point lies outside the cell's face, or less than `depth_` inside it [m].
    double outside(const CellFace& face, const Vec3& point) const {
        const double sign = face.outward ? 1 : -1;
        return sign * planes_[static_cast<std::size_t>(face.plane)].height(point) + depth_;
    }

    /// Whether a triangle has a part inside the cell, deeper than flat faces may be uneven. Most triangles
    /// are told by their corners: all are clearly outside one face, or one is inside all faces. The last face
    /// is tried first: the last cut made it, and only it can lie before a triangle that reached into the cell
    /// before that cut.
    bool reachesInto(const Cell& cell, const Facet& facet) {
        const double clearly = kRounding * extent_;
        std::array<bool, 3> is_in{true, true, true};
        for (std::size_t f = cell.faces.size(); f-- > 0;) {
            const CellFace& face = cell.faces[f];
            std::array<double, 3> heights;
            for (std::size_t i = 0; i < 3; ++i) {
                heights[i] = outside(face, facet.corner[i]);
                is_in[i] = is_in[i] && heights[i] < 0;
            }
            if (std::min({heights[0], heights[1], heights[2]}) > clearly) return false;
        }
        return is_in[0] || is_in[1] || is_in[2] || isLeftByClipping(cell, facet);
    }

    /// Whether clipping the triangle by all faces of the cell leaves a part of it.
    bool isLeftByClipping(const Cell& cell, const Facet& facet) {
        part_.assign(facet.corner.begin(), facet.corner.end());
        for (const CellFace& face : cell.faces) {
            clipped_.clear();
            for (std::size_t i = 0; i < part_.size(); ++i) {
                const Vec3 &a = part_[i], &b = part_[(i + 1) % part_.size()];
                const double h_a = outside(face, a), h_b = outside(face, b);
                if (h_a < 0) clipped_.push_back(a);
                if ((h_a < 0) != (h_b < 0)) clipped_.push_back(a + h_a / (h_a - h_b) * (b - a));
            }
            part_.swap(clipped_);
            if (part_.size() < 3) return false;
        }
        return true;
    }

    /// The triangle whose plane cuts the fewest others; of these the largest.
    std::size_t bestFacet(const std::vector<std::size_t>& facets) const {
        std::size_t best = facets[0], fewest = facets.size() + 1;
        double largest = 0;
        const std::size_t step = 1 + facets.size() / kCandidates;
        for (std::size_t k = 0; k < facets.size(); k += step) {
            const Plane& plane = planes_[static_cast<std::size_t>(facets_[facets[k]].plane)];
            const std::size_t cuts = countCuts(plane, facets, fewest);
            const double size = areaVector(facets[k]).norm();
            if (cuts > fewest || (cuts == fewest && size <= largest)) continue;
            best = facets[k], fewest = cuts, largest = size;
        }
        return best;
    }

    /// How many triangles a plane cuts; of more than `most` one more than that.
    std::size_t countCuts(const Plane& plane, const std::vector<std::size_t>& facets,
                          std::size_t most) const {
        std::size_t cuts = 0;
        for (std::size_t k = 0; k < facets.size() && cuts <= most; ++k)
            cuts += isCut(plane, facets[k]) ? 1 : 0;
        return cuts;
    }

    bool isCut(const Plane& plane, std::size_t t) const {
        bool below = false, above = false;
        for (const Vec3& corner : facets_[t].corner) {
            below = below || plane.height(corner) < -depth_;
            above = above || plane.height(corner) > depth_;
        }
        return below && above;
    }

    /// Counts the triangles above a point that no triangle goes through. An edge decides the same way for
    /// both of its triangles, so a ray through an edge or a vertex is counted once.
    bool isInside(const Vec3& point) const {
        bool inside = false;
        const Vec3 up(0, 0, extent_);
        tree_->visit({point - up, point + up}, [&](std::size_t t) {
            const auto& corner = surface_.triangles[t];
            std::array<bool, 3> left;
            for (std::size_t i = 0; i < 3; ++i) left[i] = isLeft(corner[i], corner[(i + 1) % 3], point);
            if (left[0] != left[1] || left[1] != left[2]) return;
            const Vec3 normal = areaVector(t);
            inside ^= normal.dot(facets_[t].corner[0] - point) * normal.z() > 0;
        });
        return inside;
    }

    bool isLeft(std::int32_t a, std::int32_t b, const Vec3& point) const {
        const bool swapped = a > b;
        const Vec3& from = surface_.vertices[static_cast<std::size_t>(swapped ? b : a)];
        const Vec3& to = surface_.vertices[static_cast<std::size_t>(swapped ? a : b)];
        const double turn =
            (to.x() - from.x()) * (point.y() - from.y()) - (to.y() - from.y()) * (point.x() - from.x());
        return (turn >= 0) != swapped;
    }

    const TriangleSurface& surface_;
    std::vector<Plane>& planes_;
    VertexTable& vertices_;
    const std::atomic<bool>* stop_;
    std::vector<Facet> facets_;
    const BoxTree* tree_ = nullptr;  ///< of the facets
    std::vector<Cell> cells_;
    std::vector<Vec3> part_, clipped_;  ///< of isLeftByClipping, kept for their memory
    Vec3 min_, max_;
    double extent_ = 0, deviation_ = 0, depth_ = 0;
};

}  // namespace

Result<std::vector<Cell>> decompose(const TriangleSurface& surface, std::vector<Plane>& planes,
                                    VertexTable& vertices, const std::atomic<bool>* stop) {
    return Decomposer(surface, planes, vertices, stop).run();
}

}  // namespace talus::rock_mass
