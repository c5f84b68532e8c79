#pragma once
// Heads in a joint network, with the free surface found by pseudo-transient steps.
//
//   begin:  heads of full joints
//   step:   (dR/dh + S / dt) dh = -R, outlets opened and closed before it
//           (pseudo-transient continuation: Kelley and Keyes 1998, SIAM J. on Numerical Analysis 35, 508)
//   next:   dt grows while the imbalance does not; else it shrinks and the step is taken again
//           It shrinks, too, where outlets switch: long steps may open and close the same one for ever
//
// S is the storage of an unconfined joint, whose water stands higher as its head rises. No answer contains it:
// each node has as much as its conductances, so that all take part in a step alike. With dt the steps become
// those of Newton's method. A ramp that does not settle at once is reached from wider ones, each from the heads
// of the one before. The equations have one solution, so the answer is the same.

#include <vector>

#include "flow/conditions.h"
#include "flow/equations.h"

namespace talus::flow {

struct Heads {
    std::vector<double> head;       ///< of each node; nan where no head reaches [m]
    std::vector<double> inflow;     ///< into the network at each node [m^3/s]
    std::vector<double> wet_share;  ///< of each triangle, mean relative conductivity of its corners
    int iterations = 0;
    double ramp = 0;      ///< suction at which a joint conducts a half [m]; 0 without a free surface
    double residual = 0;  ///< largest imbalance of a node after the last one, over the inflow
    bool found = false;
};

/// \param transmissivity  of each triangle [m^2/s]
Heads solveHeads(const Network& network, const Conditions& conditions,
                 const std::vector<double>& transmissivity, bool free_surface,
                 const FreeSurface& surface = {});

}  // namespace talus::flow
