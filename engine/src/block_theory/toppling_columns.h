#pragma once
// Columns that lean on each other above a stepped base (R. E. Goodman and J. W. Bray, Toppling of rock
// slopes, 1976; E. Hoek and J. W. Bray, Rock Slope Engineering, 1981, chapter 10).
//
// From the uppermost column down, each column passes on the least push with which it neither topples about
// the downhill end of its base nor slides on it. Friction is limiting on every side face. The push of a
// column that topples acts at the upper end of the face, as in the source. That of one that only slides acts
// as low as its own moments allow. The slope is at its limit where the toe column needs no push from outside.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.h"

namespace talus::keyblocks {

/// The face between a column and the next one downhill, in the plane of the section.
struct SideFace {
    Vec2 top, bottom;  ///< ends of the contact [m]
    Vec2 normal;       ///< unit, downhill
    Vec2 along;        ///< unit, from the base up
    double tan_friction = 0;
};

struct LeaningColumn {
    Vec2 pivot;                       ///< downhill end of the base [m]
    Vec2 base_normal;                 ///< unit, into the column
    Vec2 downhill;                    ///< unit, along the base
    double base_length = 0;           ///< from the pivot uphill [m]
    double tan_friction = 0;          ///< of the base
    Vec2 force;                       ///< of all but contacts [N]
    double moment = 0;                ///< of `force` about the pivot, positive downhill [N m]
    double arm = 0;                   ///< from the pivot to the centroid [m]
    std::optional<SideFace> front{};  ///< the toe column has none
};

/// Moment of a force, positive where it turns a column downhill. \param arm  from the pivot to where it acts
double turning(const LeaningColumn& column, const Vec2& arm, const Vec2& force);

/// What the columns do at a factor of safety.
struct LeaningState {
    /// Moment or force that the toe column lacks, as a share of its weight: above 0 the slope fails.
    double excess = 0;
    std::size_t moving = 0;  ///< columns from the toe up that push on the next one, the toe included
    bool topples = false;    ///< whether any of these does
};

/// \param columns  from the toe up
/// \param factor   of safety, by which every tan_friction is divided
/// \return nothing where friction locks a column between its base and its side face, or where the base would
/// have to press beyond its uphill end, or pull
std::optional<LeaningState> leaningAt(std::span<const LeaningColumn> columns, double factor);

}  // namespace talus::keyblocks
