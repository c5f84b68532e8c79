#pragma once
// When several threads are worth their while.

#include "state/arrays.h"
#include "talus/parallel.h"

namespace talus {

/// Below some thousand interfaces a step is shorter than the hand-over between threads is worth.
inline bool worthThreads(const State& state, int threads) {
    return threads != 1 && state.interfaces.size() >= 4096;
}

}  // namespace talus
