#pragma once
// The load that a search raises: a tilt, the divisor of strength, a horizontal acceleration; before them
// weight and water.

#include <functional>
#include <string>

#include "equilibrium/path_equations.h"
#include "talus/model.h"
#include "talus/search_rules.h"

namespace talus::search {

/// A load and its steps. Loads of the three searches are in the unit of the answer: [rad], factor, share of
/// the weight.
struct LoadAxis {
    equilibrium::Loading loading{};  ///< its cell is the wanted width of the bracket
    double start = 0;
    double stop = kInfinity;                   ///< the search ends there if nothing has failed
    double longest_step = 0;                   ///< along the path
    bool longest_is_share = false;             ///< of the load
    std::function<std::string(double)> say{};  ///< for progress

    double longest(double load) const { return longest_is_share ? longest_step * load : longest_step; }
};

/// Of a critical angle: the tilt [rad], from the analysis' start to its stop.
LoadAxis tiltAxis(const Model& model, const SearchRules& rules);
/// Of a factor of safety: the divisor of strength. The model must outlive it.
LoadAxis strengthAxis(const Model& model, const SearchRules& rules);
/// Of a critical acceleration: the horizontal seismic coefficient.
LoadAxis accelerationAxis(const Model& model, const SearchRules& rules);

/// The share of weight, earthquake and loads, or of the water, from nothing to all.
/// \param imbalance  out-of-balance force over the weight that a cell of the search amounts to
LoadAxis weightAxis(double imbalance);
LoadAxis waterAxis(double imbalance);

}  // namespace talus::search
