#pragma once
// Heads in a joint network, with the free surface found by iteration.
//
//   begin:  heads with the shares of the last iteration, shares moved towards those of the heads
//           (residual flow: Desai and Li 1983, Int. J. for Numerical Methods in Engineering 19)
//   stage:  Newton's method with a line search, outlets opened and closed on the way
//   next:   the same with half the ramp, from the heads of the last stage, down to the narrowest
//
// A stage that does not converge ends it, and the heads of the stage before are the answer: they balance to
// rounding, with a free surface that is smeared over a wider ramp.

#include <vector>

#include "flow/conditions.h"
#include "flow/equations.h"

namespace talus::flow {

struct Heads {
    std::vector<double> head;       ///< of each node; nan where no head reaches [m]
    std::vector<double> inflow;     ///< into the network at each node [m^3/s]
    std::vector<double> wet_share;  ///< of each triangle
    int iterations = 0;
    double ramp = 0;      ///< pressure head over which joints run dry [m]; 0 without a free surface
    double residual = 0;  ///< largest imbalance of a node in the last stage, over the inflow
    bool found = false;
};

/// \param transmissivity  of each triangle [m^2/s]
Heads solveHeads(const Network& network, const Conditions& conditions,
                 const std::vector<double>& transmissivity, bool free_surface,
                 const FreeSurface& surface = {});

}  // namespace talus::flow
