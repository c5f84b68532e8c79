#pragma once
// The visible faces of a model, and the kinds of their edges.

#include <vector>

#include "report/blocks_files.h"
#include "report/paint_order.h"

namespace talus::tools {

/// Right, up and towards the reader, and against gravity.
struct Camera {
    Vec3 right, up, towards, level;

    explicit Camera(const View& view);
    /// A point in the picture's coordinates.
    Vec3 seen(const Vec3& point) const { return {right.dot(point), up.dot(point), towards.dot(point)}; }
};

struct VisibleFace {
    std::size_t block = 0, face = 0;
    Vec3 normal = Vec3::Zero();
};

/// Faces towards the reader that no other block covers; the polygon of each, with its number in the first
/// list as source.
struct VisibleFaces {
    std::vector<VisibleFace> faces;
    std::vector<PaintedPolygon> polygons;
};
VisibleFaces visibleFaces(const Model& model, const Camera& camera);

}  // namespace talus::tools
