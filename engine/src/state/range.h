#pragma once
// One range body, serial or parallel: the driver only cuts the range.
//
// TALUS_PLAIN_THREADS: by threads of its own. Debian's TBB is not built for the thread sanitizer, which then
// sees neither its races nor its synchronisation. With plain threads it sees the races of the bodies.

#ifdef TALUS_PLAIN_THREADS
// in place of TBB's loops
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#endif

#include <algorithm>
#include <cstddef>

namespace talus {

struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
};

#ifdef TALUS_PLAIN_THREADS
template <class Body>
void forPieces(std::size_t n, std::size_t grain, const Body& body) {
    // Each takes every fourth piece, at any speed: data of one must not be needed by another in order.
    constexpr std::size_t kThreads = 4;
    const auto work = [&](std::size_t first) {
        for (std::size_t begin = first * grain; begin < n; begin += kThreads * grain) {
            const std::size_t end = std::min(begin + grain, n);
            body(Range{begin, end});
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < kThreads; ++k) threads.emplace_back(work, k);
    for (std::thread& thread : threads) thread.join();
}
#else
template <class Body>
void forPieces(std::size_t n, std::size_t grain, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                      [&](const tbb::blocked_range<std::size_t>& r) {
                          body(Range{r.begin(), r.end()});
                      });
}
#endif

/// Calls body(Range) over [0, n), cut into pieces of about `grain` when `parallel`. Bodies write only slots
/// of their own indices, so the cuts do not affect the result.
template <class Body>
void forRange(std::size_t n, std::size_t grain, bool parallel, const Body& body) {
    if (!parallel || n <= grain)
        body(Range{0, n});
    else
        forPieces(n, grain, body);
}

/// \pre `before` leaves no two equal: then the order is the same however it is cut
template <class Items, class Before>
void sortRange(Items& items, bool parallel, const Before& before) {
#ifndef TALUS_PLAIN_THREADS
    if (parallel) return tbb::parallel_sort(items.begin(), items.end(), before);
#endif
    (void)parallel;
    std::sort(items.begin(), items.end(), before);
}

}  // namespace talus
