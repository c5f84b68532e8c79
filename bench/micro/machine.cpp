// The machine's limits: bandwidths and rates, one thread and all.

#include <tbb/parallel_for.h>

#include <vector>

#include "process.h"
#include "rates.h"
#include "simd/instruction_set.h"
#include "suite.h"

namespace talus::bench {
namespace {

constexpr double kAlive = 1e-300;

const Rates& rates() {
    using simd::InstructionSet, simd::isAvailable;
    static const Rates best = isAvailable(InstructionSet::avx512) ? avx512Rates()
                              : isAvailable(InstructionSet::avx2) && __builtin_cpu_supports("fma")
                                  ? avx2Rates()
                                  : plainRates();
    return best;
}

/// One task per thread, each on its own part.
void onEach(int threads, const std::function<void(int)>& body) {
    if (threads == 1) return body(0);
    onThreads(threads, [&] {
        tbb::parallel_for(
            tbb::blocked_range<int>(0, threads, 1),
            [&](const tbb::blocked_range<int>& part) { body(part.begin()); }, tbb::simple_partitioner());
    });
}

/// `rate` is what one iteration of one thread amounts to.
void addRate(const Extent& extent, const std::string& name, double per_iteration,
             const std::function<double()>& work) {
    for (const int threads : {1, extent.threads}) {
        if (threads == 1 || extent.threads > 1)
            add(extent, "machine/" + name, threads, [=](benchmark::State& run) {
                for (auto _ : run) onEach(threads, [&](int) { benchmark::DoNotOptimize(work() + kAlive); });
                run.counters["rate"] = threads * per_iteration;
            });
        if (extent.threads == 1) return;
    }
}

/// Three arrays per thread, together `bytes`; long enough passes that a task's start does not show.
void addStream(const Extent& extent, const std::string& level, double bytes) {
    const auto n = static_cast<std::size_t>(bytes / 3 / sizeof(double)) / 8 * 8;
    const int passes = std::max(1, static_cast<int>(4e7 / bytes));
    for (const bool triad : {false, true})
        for (const int threads : {1, extent.threads}) {
            const int arrays = triad ? 3 : 2;
            add(extent, std::string("machine/") + (triad ? "triad " : "copy ") + level, threads,
                [=](benchmark::State& run) {
                    std::vector<std::vector<double>> a(threads), b(threads), c(threads);
                    onEach(threads, [&](int t) { a[t].assign(n, 1), b[t].assign(n, 2), c[t].assign(n, 3); });
                    for (auto _ : run)
                        onEach(threads, [&](int t) {
                            for (int pass = 0; pass < passes; ++pass)
                                triad ? rates().triad(a[t].data(), b[t].data(), c[t].data(), n, 0.5)
                                      : rates().copy(a[t].data(), b[t].data(), n);
                        });
                    benchmark::DoNotOptimize(a[0][n / 2]);
                    run.counters["rate"] =
                        threads * static_cast<double>(n * arrays * sizeof(double)) * passes;
                });
            if (extent.threads == 1) break;
        }
}

}  // namespace

void addMachine(const Extent& extent) {
    constexpr std::size_t kRounds = 20000;
    const double flops = static_cast<double>(kRounds) * rates().flops_per_round;
    const double roots = static_cast<double>(kRounds) * rates().roots_per_round;
    addRate(extent, "fma", flops, [] { return rates().fma(kRounds); });
    addRate(extent, "add and multiply", flops, [] { return rates().add_mul(kRounds); });
    addRate(extent, "sqrt", roots, [] { return rates().root(kRounds); });
    addRate(extent, "division", roots, [] { return rates().division(kRounds); });
    const Caches cache = caches();
    addStream(extent, "L2", 0.5 * cache.level2);
    addStream(extent, "L3", std::min(0.25 * cache.level3, 8.0 * cache.level2));
    addStream(extent, "DRAM", std::max(2e8, 4.0 * cache.level3));
}

}  // namespace talus::bench
