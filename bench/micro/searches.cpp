// Critical angles of the paper's cases, through the public face of the engine, as a user gets them.

#include <cmath>

#include "suite.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/theory.h"

namespace talus::bench {
namespace {

constexpr const char* kCases[] = {"dry",       "fissure-1",          "fissure-2",
                                  "fissure-3", "fissure-4",          "fissure-5",
                                  "fissure-6", "section5-fissure-7", "section5-fissures-7-10"};

void searchBenchmark(benchmark::State& run, const std::string& file) {
    const auto scenario = formats::readScenario(file);
    if (!scenario) {
        run.SkipWithError(formats::format(scenario.errors().front()).c_str());
        return;
    }
    SearchResult result;
    for (auto _ : run) {
        auto found = criticalAngle(scenario->model);
        if (!found) return run.SkipWithError(found.errors().front().message.c_str());
        result = *found;
    }
    constexpr double kDegrees = 180.0 / M_PI;
    const auto predicted = theory::predict(scenario->model);
    char label[80];
    std::snprintf(label, sizeof label, "%s %.3f deg, %016llx", toString(result.status),
                  result.answer * kDegrees, static_cast<unsigned long long>(result.state_hash));
    run.SetLabel(label);
    run.counters["points"] = static_cast<double>(result.contact_points) * static_cast<double>(result.steps);
    run.counters["steps"] = static_cast<double>(result.steps);
    run.counters["angle"] = result.answer * kDegrees;
    run.counters["error"] = predicted ? (result.answer - predicted->critical_tilt) * kDegrees : std::nan("");
}

}  // namespace

void addSearches(const Extent& extent) {
    constexpr std::int64_t kOnce = 1;
    for (const std::string name : kCases) {
        const std::string file = std::string(TALUS_SOURCE_DIR "/bench/paper/") + name + ".toml";
        add(
            extent, "critical angle/" + name, 1, [=](benchmark::State& run) { searchBenchmark(run, file); },
            kOnce);
    }
}

}  // namespace talus::bench
