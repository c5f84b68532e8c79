#pragma once
// The faces of a model that are to be seen from a side, and what their edges are.

#include <vector>

#include "report/blocks_files.h"
#include "report/paint_order.h"

namespace talus::tools {

/// Right, up and towards the reader, and against gravity.
struct Camera {
    Vec3 right, up, towards, level;

    explicit Camera(const View& view);
    /// A point as the picture has it.
    Vec3 seen(const Vec3& point) const { return {right.dot(point), up.dot(point), towards.dot(point)}; }
};

struct VisibleFace {
    std::size_t block = 0, face = 0;
    Vec3 normal = Vec3::Zero();
};

/// Faces that look at the reader and that no other block covers; the polygon of each, with its number in the
/// first list as source.
struct VisibleFaces {
    std::vector<VisibleFace> faces;
    std::vector<PaintedPolygon> polygons;
};
VisibleFaces visibleFaces(const Model& model, const Camera& camera);

}  // namespace talus::tools
