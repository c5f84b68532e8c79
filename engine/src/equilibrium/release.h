#pragma once
// What an assembly does at a load at which the path has no equilibrium near: released there, it moves against
// a drag until it reaches an equilibrium or has left its place.

#include <cstdint>
#include <limits>

#include "equilibrium/equilibrium_path.h"

namespace talus::equilibrium {

enum class Released : std::uint8_t {
    rests,  ///< in equilibrium at the load; the end of the path is there
    left,   ///< neighbours have parted by more than was asked about
    lost    ///< neither, within the steps that a release may take
};

/// The same for a load on an assembly that nothing has acted on: at first all joints hold.
Released releaseFromHeldJoints(EquilibriumPath& path, double load, const Parting& since, double leaves);

/// Drag plays no part in an equilibrium, and what leaves its place leaves it whatever the drag. Each step is
/// a continuation in the drag, from one that hardly lets blocks move to as little as converges.
/// \param load    held from now on
/// \param since   from when parting counts
/// \param leaves  parting of neighbours that counts as left [median block sizes]
/// \param most_factors  factorisations after which it is lost
Released release(EquilibriumPath& path, double load, const Parting& since, double leaves,
                 std::int64_t most_factors = std::numeric_limits<std::int64_t>::max());

}  // namespace talus::equilibrium
