#pragma once
// Collects the best repetition of each benchmark and turns them into a table and into JSON.

#include <benchmark/benchmark.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "suite.h"

namespace talus::bench {

/// The best repetition of one benchmark.
struct Best {
    std::string name;  ///< without the threads
    int threads = 1;
    double seconds = 0;  ///< per iteration: processor time with one thread, wall time with several
    double wall = 0;     ///< per iteration, of the same repetition
    std::string label;   ///< state hash and the like
    std::map<std::string, double> counters;

    double counter(const std::string& key) const;  ///< 0 when there is none
};

/// Prints a line per benchmark on stderr while it goes on; keeps the best of each.
class Collector : public benchmark::BenchmarkReporter {
 public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override;

    std::vector<Best> best;
    std::vector<std::string> errors;
};

/// What the machine gave in this run; 0 where it was not measured.
struct Limits {
    double fma = 0, add_mul = 0, root = 0, division = 0;                            ///< [1/s]
    double copy_l2 = 0, triad_l2 = 0, triad_l3 = 0, copy_dram = 0, triad_dram = 0;  ///< [bytes/s]
};
Limits limitsOf(const std::vector<Best>& results, int threads);

/// The limit that binds a benchmark, and how near it came.
struct Binding {
    std::string name;  ///< "FMA", "sqrt", "division", "L2", "L3", "DRAM"
    double share = 0;  ///< 0..1
};
Binding bindingLimit(const Best& result, const Limits& limits);

void printTable(const std::vector<Best>& results, const Extent& extent);
nlohmann::ordered_json toJson(const std::vector<Best>& results, const Extent& extent);

}  // namespace talus::bench
