#pragma once
// How a section can fail (upper bounds), and whether it can stand (a lower bound). Where the two meet, the
// tilt is exact. Where they do not, columns lean on each other in a way that the closed formulas do not
// cover.

#include <vector>

#include "theory/section.h"

namespace talus::theory {

/// A mass that can move downhill by itself: it is free in front and parts from the mass behind it.
struct Mechanism {
    std::size_t bed = 0;                            ///< index into Section::beds
    std::size_t first_column = 0, last_column = 0;  ///< 0-based
    bool topples = false;
    double tilt = 0;  ///< at which it starts [rad]
};

/// The mechanism with the lowest tilt: columns first..i above a bed sliding together, or the foremost column
/// above a bed overturning about its downhill edge. Of equals the lowest bed and the fewest columns, sliding
/// before toppling.
Mechanism weakestMechanism(const Section& section);

/// True when, with frictionless fissures, forces between the columns exist that keep every column from
/// sliding and overturning downhill at this tilt above every bed. (Goodman and Bray's chain from the last
/// column to the toe, with the push's height on the fissure left free and chosen as low as it can be.) Beds
/// with cohesion must in addition stay closed over their whole area, or their cohesive area would be less
/// than the formulas take.
bool canStand(const Section& section, double tilt);

}  // namespace talus::theory
