#pragma once
// From joint sets and single joints to the planes that cut.

#include <optional>
#include <vector>

#include "geometry/face_frame.h"
#include "rock_mass/cell.h"
#include "talus/result.h"
#include "talus/rock_mass.h"

namespace talus::rock_mass {

/// How far a finite joint reaches: a disc, else a convex polygon, in the frame of its plane.
struct Reach {
    FaceFrame frame;
    double radius = 0;  ///< [m]; 0 for a polygon
    Polygon polygon{};
    Vec3 min = Vec3::Zero(), max = Vec3::Zero();  ///< its bounds [m]

    /// Whether it covers part of an outline in its plane.
    bool covers(const std::vector<Vec3>& outline, double weld) const;
    /// Of an outline in the frame's plane, counter-clockwise [m^2].
    double coveredArea(const Polygon& outline) const;
    /// Projected onto its plane, counter-clockwise there.
    Polygon flat(const std::vector<Vec3>& outline) const;
};

struct JointPlane {
    Plane plane;
    std::optional<Reach> reach;  ///< none: through the whole region
    std::size_t joint = 0;       ///< index into the sets, then the singles
};

/// All planes in the order of cutting. \param corners  of the region
std::vector<Error> checkJoints(const RockMass& description);
Result<std::vector<JointPlane>> jointPlanes(const RockMass& description, const std::vector<Vec3>& corners);

}  // namespace talus::rock_mass
