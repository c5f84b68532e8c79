// A coarser surface within a stated deviation, by removal of one vertex after the other.
//
//   star of u --u goes to its neighbour v--> fan of v in the star's outline
//
// Both are graphs over the same outline in a plane, so pushing along that plane's normal maps one onto the
// other, one to one. The displacement is linear between the corners of the two superposed. So it is largest
// at one of these: at u, or where an edge of the star crosses one of the fan. Every triangle keeps the sum of
// the displacements that made it. The maps of all steps in turn take the first surface onto the last one, and
// no point moves farther than that sum. It bounds the Hausdorff distance both ways. It is not the least bound
// (opposite displacements add up), but needs no search in the first surface.

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "rock_mass/surface_faults.h"

namespace talus {

namespace {

using namespace rock_mass;

constexpr double kLeastLean = 0.05;    // cosine between a triangle and the plane its star is drawn in
constexpr double kStillUpward = 1e-6;  // likewise, for triangles that face up and must stay so
constexpr double kInLine = 1e-9;       // of the length: corners of the rim this near to a line in plan may be
                                       // removed
constexpr double kWorstShape = 0.02;   // shape (1 is equilateral) of the worst triangle that may be made ...
constexpr double kShapeShare = 0.05;   // ... and the deviation accepted for a good one, as a share

using Vec2d = Eigen::Vector2d;
using Corners = std::array<std::int32_t, 3>;

double cross(const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A place in a plane and the height over it.
struct Drawn {
    Vec2d at;
    double height;
};

/// The plane a star is drawn in.
struct Sheet {
    Vec3 e1, e2, normal;

    explicit Sheet(const Vec3& n) : e1(n.unitOrthogonal()), e2(n.cross(e1)), normal(n) {}
    Drawn draw(const Vec3& x) const { return {{e1.dot(x), e2.dot(x)}, normal.dot(x)}; }
};

/// Height over the triangle at a place inside it.
std::optional<double> heightIn(const std::array<Drawn, 3>& t, const Vec2d& at) {
    const double whole = cross(t[1].at - t[0].at, t[2].at - t[0].at);
    std::array<double, 3> share;
    for (std::size_t i = 0; i < 3; ++i)
        share[i] = cross(t[(i + 1) % 3].at - at, t[(i + 2) % 3].at - at) / whole;
    if (*std::min_element(share.begin(), share.end()) < -1e-9) return std::nullopt;
    return share[0] * t[0].height + share[1] * t[1].height + share[2] * t[2].height;
}

/// How far apart two edges lie where they cross; 0 if they do not.
double gapAtCrossing(const Drawn& a, const Drawn& b, const Drawn& c, const Drawn& d) {
    const Vec2d ab = b.at - a.at, cd = d.at - c.at;
    const double whole = cross(ab, cd);
    if (whole == 0) return 0;
    const double s = cross(c.at - a.at, cd) / whole, t = cross(c.at - a.at, ab) / whole;
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return 0;
    return std::abs(a.height + s * (b.height - a.height) - c.height - t * (d.height - c.height));
}

/// A candidate removal of a vertex.
struct Removal {
    double cost = 0;       ///< priority [m]
    double deviation = 0;  ///< of the triangles it makes, from the first surface [m]
    std::int32_t vertex = 0, onto = 0;
    std::size_t version = 0;  ///< of the vertex' star when this was computed

    bool operator<(const Removal& other) const {  // the queue has the largest first
        return std::pair(cost, vertex) > std::pair(other.cost, other.vertex);
    }
};

class Simplifier {
 public:
    Simplifier(const TriangleSurface& surface, double allowed)
        : surface_(surface),
          allowed_(allowed),
          star_(surface.vertices.size()),
          version_(surface.vertices.size()),
          deviation_(surface.triangles.size()) {
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
            for (const std::int32_t v : surface.triangles[t]) starOf(v).push_back(t);
    }

    TriangleSurface run() {
        for (std::size_t v = 0; v < star_.size(); ++v) propose(static_cast<std::int32_t>(v));
        while (!queue_.empty()) {
            const Removal removal = queue_.top();
            queue_.pop();
            if (removal.version != version_[static_cast<std::size_t>(removal.vertex)]) continue;
            if (isStillSound(removal)) remove(removal);
        }
        return rest();
    }

 private:
    std::vector<std::size_t>& starOf(std::int32_t v) { return star_[static_cast<std::size_t>(v)]; }
    const Vec3& at(std::int32_t v) const { return surface_.vertices[static_cast<std::size_t>(v)]; }
    const Corners& corners(std::size_t t) const { return surface_.triangles[t]; }

    Vec3 area(const Corners& t) const { return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])); }

