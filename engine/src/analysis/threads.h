#pragma once
// How many threads a computation gets: an arena decides, the code is the same.

#include <tbb/task_arena.h>

#include "state/arrays.h"

namespace talus::analysis {

/// Runs `body` in the calling thread (1), or in an arena of so many threads (0: all cores).
template <class Body>
auto inArena(int threads, const Body& body) {
    if (threads == 1) return body();
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    return arena.execute(body);
}

/// Below some thousand interfaces a step is shorter than the hand-over between threads is worth.
inline bool worthThreads(const State& state, int threads) {
    return threads != 1 && state.interfaces.size() >= 4096;
}

}  // namespace talus::analysis
