// Convex hull by insertion of the farthest point.
//
// Points are rounded to a lattice of 2^-40 of their extent, where a point's side of a facet is an exact
// integer. So the surface is always closed and convex there, and every point sees the right facets. Hulls
// with floating-point predicates usually fail there. The result uses the points as they were given.
//
// Points are sorted first, so the result does not depend on their order. Vertices are in lexicographic order,
// each face starts at its lowest vertex, and faces are sorted by their vertices.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "geometry/merge_facets.h"
#include "talus/polyhedron.h"

namespace talus {
namespace {

__extension__ using Int128 = __int128;
using LatticePoint = std::array<std::int64_t, 3>;

// Products of three differences below 2^41 and their sums stay below 2^126, inside Int128.
constexpr double kLatticeCells = 1099511627776.0;  // 2^40
// A point this close to the hull of the others is dropped (share of the extent).
constexpr double kResolution = 1e-9;
// Facets this close to one plane are one face: coordinates written with seven digits still give flat faces.
constexpr double kFlatness = 1e-6;

struct Facet {
    Triangle corner{};
    std::array<Int128, 3> normal{};
    double norm = 0;
    bool alive = true;
};

/// A point outside the hull so far: how far, in lattice cells, and above which facet.
struct Conflict {
    double height = 0;
    std::size_t facet = 0;
};

LatticePoint minus(const LatticePoint& a, const LatticePoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

std::array<Int128, 3> cross(const LatticePoint& a, const LatticePoint& b) {
    const auto minor = [&](int i, int j) { return Int128(a[i]) * b[j] - Int128(a[j]) * b[i]; };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

double norm(const std::array<Int128, 3>& v) {
    return std::hypot(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
}

/// The growing hull of lattice points.
class TriangleHull {
 public:
    TriangleHull(const std::vector<LatticePoint>& points, const std::array<std::int32_t, 4>& simplex);

    /// Adds points, the farthest first, until none lies more than `tolerance` cells outside.
    void grow(double tolerance);
    std::vector<Triangle> triangles() const;

 private:
    void addFacet(std::int32_t a, std::int32_t b, std::int32_t c);
    void insert(std::int32_t point);
    double height(const Facet& facet, std::int32_t point) const;
    void raise(std::int32_t point, std::size_t first_facet);

    const std::vector<LatticePoint>& points_;
    std::vector<Facet> facets_;
    std::vector<Conflict> conflicts_;
};

TriangleHull::TriangleHull(const std::vector<LatticePoint>& points,
                           const std::array<std::int32_t, 4>& simplex)
    : points_(points), conflicts_(points.size()) {
    auto [a, b, c, d] = simplex;
    addFacet(a, b, c);
    if (height(facets_[0], d) > 0) std::swap(b, c);
    facets_.clear();
    addFacet(a, b, c);
    addFacet(a, c, d);
    addFacet(c, b, d);
    addFacet(b, a, d);
    for (std::size_t p = 0; p < points_.size(); ++p) raise(static_cast<std::int32_t>(p), 0);
}

void TriangleHull::addFacet(std::int32_t a, std::int32_t b, std::int32_t c) {
    Facet facet{{a, b, c}, cross(minus(points_[b], points_[a]), minus(points_[c], points_[a]))};
    facet.norm = norm(facet.normal);
    facets_.push_back(facet);
}

/// Height above a facet in cells. Its sign is exact: the integer is, and rounding to double keeps it.
double TriangleHull::height(const Facet& facet, std::int32_t point) const {
    const LatticePoint d = minus(points_[point], points_[facet.corner[0]]);
    return static_cast<double>(facet.normal[0] * d[0] + facet.normal[1] * d[1] + facet.normal[2] * d[2]) /
           facet.norm;
}

/// Takes the facets from `first_facet` on into account for a point's conflict.
void TriangleHull::raise(std::int32_t point, std::size_t first_facet) {
    for (std::size_t f = first_facet; f < facets_.size(); ++f) {
        if (!facets_[f].alive) continue;
        const double h = height(facets_[f], point);
        if (h > conflicts_[point].height) conflicts_[point] = {h, f};
    }
}

/// Replaces the facets a point can see by a cone from their rim to the point. A facet in whose plane the
/// point lies is not seen, hence no new facet is degenerate: a point in line with a rim edge lies in the
/// plane of the seen facet.
void TriangleHull::insert(std::int32_t point) {
    std::set<std::pair<std::int32_t, std::int32_t>> rim;
    const std::size_t first_new = facets_.size();
    for (Facet& facet : facets_) {
        if (!facet.alive || height(facet, point) <= 0) continue;
        facet.alive = false;
        for (int i = 0; i < 3; ++i) {
            const auto a = facet.corner[i], b = facet.corner[(i + 1) % 3];
            if (rim.erase({b, a}) == 0) rim.insert({a, b});
        }
    }
    for (const auto& [a, b] : rim) addFacet(a, b, point);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        Conflict& conflict = conflicts_[p];
        if (conflict.height <= 0) continue;
        const bool lost = !facets_[conflict.facet].alive;
        if (lost) conflict = {};
        raise(static_cast<std::int32_t>(p), lost ? 0 : first_new);
    }
}

void TriangleHull::grow(double tolerance) {
    const auto lower = [](const Conflict& a, const Conflict& b) { return a.height < b.height; };
    for (;;) {
        const auto farthest = std::max_element(conflicts_.begin(), conflicts_.end(), lower);
        if (farthest->height <= tolerance) return;
        insert(static_cast<std::int32_t>(farthest - conflicts_.begin()));
    }
}

std::vector<Triangle> TriangleHull::triangles() const {
    std::vector<Triangle> alive;
    for (const Facet& facet : facets_)
        if (facet.alive) alive.push_back(facet.corner);
    return alive;
}

template <class Measure>
std::int32_t farthestBy(const std::vector<LatticePoint>& points, Measure measure) {
    std::int32_t best = 0;
    double most = -1;
    for (std::size_t p = 0; p < points.size(); ++p)
        if (const double m = measure(points[p]); m > most) most = m, best = static_cast<std::int32_t>(p);
    return best;
}

/// Four points that span a volume, each the farthest from the ones before; an error if they lie within
/// `least_thickness` cells of a line or plane.
Result<std::array<std::int32_t, 4>> firstSimplex(const std::vector<LatticePoint>& points,
                                                 double least_thickness) {
    const LatticePoint& a = points[0];
    const auto distance = [&](const LatticePoint& p) {
        const LatticePoint d = minus(p, a);
        return std::hypot(double(d[0]), double(d[1]), double(d[2]));
    };
    const auto b = farthestBy(points, distance);
    const LatticePoint along = minus(points[b], a);
    const auto off_line = [&](const LatticePoint& p) {
        return norm(cross(along, minus(p, a))) / distance(points[b]);
    };
    const auto c = farthestBy(points, off_line);
    if (!(off_line(points[c]) > least_thickness))
        return Error{"vertices", "the points lie on one line; four that span a volume are needed"};
    const auto normal = cross(along, minus(points[c], a));
    const auto off_plane = [&](const LatticePoint& p) {
        const LatticePoint d = minus(p, a);
        return std::abs(double(normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2])) / norm(normal);
    };
    const auto d = farthestBy(points, off_plane);
    if (!(off_plane(points[d]) > least_thickness))
        return Error{"vertices", "the points lie in one plane; four that span a volume are needed"};
    return std::array<std::int32_t, 4>{0, b, c, d};
}

std::vector<Vec3> sortedDistinct(std::vector<Vec3> points) {
    for (Vec3& p : points) p.array() += 0.0;  // -0 and 0 are one number
    const auto less = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

struct Extent {
    Vec3 min;
    double size;  ///< the longest side [m]
};

Extent extentOf(const std::vector<Vec3>& points) {
    Vec3 min = points[0], max = points[0];
    for (const Vec3& p : points) min = min.cwiseMin(p), max = max.cwiseMax(p);
    return {min, (max - min).maxCoeff()};
}

std::vector<LatticePoint> onLattice(const std::vector<Vec3>& points, const Extent& extent) {
    std::vector<LatticePoint> lattice(points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
        for (int axis = 0; axis < 3; ++axis)
            lattice[p][axis] =
                std::llround((points[p][axis] - extent.min[axis]) / extent.size * kLatticeCells);
    return lattice;
}

/// Keeps the points that faces use, and puts faces into canonical order.
Polyhedron assemble(const std::vector<Vec3>& points, std::vector<Outline> faces) {
    std::set<std::int32_t> used;
    for (const Outline& face : faces) used.insert(face.begin(), face.end());
    Polyhedron shape;
    std::vector<std::int32_t> vertex_of(points.size(), -1);
    for (const auto p : used) {
        vertex_of[p] = static_cast<std::int32_t>(shape.vertices.size());
        shape.vertices.push_back(points[p]);
    }
    for (Outline& face : faces) {
        for (auto& p : face) p = vertex_of[p];
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    }
    std::sort(faces.begin(), faces.end());
    shape.faces = std::move(faces);
    return shape;
}

std::vector<Error> checkPoints(const std::vector<Vec3>& points) {
    std::vector<Error> errors;
    for (std::size_t p = 0; p < points.size(); ++p)
        if (!points[p].allFinite())
            errors.push_back({"vertices[" + std::to_string(p) + "]", "coordinates must be finite"});
    if (points.size() < 4)
        errors.push_back({"vertices", std::to_string(points.size()) + " points; at least four are needed"});
    return errors;
}

}  // namespace

Result<Polyhedron> convexHull(const std::vector<Vec3>& input) {
    if (auto errors = checkPoints(input); !errors.empty()) return errors;
    const std::vector<Vec3> points = sortedDistinct(input);
    const Extent extent = extentOf(points);
    if (points.size() < 4)
        return Error{"vertices",
                     std::to_string(points.size()) + " different points; at least four are needed"};
    if (!std::isfinite(extent.size))
        return Error{"vertices", "coordinates differ by more than a number can hold"};

    // Coordinates far from the origin are known to a few ulp only; anything thinner is not a shape.
    const double magnitude = extent.min.cwiseAbs().maxCoeff() + extent.size;
    const double noise = 8 * std::numeric_limits<double>::epsilon() * magnitude / extent.size;
    const double flatness = std::max(kFlatness, 2 * noise);
    const std::vector<LatticePoint> lattice = onLattice(points, extent);
    // Twice the flatness, so that the two sides of a plate are never taken for one face.
    const auto simplex = firstSimplex(lattice, 2 * flatness * kLatticeCells);
    if (!simplex) return simplex.errors();
    TriangleHull hull(lattice, *simplex);
    hull.grow(std::max(kResolution, noise) * kLatticeCells);

    // Lattice points again, as slivers have a meaningful normal only there.
    std::vector<Vec3> local;
    for (const auto& [x, y, z] : lattice)
        local.push_back(Vec3(double(x), double(y), double(z)) / kLatticeCells);
    return assemble(points, mergeFacets(local, hull.triangles(), flatness));
}

}  // namespace talus
