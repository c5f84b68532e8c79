#include "contacts/face_pairs.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// One face of a block in the world.
struct Face {
    const WorldShape& shape;
    std::size_t index;

    const std::vector<std::int32_t>& outline() const { return shape.faces[index]; }
    std::size_t size() const { return outline().size(); }
    const Vec3& vertex(std::size_t i) const { return shape.vertices[static_cast<std::size_t>(outline()[i])]; }
    const Vec3& normal() const { return shape.normals[index]; }
};

double area(const Face& face) {
    double doubled = 0;
    for (std::size_t i = 2; i < face.size(); ++i)
        doubled +=
            face.normal().dot((face.vertex(i - 1) - face.vertex(0)).cross(face.vertex(i) - face.vertex(0)));
    return 0.5 * doubled;
}

// Of FacePairLimits::size: far more than rounding and uneven faces let a patch lie below the faces' corners.
constexpr double kUneven = 1e-4;
constexpr double kClearly = 1.01;  // of a square: more than rounding

/// The chord between one normal and the other's opposite is exact for the small angles where a cosine is not.
/// It is never longer than the arc.
bool isWithin(double chord, double angle) { return chord <= angle && chord <= 2.0 * std::sin(0.5 * angle); }

/// Whether the gap and tilt of a patch between the two planes can be within the limits: its gap lies between
/// the heights of the other face's vertices. Excludes the far sides of two blocks, and most faces that are not
/// parallel, before any clipping.
bool canTouch(const FaceFrame& frame, const Face& other, double chord, const FacePairLimits& limits) {
    double least = frame.height(other.vertex(0)), most = least;
    for (std::size_t i = 1; i < other.size(); ++i) {
        const double height = frame.height(other.vertex(i));
        least = std::min(least, height);
        most = std::max(most, height);
    }
    return least <= limits.max_gap && most >= -limits.max_overlap &&
           isWithin(chord, limits.angleAt(least - kUneven * limits.size));
}

/// Outline in the frame's plane, counter-clockwise there on either side of the face.
Polygon projectOutline(const FaceFrame& frame, const Face& face) {
    const bool same_side = face.normal().dot(frame.e3) > 0;
    Polygon outline;
    for (std::size_t i = 0; i < face.size(); ++i)
        outline.push(frame.toPlane(face.vertex(same_side ? i : face.size() - 1 - i)));
    return outline;
}

/// Height of the other face's plane above a point of the reference plane, along the reference normal [m].
double gapAt(const FaceFrame& frame, const Face& other, const Vec2& point) {
    const Vec3 below = frame.toWorld(point);
    return other.normal().dot(other.vertex(0) - below) / other.normal().dot(frame.e3);
}

FaceFrame frameOf(const Face& face) { return faceFrame(face.vertex(0), face.vertex(1), face.normal()); }

}  // namespace

FaceFrame faceFrame(const WorldShape& shape, std::size_t face) { return frameOf({shape, face}); }

std::optional<FacePair> findFacePair(const WorldShape& a, std::size_t face_a, const WorldShape& b,
                                     std::size_t face_b, const FacePairLimits& limits) {
    const Face in_a{a, face_a}, in_b{b, face_b};
    const Vec3 sum = in_a.normal() + in_b.normal();
    // Most pairs of faces need no square root.
    if (sum.squaredNorm() > kClearly * limits.max_angle * limits.max_angle) return {};
    const double chord = sum.norm();
    if (!isWithin(chord, limits.max_angle)) return {};
    const FaceFrame frame = frameOf(in_a);
    if (!canTouch(frame, in_b, chord, limits)) return {};

    const Polygon common = intersect(projectOutline(frame, in_a), projectOutline(frame, in_b));
    const Polygon patch = simplify(common, limits.outline_tolerance * extent(common));
    if (patch.empty()) return {};
    const double share = area(patch) / std::min(area(in_a), area(in_b));
    if (!(share > limits.min_area_share)) return {};
    FacePair pair{static_cast<std::int32_t>(face_a), static_cast<std::int32_t>(face_b), patch, share,
                  gapAt(frame, in_b, centroid(patch))};
    pair.least_gap = pair.most_gap = pair.gap;
    for (const Vec2& corner : patch) {
        const double gap = gapAt(frame, in_b, corner);
        pair.least_gap = std::min(pair.least_gap, gap);
        pair.most_gap = std::max(pair.most_gap, gap);
    }
    if (pair.least_gap > limits.max_gap || pair.least_gap < -limits.max_overlap) return {};
    if (chord > 2.0 * std::sin(0.5 * limits.angleAt(pair.least_gap))) return {};
    return pair;
}

std::vector<FacePair> findFacePairs(const WorldShape& a, const WorldShape& b, const FacePairLimits& limits) {
    std::vector<FacePair> pairs;
    for (std::size_t face_a = 0; face_a < a.faces.size(); ++face_a) {
        if (a.isInner(face_a)) continue;
        for (std::size_t face_b = 0; face_b < b.faces.size(); ++face_b) {
            if (b.isInner(face_b)) continue;
            if (auto pair = findFacePair(a, face_a, b, face_b, limits)) pairs.push_back(*pair);
        }
    }
    return pairs;
}

}  // namespace talus
