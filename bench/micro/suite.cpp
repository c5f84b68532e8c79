#include "suite.h"

#include <tbb/task_arena.h>

#include <regex>

namespace talus::bench {

bool Extent::matches(const std::string& benchmark) const {
    return std::regex_search(benchmark, std::regex(only));
}

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

benchmark::internal::Benchmark* add(const Extent& extent, const std::string& name, int threads,
                                    const std::function<void(benchmark::State&)>& body) {
    const std::string full = name + "/threads:" + std::to_string(threads);
    auto* added = benchmark::RegisterBenchmark(full.c_str(), body);
    added->Repetitions(extent.repetitions)->MinTime(extent.seconds)->Unit(benchmark::kNanosecond);
    if (threads > 1) added->UseRealTime();
    return added;
}

}  // namespace talus::bench
