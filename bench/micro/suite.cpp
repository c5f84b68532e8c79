#include "suite.h"

#include <tbb/task_arena.h>

namespace talus::bench {

void tell(benchmark::State& run, const Facts& facts) {
    run.counters["points"] = facts.points;
    run.counters["flops"] = facts.flops;
    run.counters["divisions"] = facts.divisions;
    run.counters["roots"] = facts.roots;
    run.counters["bytes"] = facts.bytes;
    run.counters["working_set"] = facts.working_set;
}

void onThreads(int threads, const std::function<void()>& body) {
    if (threads == 1) return body();
    tbb::task_arena arena(threads);
    arena.execute(body);
}

void add(const Extent& extent, const std::string& name, int threads,
         const std::function<void(benchmark::State&)>& body, std::int64_t iterations) {
    const std::string full = name + "/threads:" + std::to_string(threads);
    auto* added = benchmark::RegisterBenchmark(full.c_str(), body);
    added->Repetitions(extent.repetitions)->Unit(benchmark::kNanosecond);
    if (iterations > 0)
        added->Iterations(iterations);
    else
        added->MinTime(extent.seconds);
    if (threads > 1) added->UseRealTime();
}

}  // namespace talus::bench
