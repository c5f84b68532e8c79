#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "process.h"
#include "talus/build_info.h"

namespace talus::bench {
namespace {

const Best* find(const std::vector<Best>& results, const std::string& name, int threads) {
    const auto found = std::find_if(results.begin(), results.end(),
                                    [&](const Best& b) { return b.name == name && b.threads == threads; });
    return found == results.end() ? nullptr : &*found;
}

double rateOf(const std::vector<Best>& results, const std::string& name, int threads) {
    const Best* best = find(results, "machine/" + name, threads);
    return best ? best->counter("rate") / best->seconds : 0.0;
}

/// "step/vertex/105/threads:1" -> the name before "/threads:", and the number behind it.
Best bestOf(const benchmark::BenchmarkReporter::Run& run) {
    Best best;
    const std::string name = run.run_name.function_name;
    const std::size_t at = name.rfind("/threads:");
    best.name = name.substr(0, at);
    best.threads = std::stoi(name.substr(at + 9));
    const double iterations = static_cast<double>(std::max<std::int64_t>(1, run.iterations));
    best.wall = run.real_accumulated_time / iterations;
    best.seconds = best.threads > 1 ? best.wall : run.cpu_accumulated_time / iterations;
    best.label = run.report_label;
    for (const auto& [key, counter] : run.counters) best.counters[key] = counter.value;
    return best;
}

}  // namespace

double Best::counter(const std::string& key) const {
    const auto found = counters.find(key);
    return found == counters.end() ? 0.0 : found->second;
}

void Collector::ReportRuns(const std::vector<Run>& runs) {
    for (const Run& run : runs) {
        if (run.error_occurred) {
            errors.push_back(run.run_name.function_name + ": " + run.error_message);
            continue;
        }
        if (run.run_type != Run::RT_Iteration) continue;
        Best now = bestOf(run);
        const auto same = std::find_if(best.begin(), best.end(), [&](const Best& b) {
            return b.name == now.name && b.threads == now.threads;
        });
        if (same == best.end()) {
            std::fprintf(stderr, "%-44s %d thread%s\n", now.name.c_str(), now.threads,
                         now.threads > 1 ? "s" : "");
            best.push_back(std::move(now));
        } else if (now.seconds < same->seconds) {
            *same = std::move(now);
        }
    }
}

Limits limitsOf(const std::vector<Best>& results, int threads) {
    const auto rate = [&](const char* name) { return rateOf(results, name, threads); };
    return {.fma = rate("fma"),
            .add_mul = rate("add and multiply"),
            .root = rate("sqrt"),
            .division = rate("division"),
            .copy_l2 = rate("copy L2"),
            .triad_l2 = rate("triad L2"),
            .triad_l3 = rate("triad L3"),
            .copy_dram = rate("copy DRAM"),
            .triad_dram = rate("triad DRAM")};
}

Binding bindingLimit(const Best& result, const Limits& limits) {
    const Caches cache = caches();
    const double set = result.counter("working_set");
    // A core reaches its own L2; several have theirs side by side.
    const bool in_l2 = set < cache.level2 * result.threads, in_l3 = set < cache.level3;
    const double bandwidth = in_l2 ? limits.triad_l2 : in_l3 ? limits.triad_l3 : limits.triad_dram;
    struct Need {
        const char* name;
        double amount, rate;
    };
    Binding binding;
    for (const Need& need : {Need{"FMA", result.counter("flops"), limits.fma},
                             Need{"sqrt", result.counter("roots"), limits.root},
                             Need{"division", result.counter("divisions"), limits.division},
                             Need{in_l2   ? "L2"
                                  : in_l3 ? "L3"
                                          : "DRAM",
                                  result.counter("bytes"), bandwidth}}) {
        if (need.rate <= 0) continue;
        const double share = need.amount / need.rate / result.seconds;
        if (share > binding.share) binding = {need.name, share};
    }
    return binding;
}

nlohmann::ordered_json toJson(const std::vector<Best>& results, const Extent& extent) {
    using Json = nlohmann::ordered_json;
    const BuildInfo& build = buildInfo();
    Json json{{"processor", processorName()},
              {"threads", extent.threads},
              {"version", build.version},
              {"commit", build.git_hash},
              {"compiler", build.compiler},
              {"instruction_set", build.instruction_set},
              {"repetitions", extent.repetitions},
              {"clock", "best repetition; processor time with one thread, wall time with several"},
              {"results", Json::array()}};
    for (const Best& result : results) {
        Json row{{"name", result.name},
                 {"threads", result.threads},
                 {"seconds", result.seconds},
                 {"wall_seconds", result.wall},
                 {"label", result.label}};
        const double points = result.counter("points");
        if (points > 0) row["ns_per_point"] = 1e9 * result.seconds / points;
        const Binding binding = bindingLimit(result, limitsOf(results, result.threads));
        if (binding.share > 0) row["limit"] = {{"name", binding.name}, {"share", binding.share}};
        if (const Best* one = find(results, result.name, 1); one && result.threads > 1)
            row["speed_up"] = one->wall / result.seconds;
        for (const auto& [key, value] : result.counters)
            if (std::isfinite(value)) row[key] = value;
        json["results"].push_back(std::move(row));
    }
    return json;
}

}  // namespace talus::bench
