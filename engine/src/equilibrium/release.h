#pragma once
// Motion of an assembly at a load without a near equilibrium: released there, it moves against a drag until
// it reaches equilibrium or fails.

#include <cstdint>
#include <functional>

#include "equilibrium/equilibrium_path.h"

namespace talus::equilibrium {

enum class Released : std::uint8_t {
    rests,  ///< in equilibrium at the load; the end of the path is there
    left,   ///< neighbours have parted by more than the given displacement
    lost    ///< neither, within the steps that a release may take
};

/// The same for a load on an assembly that nothing has acted on: at first all joints hold.
Released releaseFromHeldJoints(EquilibriumPath& path, double load, const Parting& since, double leaves,
                               const std::function<bool()>& is_given_up = {});

/// Drag does not affect an equilibrium, and a failing assembly fails under any drag. Equilibrium nearby is
/// tried first. Else blocks slide as one, over a given distance, under the drag that this takes. Where blocks
/// move in many ways, they move in pseudo-time, under a drag that falls as Newton's method converges.
/// \param load    held from now on
/// \param since the moment from which parting counts
/// \param leaves parting of neighbours that counts as failure [median block sizes]
/// \param is_given_up called before each step: then it is lost
Released release(EquilibriumPath& path, double load, const Parting& since, double leaves,
                 const std::function<bool()>& is_given_up = {});

}  // namespace talus::equilibrium
