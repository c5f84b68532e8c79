#pragma once
// The part of a face in an axis-aligned box.

#include <cmath>

#include "geometry/face_frame.h"

namespace talus {

/// \param face the polygon's plane, in the frame of the box; a face normal to an axis lies in the box or not,
///              as a whole, by `closed` [m]
inline Polygon clippedToBox(Polygon polygon, const FaceFrame& face, const Vec3& min, const Vec3& max,
                            double closed) {
    constexpr double kFlat = 1e-12;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            const double most = sign * ((sign > 0 ? max : min)[axis] - face.origin[axis]);
            const Vec2 out(sign * face.e1[axis], sign * face.e2[axis]);
            if (polygon.empty()) return polygon;
            if (out.norm() > kFlat)
                polygon = clipHalfPlane(polygon, out, most);
            else if (most < -closed)
                return {};
        }
    return polygon;
}

}  // namespace talus
