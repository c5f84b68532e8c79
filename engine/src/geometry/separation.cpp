#include "geometry/separation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// Sine below which two edges count as parallel: their cross product would be rounding. Any unit vector is a
// valid axis, so a poor one cannot hide an overlap; it only finds nothing new.
constexpr double kParallelSine = 1e-8;

bool isParallel(const Vec3& a, const Vec3& b) {
    return a.cross(b).squaredNorm() < kParallelSine * kParallelSine;
}

/// Directions of the edges, one of each set of parallel ones.
std::vector<Vec3> edgeDirections(const WorldShape& shape) {
    std::vector<Vec3> directions;
    for (const auto& outline : shape.faces)
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const auto from = outline[i], to = outline[(i + 1) % outline.size()];
            if (from > to) continue;  // the other face's turn
            const Vec3 direction = (shape.vertices[to] - shape.vertices[from]).normalized();
            const auto known = [&](const Vec3& d) { return isParallel(d, direction); };
            if (std::none_of(directions.begin(), directions.end(), known)) directions.push_back(direction);
        }
    return directions;
}

/// Largest and least extent of a shape along an axis, from `origin` [m].
struct Shadow {
    double min = std::numeric_limits<double>::infinity(), max = -min;
};

Shadow shadow(const WorldShape& shape, const Vec3& origin, const Vec3& axis) {
    Shadow sum;
    for (const Vec3& vertex : shape.vertices) {
        const double along = axis.dot(vertex - origin);
        sum.min = std::min(sum.min, along);
        sum.max = std::max(sum.max, along);
    }
    return sum;
}

/// Separation along an axis, which is turned to point from a to b.
Separation alongAxis(const WorldShape& a, const WorldShape& b, const Vec3& axis) {
    const Vec3& origin = a.vertices[0];
    const Shadow of_a = shadow(a, origin, axis), of_b = shadow(b, origin, axis);
    const double ahead = of_b.min - of_a.max, behind = of_a.min - of_b.max;
    return ahead >= behind ? Separation{ahead, axis} : Separation{behind, -axis};
}

/// The best separation so far; `tryAxis` tells whether it is enough.
struct Search {
    const WorldShape &a, &b;
    double enough;
    Separation best{-std::numeric_limits<double>::infinity(), Vec3::Zero()};

    bool tryAxis(const Vec3& axis) {
        const Separation found = alongAxis(a, b, axis);
        if (found.distance > best.distance) best = found;
        return best.distance >= enough;
    }
};

bool tryFaces(Search& search, const WorldShape& shape) {
    for (const Vec3& normal : shape.normals)
        if (search.tryAxis(normal)) return true;
    return false;
}

void tryEdges(Search& search) {
    const auto edges_b = edgeDirections(search.b);
    for (const Vec3& edge_a : edgeDirections(search.a))
        for (const Vec3& edge_b : edges_b)
            if (!isParallel(edge_a, edge_b) && search.tryAxis(edge_a.cross(edge_b).normalized())) return;
}

std::vector<Vec3> faceNormals(const Polyhedron& shape) {
    std::vector<Vec3> normals;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) normals.push_back(shape.faceNormal(face));
    return normals;
}

}  // namespace

Separation findSeparation(const WorldShape& a, const WorldShape& b, double enough) {
    Search search{a, b, enough};
    if (!tryFaces(search, a) && !tryFaces(search, b)) tryEdges(search);
    return search.best;
}

Separation findSeparation(const Polyhedron& a, const Polyhedron& b, double enough) {
    const std::vector<Vec3> normals_a = faceNormals(a), normals_b = faceNormals(b);
    return findSeparation(WorldShape{a.vertices, a.faces, normals_a},
                          WorldShape{b.vertices, b.faces, normals_b}, enough);
}

}  // namespace talus
