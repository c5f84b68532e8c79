#pragma once
// One range body, serial or parallel: the driver only cuts the range.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace talus {

struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Calls body(Range) over [0, n), cut into pieces of about `grain` when `parallel`. Bodies write only slots of their
/// own indices, so that the cuts do not show in the result.
template <class Body>
void forRange(std::size_t n, std::size_t grain, bool parallel, const Body& body) {
    if (!parallel || n <= grain) {
        body(Range{0, n});
        return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                      [&](const tbb::blocked_range<std::size_t>& r) {
                          body(Range{r.begin(), r.end()});
                      });
}

}  // namespace talus
