#pragma once
// The stable time step, from the assembled stiffness and inertia: a bound per block, rotation included.

#include <vector>

#include "state/arrays.h"

namespace talus {

/// Upper bound of the square of the highest angular frequency that each block takes part in, with true
/// inertia [1/s^2]; 0 for blocks that are not free. A block that touches nothing gets the bound of its first
/// contact.
///
/// A spring between blocks a and b stores k/2 (delta_a - delta_b)^2 <= k (delta_a^2 + delta_b^2). Let K_a be
/// the 6x6 stiffness of block a with its neighbours held. The assembled stiffness is at most the
/// block-diagonal one with 2 K_a (or K_a for springs against a block that does not move). Hence omega_max^2
/// <= max_a lambda_max(M_a^-1 2 K_a). All contact points count as closed: opening and slipping only soften.
std::vector<double> frequencyBounds(const State& state, bool parallel);

/// The largest of them.
double highestFrequency(const State& state, bool parallel);

/// The median of the free blocks' bounds, the lower one of two [1/s^2]; 0: there are none.
double medianBound(std::vector<double> bounds);

/// Time step for a bound of omega^2 and contact damping c_k = contact * k: central differences with damping
/// taken half a step late are stable for dt <= 2/omega (sqrt(1 + xi^2) - xi), xi = contact omega / 2
/// (Belytschko 1983).
double stableTimeStep(double omega_squared, double contact_damping);
/// Its inverse: the bound of omega^2 that a time step is stable for.
double frequencyOfStep(double time_step, double contact_damping);

}  // namespace talus