    double shape(const Corners& t) const {
        double sides = 0;
        for (std::size_t i = 0; i < 3; ++i) sides += (at(t[(i + 1) % 3]) - at(t[i])).squaredNorm();
        return 2 * std::sqrt(3.0) * area(t).norm() / sides;
    }

    /// Neighbours of a vertex with the number of triangles they share with it: two, or one along the rim.
    std::vector<std::pair<std::int32_t, int>> neighbours(std::int32_t u) const {
        std::vector<std::int32_t> all;
        for (const std::size_t t : star_[static_cast<std::size_t>(u)])
            for (const std::int32_t v : corners(t))
                if (v != u) all.push_back(v);
        std::sort(all.begin(), all.end());
        std::vector<std::pair<std::int32_t, int>> counted;
        for (const std::int32_t v : all)
            if (!counted.empty() && counted.back().first == v)
                ++counted.back().second;
            else
                counted.emplace_back(v, 1);
        return counted;
    }

    void propose(std::int32_t u) {
        const auto around = neighbours(u);
        std::vector<std::int32_t> rim;
        for (const auto& [v, shared] : around)
            if (shared == 1) rim.push_back(v);
        if (around.size() < 3 - rim.size() / 2 || (!rim.empty() && !liesInLine(u, rim))) return;
        std::optional<Removal> best;
        for (const auto& [v, shared] : around) {
            if (!rim.empty() && shared != 1) continue;
            auto removal = removalOf(u, v, around, !rim.empty());
            if (removal && (!best || removal->cost < best->cost)) best = removal;
        }
        if (!best) return;
        best->version = version_[static_cast<std::size_t>(u)];
        queue_.push(*best);
    }

    bool liesInLine(std::int32_t u, const std::vector<std::int32_t>& rim) const {
        if (rim.size() != 2) return false;
        const Vec2d a = (at(rim[0]) - at(u)).head<2>(), b = (at(rim[1]) - at(u)).head<2>();
        return a.dot(b) < 0 &&
               std::abs(cross(a, b)) <= kInLine * (a - b).norm() * std::min(a.norm(), b.norm());
    }

    std::optional<Removal> removalOf(std::int32_t u, std::int32_t v,
                                     const std::vector<std::pair<std::int32_t, int>>& around,
                                     bool on_rim) const {
        if (!keepsTopology(v, around, on_rim)) return std::nullopt;
        const auto& star = star_[static_cast<std::size_t>(u)];
        std::vector<Corners> fan;
        for (const std::size_t t : star)
            if (std::find(corners(t).begin(), corners(t).end(), v) == corners(t).end()) {
                fan.push_back(corners(t));
                std::replace(fan.back().begin(), fan.back().end(), u, v);
            }
        if (fan.empty()) return std::nullopt;
        double before = 0, old_shape = 1, new_shape = 1;
        for (const std::size_t t : star) {
            before = std::max(before, deviation_[t]);
            old_shape = std::min(old_shape, shape(corners(t)));
        }
        for (const Corners& t : fan) new_shape = std::min(new_shape, shape(t));
        if (new_shape < std::min(kWorstShape, old_shape)) return std::nullopt;
        const auto push = largestPush(u, v, star, fan, around, on_rim);
        if (!push || !(before + *push <= allowed_)) return std::nullopt;
        return Removal{before + *push + kShapeShare * allowed_ * (1 - new_shape), before + *push, u, v};
    }

    /// u and v have no more neighbours in common than the triangles between them (H. Edelsbrunner's link
    /// condition).
    bool keepsTopology(std::int32_t v, const std::vector<std::pair<std::int32_t, int>>& around,
                       bool on_rim) const {
        std::size_t common = 0;
        const auto others = neighbours(v);
        for (const auto& [w, shared] : others)
            common += std::binary_search(around.begin(), around.end(), std::pair(w, 0),
                                         [](const auto& a, const auto& b) { return a.first < b.first; });
        const bool ends =
            std::any_of(others.begin(), others.end(), [](const auto& n) { return n.second == 1; });
        const bool tetrahedron = !ends && around.size() == 3 && others.size() == 3;
        return common == (on_rim ? 1u : 2u) && !tetrahedron;
    }

