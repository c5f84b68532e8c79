#pragma once
// Limit equilibrium of blocks that slide as one body, by block theory: the load at which the weakest such
// group has a factor of safety of 1, and whether any block can leave at all.

#include <optional>
#include <string>

#include "search/load_axis.h"
#include "talus/analysis.h"

namespace talus::search {

/// What a search asks of block theory.
struct LimitQuestion {
    const Model& model;
    Varied varied;
    double least_mass;       ///< of a group that can be an answer [kg]
    const Control& control;  ///< its progress is reported by the search
};

/// The least factor of safety, or the least tilt or horizontal acceleration at which some group has the
/// factor 1. Nothing where no group slides, or where one slides at the start of the axis already.
/// \param answer  of the search: where to look first
std::optional<LimitEquilibrium> limitEquilibriumOf(const LimitQuestion& question, const LoadAxis& axis,
                                                   double answer);

/// Why the model cannot slide at a load, whatever its strength. Nothing where some block can.
std::optional<std::string> nothingCanSlide(const LimitQuestion& question, double load);

}  // namespace talus::search
