#pragma once
// The benchmarks: each file registers its own with Google Benchmark; names are NAME/SLOPE/threads, facts
// travel in counters and in the label.

#include <functional>
#include <string>

#include <benchmark/benchmark.h>

#include "slope.h"

namespace talus::bench {

/// How much is measured.
struct Extent {
    int largest = 1000000;  ///< blocks
    int repetitions = 5;    ///< the best counts
    double seconds = 0.2;   ///< of each repetition, about
    int threads = 1;        ///< all
    std::string only;       ///< regular expression
};

void addMachine(const Extent& extent);
void addSlopes(const Extent& extent);  ///< kernels, step, detection; slope by slope
void addSearches(
    const Extent& extent);  ///< of the paper's cases, and of what topples, arches and rock masses

void addRockfalls(const Extent& extent);  ///< on a plane and on surveys of growing size

/// What a benchmark of a slope says beside its time; counters of the same names.
struct Facts {
    double points = 0;  ///< contact points (or blocks, or pairs) that one iteration works on
    double flops = 0, divisions = 0, roots = 0, bytes = 0;  ///< of one iteration
    double working_set = 0;                                 ///< [bytes]
};
void tell(benchmark::State& run, const Facts& facts);

/// In the calling thread (1), or in an arena of so many.
void onThreads(int threads, const std::function<void()>& body);

/// Registers, with the repetitions and the clock that fit the number of threads: processor time of the thread
/// for one, wall time for several. `iterations` fixes their number; 0 leaves it to the time.
void add(const Extent& extent, const std::string& name, int threads,
         const std::function<void(benchmark::State&)>& body, std::int64_t iterations = 0);

}  // namespace talus::bench
