#pragma once
// Newton's method for a step along the path, or of a release.

#include "equilibrium/path_equations.h"

namespace talus::equilibrium {

/// Solves the equations from a guess. Each iteration factorises the exact tangent once and solves two right
/// sides: the residual, and the derivative by the unknown. Steps are cut back until the next correction, with
/// the same factors, is shorter (the natural monotonicity test: P. Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004). A test of the residual alone fails where joints are stiff and slides are not: it stops
/// before contacts that close slightly.
PathStep solveStep(PathEquations& equations, const Arc& arc, PathStep guess);

/// The step that the tangent at the beginning leads to.
/// \param last the step before, for the direction
/// \return not converged, and empty where the matrix is singular
PathStep tangentStep(PathEquations& equations, const Arc& arc, const PathStep& last);

/// The last step once more, as long as the arc.
PathStep secantStep(const PathEquations& equations, const Arc& arc, const PathStep& last);

}  // namespace talus::equilibrium
