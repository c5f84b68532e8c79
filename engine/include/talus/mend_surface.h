#pragma once
// Surfaces that are almost right: doubled triangles, triangles that face the wrong way, small holes.

#include <cstdint>
#include <vector>

#include "talus/surface.h"

namespace talus {

/// What may be mended. Lengths in metres.
struct MendLimits {
    double tolerance = 0;     ///< of the vertices, as repairSurface takes it
    double largest_hole = 0;  ///< longest side of the box around a hole that is closed
    bool keeps_rim = false;   ///< a terrain: the outline of the largest area in plan is no hole
};

/// An opening in a surface.
struct SurfaceHole {
    Vec3 middle = Vec3::Zero();  ///< of its corners [m]
    std::size_t edges = 0;
    double width = 0;  ///< longest side of the box around it [m]
};

struct MendedSurface {
    static constexpr std::size_t kMade = SIZE_MAX;

    TriangleSurface surface;
    std::vector<std::size_t> source;    ///< per triangle: the one it was; kMade where it closes a hole
    std::vector<Vec3> doubled;          ///< middles of triangles left out as duplicates
    std::vector<Vec3> turned;           ///< middles of triangles that were turned over
    std::vector<SurfaceHole> closed;    ///< with triangles between their corners
    std::vector<SurfaceHole> too_wide;  ///< left open
    std::vector<SurfaceHole> unclear;   ///< left open: their outline crosses itself, seen from the front

    bool changed() const { return !doubled.empty() || !turned.empty() || !closed.empty(); }
};

/// Leaves out duplicate triangles, and turns over those that face against most of their connected piece (all
/// of a closed surface that faces inwards). Closes small holes between their corners. No vertex moves.
/// checkSurface finds what is still wrong. \pre a surface from repairSurface with this tolerance
MendedSurface mendSurface(const TriangleSurface& surface, const MendLimits& limits);

}  // namespace talus
