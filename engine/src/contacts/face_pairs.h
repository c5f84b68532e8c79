#pragma once
// Faces of two blocks that lie against each other: where interfaces are.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/face_frame.h"
#include "geometry/polygon.h"
#include "geometry/world_shape.h"
#include "talus/polyhedron.h"

namespace talus {

struct FacePairLimits {
    double max_gap = 0;            ///< of the patch's nearest point [m]
    double max_overlap = 0;        ///< [m], positive; smaller than a block is thick
    double max_angle = 0;          ///< between the two planes, however deep they overlap [rad]
    double min_area_share = 1e-6;  ///< of the smaller face; a smaller patch is no interface
    /// Share of the patch's size below which its corners are merged or straightened. Otherwise outlines that
    /// differ only by elastic displacements would give corners, and so contact points, that appear and
    /// vanish.
    double outline_tolerance = 1e-6;
    /// Between two planes that touch, and what it grows by for each share of `size` that they overlap [rad].
    double touching_angle = std::numeric_limits<double>::infinity(), angle_per_depth = 0;
    double size = 1;  ///< [m]

    /// The largest angle between two planes with this least gap [rad].
    double angleAt(double gap) const {
        return std::min(touching_angle + angle_per_depth * std::max(0.0, -gap) / size, max_angle);
    }
};

struct FacePair {
    std::int32_t face_a = 0, face_b = 0;
    Polygon patch{};       ///< in the frame of a's face, which gives the normal and the tangents [m]
    double share = 1;      ///< of the smaller face that the patch covers
    double gap = 0;        ///< at the patch's centroid along a's normal, negative for overlap [m]
    double least_gap = 0;  ///< over the patch; differs from `gap` where the planes are not parallel [m]
    double most_gap = 0;   ///< likewise [m]
};

FaceFrame faceFrame(const WorldShape& shape, std::size_t face);

/// The patch between two given faces, if they lie against each other: their normals are opposite within the
/// angle, b's outline projected along a's normal overlaps a's, and the least gap is within the limits.
std::optional<FacePair> findFacePair(const WorldShape& a, std::size_t face_a, const WorldShape& b,
                                     std::size_t face_b, const FacePairLimits& limits);

/// All of them between faces of the surface, by face_a, then face_b.
std::vector<FacePair> findFacePairs(const WorldShape& a, const WorldShape& b, const FacePairLimits& limits);

}  // namespace talus
