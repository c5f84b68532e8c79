#pragma once
// Convex polygons in a plane: outlines of faces, and the patches where two faces meet.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace talus {

using Vec2 = Eigen::Vector2d;

/// A convex polygon, vertices counter-clockwise [m]; empty or at least three vertices. Give coordinates
/// relative to an origin near the polygon (face_frame.h does), since they are clipped to 1e-12 of its size.
/// Up to `kInline` vertices live in the object itself; only larger ones allocate.
struct Polygon {
    static constexpr std::size_t kInline = 32;

    Polygon() = default;
    Polygon(std::initializer_list<Vec2> vertices) {
        for (const Vec2& vertex : vertices) push(vertex);
    }
    Polygon(const Polygon& other) { *this = other; }
    Polygon& operator=(const Polygon& other);

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const Vec2* begin() const { return heap_.empty() ? inline_.data() : heap_.data(); }
    const Vec2* end() const { return begin() + size_; }
    const Vec2& operator[](std::size_t i) const { return begin()[i]; }
    const Vec2& back() const { return begin()[size_ - 1]; }
    const Vec2& next(std::size_t i) const {
        return begin()[i + 1 < size_ ? i + 1 : 0];
    }  ///< the vertex after i

    void push(const Vec2& vertex);
    void pop();
    void clear();

 private:
    std::size_t size_ = 0;
    std::array<Vec2, kInline> inline_;
    std::vector<Vec2> heap_{};  ///< all vertices, once there are more than kInline
};

/// Integrals of x^2, xy and y^2 over the polygon, about the origin [m^4].
struct SecondMoments {
    double xx = 0, xy = 0, yy = 0;
};

/// A polygon of less than this share of the area it was cut from is a sliver, and comes out empty.
inline constexpr double kSliver = 1e-12;

double area(const Polygon& polygon);    ///< [m^2]
Vec2 centroid(const Polygon& polygon);  ///< \pre area > 0
SecondMoments secondMoments(const Polygon& polygon);

/// Longer side of the bounding box [m].
double extent(const Polygon& polygon);

/// The part with normal . x <= offset: `normal` (of any length but zero) points out of the part that is kept.
Polygon clipHalfPlane(const Polygon& polygon, const Vec2& normal, double offset);

/// The part common to both (Sutherland and Hodgman). A vertex within 1e-12 of the extents of an edge's line
/// counts as on it, so that equal or sharing outlines do not breed slivers; vertices that near to each other
/// are merged.
Polygon intersect(const Polygon& a, const Polygon& b);

/// Drops vertices within `tolerance` [m] of the line through their neighbours, or of each other: what remains
/// of nearly coincident edges. Empty if nothing with an area remains.
Polygon simplify(const Polygon& polygon, double tolerance);

}  // namespace talus
