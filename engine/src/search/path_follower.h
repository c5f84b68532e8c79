#pragma once
// Follows the equilibrium path of a load up to a target or to failure. Failure is the first peak beyond which
// neighbouring blocks part by more than the failure displacement before equilibrium is found again.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "equilibrium/equilibrium_path.h"
#include "search/load_axis.h"
#include "talus/analysis.h"

namespace talus::search {

/// A stable load, and one at which the assembly was found to fail.
struct Bracket {
    double stands = 0, fails = 0;
};

enum class PathResult : std::uint8_t {
    reached,  ///< the target, in equilibrium
    failed,   ///< below it
    lost,     ///< neither is known: Newton's method does not converge
    interrupted
};

/// Results of a path.
struct Followed {
    PathResult result = PathResult::lost;
    Bracket bracket{};  ///< of the failure that counts
    /// For each given displacement: where the path first fails by it; nothing where it does not.
    std::vector<std::optional<Bracket>> by_displacement{};
    /// The last equilibrium below the failure, and the assembly displaced by the failure displacement.
    std::optional<equilibrium::EquilibriumPath::Place> stood{};
    std::optional<State> failing{};
    equilibrium::Parting since{};     ///< from when the displacement of the failure counts
    std::vector<PathPoint> points{};  ///< of the curve of load against displacement
    std::vector<Probe> probes{};      ///< the same, with what each has cost
};

struct Follow {
    double target = 0;
    /// Ascending shares of the median block size; one of them is the failure displacement.
    std::vector<double> displacements{};
    std::size_t counts = 0;  ///< which of them is that
    double rise = 0;         ///< of the load, from which on parting counts anew; 0: SearchRules::rise
    /// Called at the failure that counts. True if it mends that by removing blocks: the path then continues
    /// from its new end.
    std::function<bool(const Followed&)> mends{};
    std::function<void(double load, const char* what)> report{};
};

Followed followPath(equilibrium::EquilibriumPath& path, const LoadAxis& axis, const Follow& follow);

}  // namespace talus::search
