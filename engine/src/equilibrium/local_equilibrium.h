#pragma once
// Equilibrium of the few blocks that stall Newton's method, before its next iteration for all blocks.

#include "equilibrium/path_equations.h"

namespace talus::equilibrium {

/// Nonlinear elimination (P. J. Lanzkron, D. J. Rose, J. T. Wilkes, SIAM J. Sci. Comput. 17, 1996; X.-C. Cai,
/// X. Li, SIAM J. Sci. Comput. 33, 2011). A few blocks that begin to slip or lift off have nearly all of the
/// residual, and all corrections are cut back for them. They are solved by themselves with their neighbours,
/// while all others stay, at the step's load and drag. What they then push on the others is elastic, and
/// Newton's method takes it in one iteration.
/// \param residual of the equations at the point
/// \param at, poses  the point; these blocks are moved
/// \return whether they came near equilibrium; else, and where they are not few, nothing is moved
bool settleWorst(const PathEquations& equations, const Arc& arc, const Vec6s& residual, PathStep& at,
                 Poses& poses);

}  // namespace talus::equilibrium
