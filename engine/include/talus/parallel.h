#pragma once
// Threads of a computation: an arena sets their number, the code is the same.

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

namespace talus {

/// Runs `body` with so many threads (0: all cores; 1: the calling thread alone). More threads than cores are
/// possible, too: by default the library would refuse and warn on stderr.
template <class Body>
auto inArena(int threads, const Body& body) {
    if (threads == 1) return body();
    const int wanted = threads > 0 ? threads : tbb::info::default_concurrency();
    std::optional<tbb::global_control> more;
    if (wanted > tbb::info::default_concurrency())
        more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(wanted));
    tbb::task_arena arena(wanted);
    return arena.execute(body);
}

}  // namespace talus
