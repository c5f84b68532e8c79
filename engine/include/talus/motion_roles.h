#pragma once
// How blocks move in a failure, from their displacements: one rule for the search, exports and the replay
// page.

#include <vector>

#include "talus/analysis.h"
#include "talus/polyhedron.h"

namespace talus {

/// The numbers of the rule. The program that writes the replay page passes them on to it.
struct MotionRule {
    /// A block moves when its displacement is this many times the elastic deflection, and this share of the
    /// largest displacement. (A larger share would leave out columns that slide behind others that rocking
    /// has set going earlier.)
    static constexpr double kDeflections = 2.0, kShare = 0.02;
    static constexpr double kToppling = 0.25;  ///< rotation times the moving group's extent, over the
                                               ///< displacement
    /// Of the displacement: a block that moves by as much against its neighbours at all contacts has no
    /// pivot. (A slide whose tip runs onto level ground is lifted there, and turns as it slides.)
    static constexpr double kNoPivot = 0.5;
    static constexpr double kPure = 0.9;  ///< share of the moving mass that gives the whole its mode
    /// Used where the elastic deflection is unknown: share of the smallest free block's size, far above what
    /// its joints give.
    static constexpr double kDeflectionOfSize = 5e-4;
};

/// A block's displacement since the start of the motion.
struct BlockDisplacement {
    bool free = true;
    Vec3 position = Vec3::Zero();  ///< of the centroid now [m]
    double radius = 0;             ///< to its farthest corner [m]
    double translation = 0;        ///< of the centroid [m]
    double rotation = 0;           ///< [rad]
    double spin = 0;               ///< of that, about the normal of the joint that carries the block [rad]
    double mass = 0;               ///< [kg]
    /// The least that it moves against a neighbour at any of their contact points [m]: nothing at a pivot. 0
    /// where that is not known.
    double least_against_others = 0;

    /// At most [m].
    double ofFarthestCorner() const { return translation + rotation * radius; }
    /// A turn about the normal opens no joint: the block slides.
    double tipping() const;
};

/// Per block: `none` when it does not move (or is not free), `toppling` when it turns about a pivot within
/// reach of the moving group, else `sliding`. A block that turns in the plane of its joint, or has no pivot
/// on a neighbour, slides. \param deflection elastic displacement of the assembly in equilibrium [m]
std::vector<FailureMode> motionRoles(const std::vector<BlockDisplacement>& blocks, double deflection);

/// Of the whole, by moving mass.
FailureMode overallMode(const std::vector<BlockDisplacement>& blocks, const std::vector<FailureMode>& roles);

}  // namespace talus
