#pragma once
// Heads in a joint network, with the free surface found by pseudo-transient steps.
//
//   begin:  heads of a coarser mesh, or of full joints
//   step:   (dR/dh + S / dt) dh = -R, outlets opened and closed before it
//           (pseudo-transient continuation: Kelley and Keyes 1998, SIAM J. on Numerical Analysis 35, 508)
//   next:   dt grows; where the imbalance grew fourfold it shrinks, and the step is taken again
//           It also shrinks where outlets switch, because long steps may open and close one without end
//
// S is the storage of an unconfined joint, whose water stands higher as its head rises. No answer contains it.
// The storage of a node is proportional to its conductances, so that all nodes change at one rate. The longer
// the steps, the nearer they are to Newton's. If the ramp does not settle at once, wider ones come first.

#include <functional>
#include <vector>

#include "flow/conditions.h"
#include "flow/equations.h"
#include "talus/control.h"

namespace talus::flow {

using Telling = std::function<void(const Progress&)>;  ///< as Control::progress; empty: nobody listens

struct Heads {
    std::vector<double> head;       ///< of each node; nan where no head reaches [m]
    std::vector<double> inflow;     ///< into the network at each node [m^3/s]
    std::vector<double> wet_share;  ///< of each triangle, mean relative conductivity of its corners
    int iterations = 0;
    double ramp = 0;      ///< suction at which a joint conducts a half [m]; 0 without a free surface
    double residual = 0;  ///< largest imbalance of a node after the last one, over the inflow
    bool found = false;
};

/// \param transmissivity  of each triangle, along its sides 0-1, 1-2, 2-0 [m^2/s]
/// \param begin           heads of each node that are near to the answer; empty: those of full joints. Where
///                        they lead nowhere, these are taken, too [m]
Heads solveHeads(const Network& network, const Conditions& conditions,
                 const std::vector<Corners>& transmissivity, bool free_surface,
                 const FreeSurface& surface = {}, const Telling& telling = {},
                 const std::vector<double>& begin = {});

}  // namespace talus::flow
