// talus-bench: how fast the engine is, beside what the machine can do, in one run.

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <regex>
#include <thread>

#include "process.h"
#include "report.h"

namespace {

using namespace talus::bench;

constexpr int kBadUsage = 2, kFailed = 1, kFileRefused = 4;

/// Regular expressions throw; here they are the user's input.
std::string checkExpression(const std::string& text) {
    try {
        const std::regex expression(text);
    } catch (const std::regex_error& error) {
        return error.what();
    }
    return {};
}

void registerAll(const Extent& extent) {
    addMachine(extent);
    addSlopes(extent);
    addSearches(extent);
    addRockfalls(extent);
}

/// Machine limits belong to every table, so `--only` leaves them in.
std::string filterOf(const std::string& only) { return only.empty() ? "." : "^machine/|" + only; }

int runAll(const Extent& extent, const std::string& json_file) {
    std::ofstream json;
    if (!json_file.empty()) {
        json.open(json_file);
        if (!json) {
            std::cerr << "talus-bench: cannot write " << json_file << "\n";
            return kFileRefused;
        }
    }
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector, filterOf(extent.only));
    printTable(collector.best, extent);
    if (json.is_open()) json << toJson(collector.best, extent).dump(2) << "\n";
    for (const std::string& error : collector.errors) std::cerr << "talus-bench: " << error << "\n";
    if (!json_file.empty() && !json.flush()) return kFileRefused;
    return collector.errors.empty() ? 0 : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "How fast Talus is, beside what this machine can do.\n\n"
        "Example: talus-bench --quick --only 'step/vertex' --json speed.json\n"};
    Extent extent;
    extent.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    bool quick = false;
    std::string json_file;
    app.add_option("--only", extent.only,
                   "run benchmarks whose name matches this regular expression, and the machine's")
        ->check(checkExpression);
    app.add_flag("--quick", quick, "up to 10,000 blocks, fewer repetitions: some 30 seconds");
    app.add_option("--json", json_file, "write the results to this file as well");
    app.add_option("--threads", extent.threads, "of the parallel rows; default all")
        ->check(CLI::Range(1, 1024));
    app.add_option("--repetitions", extent.repetitions, "of each benchmark; the best counts")
        ->check(CLI::Range(1, 1000));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kBadUsage;
    }
    if (quick) {
        extent.largest = 10000;
        extent.seconds = 0.03;
        if (app.count("--repetitions") == 0) extent.repetitions = 3;
    }
    registerAll(extent);
    return runAll(extent, json_file);
}
