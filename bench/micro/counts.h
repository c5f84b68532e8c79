#pragma once
// What a contact point and a block cost: operations and bytes, counted by running the kernels' own source on
// a number that counts.

#include <string>

#include "talus/model.h"

namespace talus::bench {

struct Counts {
    double flops = 0;      ///< additions, subtractions, multiplications
    double divisions = 0;  ///< double / double
    double roots = 0;      ///< square roots
    double choices = 0;    ///< comparisons, larger and smaller, selections
    double read = 0;       ///< bytes streamed in: each array counted once, poses of blocks not counted
    double written = 0;    ///< bytes streamed out

    double bytes() const { return read + written; }
};

/// One interface with a rectangular patch, all contact points sticking or all slipping, no bond, no dashpot.
Counts countInterface(PointRule rule, bool slips);

/// Drift of one block.
Counts countDrift();

/// Gather of one block in a big stack: three interfaces per block, six sides.
Counts countGather();

/// Gather of one block and its drift into the next step, in one pass.
Counts countGatherAndDrift();

int pointsPerRectangle(PointRule rule);
std::string nameOf(PointRule rule);  ///< "vertex", "grid4", ...

}  // namespace talus::bench
