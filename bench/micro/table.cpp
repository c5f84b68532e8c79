// The table at the end of a run.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "process.h"
#include "report.h"
#include "talus/build_info.h"

namespace talus::bench {
namespace {

std::string text(const char* format, double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

const Best* singleThread(const std::vector<Best>& results, const std::string& name) {
    for (const Best& result : results)
        if (result.name == name && result.threads == 1) return &result;
    return nullptr;
}

void printHead(const Extent& extent) {
    const BuildInfo& build = buildInfo();
    std::printf("talus %s (%s, %s, %s), %s, %d threads\n", build.version.c_str(), build.git_hash.c_str(),
                build.compiler.c_str(), build.instruction_set.c_str(), processorName().c_str(),
                extent.threads);
    std::printf(
        "Best of %d repetitions. One thread: processor time. Several: wall time, right on an idle machine "
        "only.\n",
        extent.repetitions);
}

void printMachine(const std::vector<Best>& results, int all) {
    const Limits one = limitsOf(results, 1), many = limitsOf(results, all);
    if (one.fma + one.triad_l2 <= 0) return;
    std::printf("\n%-28s %14s %14s %8s\n", "The machine", "one thread", "all threads", "ratio");
    const auto line = [](const char* name, double a, double b, const char* unit) {
        if (a <= 0) return;
        std::printf("%-28s %9.2f %-4s %9.2f %-4s %8s\n", name, a * 1e-9, unit, b * 1e-9, unit,
                    b > 0 ? text("%.2f", b / a).c_str() : "-");
    };
    line("double FMA", one.fma, many.fma, "GF/s");
    line("double add and multiply", one.add_mul, many.add_mul, "GF/s");
    line("square roots", one.root, many.root, "G/s");
    line("divisions", one.division, many.division, "G/s");
    line("copy, in L2", one.copy_l2, many.copy_l2, "GB/s");
    line("triad, in L2", one.triad_l2, many.triad_l2, "GB/s");
    line("triad, in L3", one.triad_l3, many.triad_l3, "GB/s");
    line("copy, DRAM", one.copy_dram, many.copy_dram, "GB/s");
    line("triad, DRAM", one.triad_dram, many.triad_dram, "GB/s");
}

/// Stages and steps: per contact point and step; neighbours and interfaces: per block.
void printSlopes(const std::vector<Best>& results) {
    bool head = false;
    for (const Best& result : results) {
        const double points = result.counter("points");
        if (points <= 0 || result.counter("flops") <= 0) continue;
        if (!head)
            std::printf("\n%-34s %7s %9s %9s %9s %16s %9s  %s\n", "Stage/points/blocks", "threads",
                        "ns per Lp", "flops/Lp", "bytes/Lp", "of the limit", "speed-up", "state hash");
        head = true;
        const Binding binding = bindingLimit(result, limitsOf(results, result.threads));
        const Best* one = singleThread(results, result.name);
        std::printf("%-34s %7d %9.2f %9.1f %9.1f %5.0f %% %-8s %9s  %s\n", result.name.c_str(),
                    result.threads, 1e9 * result.seconds / points, result.counter("flops") / points,
                    result.counter("bytes") / points, 100 * binding.share, binding.name.c_str(),
                    result.threads > 1 && one ? text("%.2f", one->wall / result.seconds).c_str() : "",
                    result.label.c_str());
    }
}

void printDetection(const std::vector<Best>& results) {
    bool head = false;
    for (const Best& result : results) {
        if (result.name.rfind("neighbours", 0) != 0 && result.name.rfind("interfaces", 0) != 0) continue;
        if (!head) std::printf("\n%-34s %7s %13s %9s\n", "Search", "threads", "ns per block", "speed-up");
        head = true;
        const Best* one = singleThread(results, result.name);
        std::printf("%-34s %7d %13.0f %9s\n", result.name.c_str(), result.threads,
                    1e9 * result.seconds / result.counter("points"),
                    result.threads > 1 && one ? text("%.2f", one->wall / result.seconds).c_str() : "");
    }
}

void printMemory(const std::vector<Best>& results) {
    bool head = false;
    for (const Best& result : results) {
        if (result.threads != 1 || result.counter("state_bytes") <= 0 || result.counter("blocks") < 1000)
            continue;
        if (!head)
            std::printf("\n%-34s %16s %14s %10s %14s\n", "Built from nothing", "state, per block",
                        "peak, in all", "wall time", "processor time");
        head = true;
        std::printf(
            "%-34s %14.0f B %11.0f MB %8.2f s %12.2f s\n", result.name.c_str(),
            result.counter("state_bytes") / result.counter("blocks"), 1e-6 * result.counter("peak_bytes"),
            result.counter("model_seconds") + result.counter("build_seconds"), result.counter("build_cpu"));
    }
}

void printSearches(const std::vector<Best>& results) {
    bool head = false;
    for (const Best& result : results) {
        if (result.name.rfind("critical angle/", 0) != 0) continue;
        if (!head)
            std::printf("\n%-38s %14s %10s %10s %10s  %s\n", "Critical angle, bracket 0.01 deg",
                        "processor time", "steps", "ns per Lp", "error", "answer, state hash");
        head = true;
        std::printf("%-38s %12.3f s %10.0f %10.2f %+10.3f  %s\n", result.name.c_str(), result.seconds,
                    result.counter("steps"), 1e9 * result.seconds / result.counter("points"),
                    result.counter("error"), result.label.c_str());
    }
}

/// Explicit and implicit work of each search, side by side.
void printWork(const std::vector<Best>& results) {
    bool head = false;
    for (const Best& result : results) {
        if (result.counter("steps") <= 0) continue;
        if (!head)
            std::printf("\n%-38s %10s %16s %16s %16s  %s\n", "Searches", "processor", "explicit steps",
                        "factorisations", "failures let go", "answer, state hash");
        head = true;
        std::printf("%-38s %8.2f s %9.0f %4.2f s %9.0f %4.2f s %9s %4.2f s  %s\n", result.name.c_str(),
                    result.seconds, result.counter("steps"), result.counter("stepping"),
                    result.counter("factorisations"), result.counter("solving"), "",
                    result.counter("watching"), result.label.c_str());
    }
}

/// On a survey a step should cost what it costs on the plane, the first row.
void printRockfalls(const std::vector<Best>& results) {
    const Best* plane = nullptr;
    for (const Best& result : results) {
        const double steps = result.counter("run_steps");
        if (steps <= 0) continue;
        if (plane == nullptr) {
            plane = &result;
            std::printf("\n%-28s %10s %12s %12s %14s %14s  %s\n", "Rockfall on triangles", "steps",
                        "us per step", "of the first", "ground's shape", "until step 1", "state hash");
        }
        const double step = result.seconds / steps, first = plane->seconds / plane->counter("run_steps");
        std::printf("%-28s %10.0f %12.2f %12.2f %12.2f s %12.2f s  %s\n", result.name.c_str(), steps,
                    1e6 * step, step / first, result.counter("ground_seconds"),
                    result.counter("start_seconds"), result.label.c_str());
    }
}

/// Wall time far above processor time in the single-threaded runs: something else had the cores.
void warnIfBusy(const std::vector<Best>& results) {
    double wall = 0, processor = 0;
    for (const Best& result : results)
        if (result.threads == 1) wall += result.wall, processor += result.seconds;
    if (processor > 0 && wall > 1.1 * processor)
        std::printf(
            "\nThe machine was busy (wall time %.2f times processor time): rows with several threads are not "
            "valid.\n",
            wall / processor);
}

}  // namespace

void printTable(const std::vector<Best>& results, const Extent& extent) {
    printHead(extent);
    printMachine(results, extent.threads);
    printSlopes(results);
    printDetection(results);
    printMemory(results);
    printSearches(results);
    printWork(results);
    printRockfalls(results);
    warnIfBusy(results);
}

}  // namespace talus::bench
