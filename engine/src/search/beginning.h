#pragma once
// The loading path up to where a search begins: every search begins alike, where equilibrium is easy.
//
// Weight and water are brought on level ground with more strength than the assembly has. Strength then falls
// to its own, the ground is tilted, and the pseudo-static earthquake pushes. Each of these loads is followed
// like the one that is searched for, so the three searches agree by construction.

#include <functional>
#include <string>

#include "equilibrium/equilibrium_path.h"
#include "search/load_axis.h"
#include "search/path_follower.h"

namespace talus::search {

/// Where a search begins.
struct Start {
    double tilt = 0;        ///< [rad]
    double horizontal = 0;  ///< k_h of the pseudo-static earthquake
    double factor = 1;      ///< that strengths are divided by where it begins
    bool weakens =
        true;  ///< to that, after weight and water; else it begins with the strength under which they were
               ///< applied
    LoadAxis strength{};
    double imbalance = 0;  ///< out-of-balance force over the weight that a cell of the search amounts to
    std::vector<double> displacements{};  ///< as in Follow
    std::size_t counts = 0;
    double rise = 0;  ///< over the weight, from which on parting counts anew; 0: SearchRules::rise
    std::function<bool(const Followed&)> mends{};
    std::function<void(const std::string&)> report = [](const std::string&) {};
    /// Called in equilibrium under weight alone. \return whether it has changed something: then equilibrium
    /// is found anew
    std::function<bool(equilibrium::EquilibriumPath&)> weighted{};
};

/// How the loading path ended.
struct Begun {
    PathResult result = PathResult::lost;
    double parted = 0;  ///< of neighbours under the weight, less elastic displacement [median block sizes]
    double factor = 1;  ///< that strengths are divided by in the end
    const char* stage = "weight";
    Followed followed{};  ///< the last piece of the path, in shares of its load
};

/// \param path  as built: nothing acts on it yet
Begun bringToStart(equilibrium::EquilibriumPath& path, const Model& model, const Start& start);

}  // namespace talus::search