    /// Nothing where star and fan are no graphs over one plane.
    std::optional<double> largestPush(std::int32_t u, std::int32_t v, const std::vector<std::size_t>& star,
                                      const std::vector<Corners>& fan,
                                      const std::vector<std::pair<std::int32_t, int>>& around,
                                      bool on_rim) const {
        Vec3 normal = Vec3::Zero();
        bool looks_up = true;
        for (const std::size_t t : star) {
            const Vec3 a = area(corners(t));
            normal += a;
            looks_up = looks_up && a.z() > kStillUpward * a.norm();
        }
        if (on_rim && !looks_up) return std::nullopt;
        if (on_rim) normal = Vec3::UnitZ();  // along the rim both have the same outline in plan only
        const Sheet sheet(normal.normalized());
        for (const std::size_t t : star)
            if (!leans(area(corners(t)), sheet)) return std::nullopt;
        for (const Corners& t : fan) {
            const Vec3 a = area(t);
            if (!leans(a, sheet) || (looks_up && !(a.z() > kStillUpward * a.norm()))) return std::nullopt;
        }
        return pushIn(sheet, u, v, fan, around);
    }

    static bool leans(const Vec3& area, const Sheet& sheet) {
        return area.dot(sheet.normal) > kLeastLean * area.norm();
    }

    std::optional<double> pushIn(const Sheet& sheet, std::int32_t u, std::int32_t v,
                                 const std::vector<Corners>& fan,
                                 const std::vector<std::pair<std::int32_t, int>>& around) const {
        const Vec3& origin = at(u);  // far from the model's own, heights would be rounded
        const auto drawn = [&](std::int32_t w) { return sheet.draw(at(w) - origin); };
        const Drawn middle = drawn(u), onto = drawn(v);
        std::optional<double> height;
        for (const Corners& t : fan)
            if (!height) height = heightIn({drawn(t[0]), drawn(t[1]), drawn(t[2])}, middle.at);
        if (!height) return std::nullopt;
        double push = std::abs(*height);
        for (const auto& [w, shared] : around) {
            const Drawn end = drawn(w);
            for (const auto& [x, also] : around)
                if (x != w && x != v && w != v)
                    push = std::max(push, gapAtCrossing(middle, end, onto, drawn(x)));
        }
        return push;
    }

    /// Later changes around its neighbour may obstruct the removal: then the vertex gets another neighbour.
    bool isStillSound(const Removal& removal) {
        const auto around = neighbours(removal.vertex);
        const bool on_rim =
            std::any_of(around.begin(), around.end(), [](const auto& n) { return n.second == 1; });
        if (keepsTopology(removal.onto, around, on_rim)) return true;
        propose(removal.vertex);
        return false;
    }

    void remove(const Removal& removal) {
        std::vector<std::int32_t> link;
        for (const auto& [v, shared] : neighbours(removal.vertex)) link.push_back(v);
        const auto star = starOf(removal.vertex);
        for (const std::size_t t : star) {
            auto& triangle = surface_.triangles[t];
            const bool goes = std::find(triangle.begin(), triangle.end(), removal.onto) != triangle.end();
            if (goes) {
                for (const std::int32_t v : triangle) std::erase(starOf(v), t);
                triangle = {-1, -1, -1};
                continue;
            }
            std::replace(triangle.begin(), triangle.end(), removal.vertex, removal.onto);
            starOf(removal.onto).push_back(t);
            deviation_[t] = removal.deviation;
        }
        starOf(removal.vertex).clear();
        ++version_[static_cast<std::size_t>(removal.vertex)];
        for (const std::int32_t v : link) {
            ++version_[static_cast<std::size_t>(v)];
            propose(v);
        }
    }

    TriangleSurface rest() const {
        TriangleSurface kept;
        std::vector<std::int32_t> number(surface_.vertices.size(), -1);
        for (const Corners& triangle : surface_.triangles) {
            if (triangle[0] < 0) continue;
            for (const std::int32_t v : triangle) number[static_cast<std::size_t>(v)] = 0;
        }
        for (std::size_t v = 0; v < number.size(); ++v) {
            if (number[v] < 0) continue;
            number[v] = static_cast<std::int32_t>(kept.vertices.size());
            kept.vertices.push_back(surface_.vertices[v]);
        }
        for (const Corners& triangle : surface_.triangles) {
            if (triangle[0] < 0) continue;
            kept.triangles.push_back(triangle);
            for (std::int32_t& v : kept.triangles.back()) v = number[static_cast<std::size_t>(v)];
        }
        return kept;
    }

    TriangleSurface surface_;
    double allowed_;                              ///< [m]
    std::vector<std::vector<std::size_t>> star_;  ///< triangles of each vertex
    std::vector<std::size_t> version_;
    std::vector<double> deviation_;  ///< of each triangle: largest displacement of its points [m]
    std::priority_queue<Removal> queue_;
};

}  // namespace

TriangleSurface simplifySurface(const TriangleSurface& surface, double deviation) {
    return Simplifier(surface, deviation).run();
}

}  // namespace talus
