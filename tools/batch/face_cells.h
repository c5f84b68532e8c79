#pragma once
// The face of a slope, divided into cells. Pure geometry.

#include <cstddef>
#include <optional>
#include <vector>

#include "talus/surface.h"

namespace talus::tools::batch {

/// A cell: a rectangle of one plane of the face, cut off where the plane ends.
struct FaceCell {
    std::vector<std::vector<Vec3>> pieces;  ///< convex polygons, counter-clockwise seen from outside [m]
    Vec3 centre = Vec3::Zero();             ///< of its largest piece: a point of the cell [m]
    Vec3 normal = Vec3::UnitZ();            ///< outward
    double area = 0;                        ///< [m^2]
};

struct Face {
    std::vector<FaceCell> cells;
    double cell_size = 0;  ///< the one asked for, or the default; cells are that wide, rounded to fit [m]
    double area = 0;       ///< of all cells [m^2]
    /// Which way the slope faces, horizontal and of length 1; nothing on level ground.
    std::optional<Vec3> outlook{};
};

/// More cells than this make a map that no program draws.
inline constexpr std::size_t kMostCells = 1'000'000;

/// The part of a region's surface that is a face: all but its base, and the upright sides that reach down to
/// the base, where the model was cut off. A side that faces the way of the slope stays, since it may be a
/// vertical face; without a slope all sides stay.
/// \param cell_size  [m]; default: 2,000 cells, rounded to 1, 2 or 5 times a power of ten. Nothing where
/// that makes more than kMostCells. \pre a closed surface
std::optional<Face> divideFace(const TriangleSurface& region, std::optional<double> cell_size);

}  // namespace talus::tools::batch
