// Where a surface crosses itself: an edge that goes through the inside of a triangle, from one side to the
// other. Two triangles in general position cross only so. Near misses (1e-9 of the extent) do not count.

#include <cmath>
#include <optional>

#include "geometry/box_tree.h"
#include "rock_mass/place_text.h"
#include "rock_mass/surface_faults.h"

namespace talus::rock_mass {

namespace {

constexpr double kNearMiss = 1e-9;   // of the extent
constexpr double kLeastWidth = 1e3;  // times that: the plane of a narrower triangle is not known so well
constexpr double kFolded = 1e-12;    // 1 + cosine of the angle between the normals of neighbours

class Crossings {
 public:
    explicit Crossings(const TriangleSurface& surface)
        : surface_(surface), near_(kNearMiss * surfaceExtent(surface)) {
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            boxes_.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) boxes_.back().add(cornerOf(surface, t, i));
        }
    }

    std::vector<Error> errors() const {
        std::vector<Error> errors;
        const BoxTree tree(boxes_);
        std::vector<std::size_t> near;
        for (std::size_t t = 0; t < boxes_.size() && errors.size() < kMostFaults; ++t) {
            near.clear();
            tree.visit(boxes_[t], [&](std::size_t other) {
                if (other > t) near.push_back(other);
            });
            std::sort(near.begin(), near.end());
            for (const std::size_t other : near)
                if (auto error = errorOf(t, other)) {
                    errors.push_back(std::move(*error));
                    break;
                }
        }
        return errors;
    }

 private:
    std::optional<Error> errorOf(std::size_t a, std::size_t b) const {
        if (commonCorners(a, b) == 2) return isFolded(a, b) ? std::optional(folded(a, b)) : std::nullopt;
        auto place = whereThrough(a, b);
        if (!place) place = whereThrough(b, a);
        if (!place) return std::nullopt;
        return Error{triangleField(a), "found a surface that crosses itself: this triangle and " +
                                           triangleField(b) + " meet near " + placeText(*place) +
                                           ", allowed: a surface that separates inside from outside"};
    }

    Error folded(std::size_t a, std::size_t b) const {
        return {triangleField(a), "found a surface folded back onto itself: this triangle lies on " +
                                      triangleField(b) + " near " + placeText(cornerOf(surface_, a, 0)) +
                                      ", allowed: a surface that separates inside from outside"};
    }

    int commonCorners(std::size_t a, std::size_t b) const {
        int common = 0;
        for (const std::int32_t v : surface_.triangles[a])
            for (const std::int32_t w : surface_.triangles[b]) common += v == w;
        return common;
    }

    bool isFolded(std::size_t a, std::size_t b) const {
        return 1 + areaVector(surface_, a).normalized().dot(areaVector(surface_, b).normalized()) < kFolded;
    }

    /// A point in which an edge of one triangle goes through another one.
    std::optional<Vec3> whereThrough(std::size_t edges_of, std::size_t through) const {
        const Vec3 normal = areaVector(surface_, through).normalized();
        const Vec3& at = cornerOf(surface_, through, 0);
        std::array<double, 3> height;
        for (std::size_t i = 0; i < 3; ++i) height[i] = normal.dot(cornerOf(surface_, edges_of, i) - at);
        for (std::size_t i = 0; i < 3; ++i) {
            const double h = height[i], k = height[(i + 1) % 3];
            if (!((h > near_ && k < -near_) || (h < -near_ && k > near_))) continue;
            const Vec3 &p = cornerOf(surface_, edges_of, i), &q = cornerOf(surface_, edges_of, (i + 1) % 3);
            const Vec3 x = p + h / (h - k) * (q - p);
            if (isInside(x, through, normal)) return x;
        }
        return std::nullopt;
    }

    /// Its own edges count as inside, unless it is so slender that they lie close to each other.
    bool isInside(const Vec3& x, std::size_t t, const Vec3& normal) const {
        double longest = 0;
        for (std::size_t i = 0; i < 3; ++i)
            longest =
                std::max(longest, (cornerOf(surface_, t, (i + 1) % 3) - cornerOf(surface_, t, i)).norm());
        const bool slender = areaVector(surface_, t).norm() < kLeastWidth * near_ * longest;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& a = cornerOf(surface_, t, i);
            const Vec3 edge = cornerOf(surface_, t, (i + 1) % 3) - a;
            if (normal.dot(edge.cross(x - a)) < (slender ? near_ : -near_) * edge.norm()) return false;
        }
        return true;
    }

    const TriangleSurface& surface_;
    double near_;  ///< [m]
    std::vector<Box> boxes_;
};

}  // namespace

std::vector<Error> crossingErrors(const TriangleSurface& surface) { return Crossings(surface).errors(); }

}  // namespace talus::rock_mass
