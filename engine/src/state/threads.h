#pragma once
// When several threads save time.

#include "state/arrays.h"
#include "talus/parallel.h"

namespace talus {

/// Below some thousand interfaces a step takes less time than starting it on several threads.
inline bool worthThreads(const State& state, int threads) {
    return threads != 1 && state.interfaces.size() >= 4096;
}

}  // namespace talus
