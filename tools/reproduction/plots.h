#pragma once
// The plots of the reproduction.

#include "report/figures.h"
#include "reproduction/results.h"

namespace talus::tools {

/// Fig. 6 of the paper: critical angle against L/H, laboratory, DEM and theory.
Plot plotFig6(const PaperResults& results);

/// DEM less exact limit for every case of Table 1 and section 5.
Plot plotDifference(const PaperResults& results);

/// Critical angle of the dry slope against the contact points per interface.
Plot plotPoints(const PaperResults& results);

/// Tilt at which a dry column b x h overturns about the outermost points of an N x N grid [rad]. These lie
/// half a cell inside the edge, so tan(beta) = (1 - 1/N) b/h.
double gridOverturning(double b, double h, int n);

}  // namespace talus::tools
