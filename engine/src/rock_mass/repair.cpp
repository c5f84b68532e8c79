// Repair of surfaces: duplicate vertices, triangles without a width, T-junctions.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rock_mass/cell.h"
#include "rock_mass/surface_faults.h"

namespace talus {

namespace {

using namespace rock_mass;

constexpr double kCoordinateRounding = 4e-16;  // of the largest coordinate: nothing lies between
constexpr int kMostRepairRounds =
    16;  // an edge is divided at all its corners at once; pieces may meet further ones

class Repair {
 public:
    Repair(const TriangleSurface& surface, double tolerance) : tolerance_(tolerance) {
        result_.surface = surface;
        result_.source.resize(surface.triangles.size());
        std::iota(result_.source.begin(), result_.source.end(), std::size_t{0});
    }

    SurfaceRepair run() {
        mergeVertices();
        if (tolerance_ > 0) {
            dropNarrow();
            for (int round = 0; round < kMostRepairRounds && splitOpenEdges(); ++round) {
            }
        }
        dropUnused();
        return std::move(result_);
    }

 private:
    std::vector<Vec3>& vertices() { return result_.surface.vertices; }
    const Vec3& at(std::int32_t v) const { return result_.surface.vertices[static_cast<std::size_t>(v)]; }

    void note(const Vec3& place) {
        if (!result_.changed()) result_.place = place;
    }

    /// Every vertex becomes an earlier one within the tolerance, if there is one; else within rounding.
    void mergeVertices() {
        double farthest = 0;
        for (const Vec3& v : vertices()) farthest = std::max(farthest, v.cwiseAbs().maxCoeff());
        const double near = std::max(tolerance_, kCoordinateRounding * farthest);
        VertexTable table(near > 0 ? near : 1);
        std::vector<Vec3> kept;
        std::vector<std::int32_t> same(vertices().size());
        for (std::size_t v = 0; v < same.size(); ++v) {
            const Vec3 x = vertices()[v];
            same[v] = table.add(x);
            if (table.size() > kept.size())
                kept.push_back(x);
            else if (table[same[v]] != x)
                note(x), ++result_.merged;
        }
        vertices() = std::move(kept);
        for (auto& triangle : result_.surface.triangles)
            for (std::int32_t& corner : triangle) corner = same[static_cast<std::size_t>(corner)];
    }

    /// Triangles no wider than the tolerance (twice the area over the longest side). The two triangles beside
    /// such a one then meet at its corners, or in a T-junction.
    void dropNarrow() {
        keepIf([&](std::size_t t) {
            const auto& [a, b, c] = result_.surface.triangles[t];
            double longest = 0;
            for (std::size_t i = 0; i < 3; ++i)
                longest = std::max(
                    longest,
                    (cornerOf(result_.surface, t, (i + 1) % 3) - cornerOf(result_.surface, t, i)).norm());
            const bool wide =
                a != b && b != c && c != a && areaVector(result_.surface, t).norm() > tolerance_ * longest;
            if (!wide) note(cornerOf(result_.surface, t, 0)), ++result_.dropped;
            return wide;
        });
    }

    template <class Wanted>
    void keepIf(const Wanted& wanted) {
        auto& triangles = result_.surface.triangles;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (!wanted(t)) continue;
            triangles[kept] = triangles[t];
            result_.source[kept++] = result_.source[t];
        }
        triangles.resize(kept);
        result_.source.resize(kept);
    }

    /// Divides triangles along their open edges. \return whether there was one to divide
    bool splitOpenEdges() {
        const std::vector<OpenEdge> open = openEdges(result_.surface);
        std::vector<std::int32_t> corners;  // of open edges, by x
        for (const OpenEdge& edge : open) corners.push_back(edge.from), corners.push_back(edge.to);
        std::sort(corners.begin(), corners.end(), [&](std::int32_t a, std::int32_t b) {
            return std::pair(at(a).x(), a) < std::pair(at(b).x(), b);
        });
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        bool any = false;
        std::vector<bool> divided(result_.surface.triangles.size());
        for (const OpenEdge& edge : open) {
            if (divided[edge.triangle]) continue;  // its other edges are treated in another round
            const auto between = cornersOn(edge, corners);
            if (between.empty()) continue;
            divided[edge.triangle] = any = true;
            divide(edge, between);
        }
        return any;
    }

    /// Corners of other open edges within the tolerance of this one, along it.
    std::vector<std::int32_t> cornersOn(const OpenEdge& edge,
                                        const std::vector<std::int32_t>& corners) const {
        const Vec3 from = at(edge.from), to = at(edge.to), along = to - from;
        const double low = std::min(from.x(), to.x()) - tolerance_,
                     high = std::max(from.x(), to.x()) + tolerance_;
        std::vector<std::pair<double, std::int32_t>> found;
        auto next = std::lower_bound(corners.begin(), corners.end(), low,
                                     [&](std::int32_t v, double x) { return at(v).x() < x; });
        for (; next != corners.end() && at(*next).x() <= high; ++next) {
            const auto& own = result_.surface.triangles[edge.triangle];
            if (std::find(own.begin(), own.end(), *next) != own.end()) continue;
            const double share = along.dot(at(*next) - from) / along.squaredNorm();
            if (!(share > 0 && share < 1)) continue;
            if ((from + share * along - at(*next)).norm() <= tolerance_) found.emplace_back(share, *next);
        }
        std::sort(found.begin(), found.end());
        std::vector<std::int32_t> between;
        for (const auto& [share, v] : found) between.push_back(v);
        return between;
    }

    void divide(const OpenEdge& edge, const std::vector<std::int32_t>& between) {
        const auto own = result_.surface.triangles[edge.triangle];
        std::int32_t apex = own[0];
        for (const std::int32_t v : own)
            if (v != edge.from && v != edge.to) apex = v;
        note(at(between[0]));
        result_.split += between.size();
        result_.surface.triangles[edge.triangle] = {apex, edge.from, between[0]};
        for (std::size_t k = 0; k < between.size(); ++k) {
            const std::int32_t next = k + 1 < between.size() ? between[k + 1] : edge.to;
            result_.surface.triangles.push_back({apex, between[k], next});
            result_.source.push_back(result_.source[edge.triangle]);
        }
    }

    /// Vertices that no triangle has any more.
    void dropUnused() {
        std::vector<std::int32_t> number(vertices().size(), -1);
        for (const auto& triangle : result_.surface.triangles)
            for (const std::int32_t v : triangle) number[static_cast<std::size_t>(v)] = 0;
        std::int32_t kept = 0;
        for (std::size_t v = 0; v < number.size(); ++v) {
            if (number[v] < 0) continue;
            vertices()[static_cast<std::size_t>(kept)] = vertices()[v];
            number[v] = kept++;
        }
        vertices().resize(static_cast<std::size_t>(kept));
        for (auto& triangle : result_.surface.triangles)
            for (std::int32_t& v : triangle) v = number[static_cast<std::size_t>(v)];
    }

    double tolerance_;  ///< [m]
    SurfaceRepair result_;
};

}  // namespace

SurfaceRepair repairSurface(const TriangleSurface& surface, double tolerance) {
    return Repair(surface, tolerance).run();
}

}  // namespace talus
