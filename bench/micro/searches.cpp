// Searches through the public face of the engine, as a user gets them: critical angles of the paper's cases,
// and and what topples, arches and rock masses take.

#include <cmath>

#include "suite.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/theory.h"

namespace talus::bench {
namespace {

constexpr const char* kPaper[] = {"dry",       "fissure-1",          "fissure-2",
                                  "fissure-3", "fissure-4",          "fissure-5",
                                  "fissure-6", "section5-fissure-7", "section5-fissures-7-10"};

using Search = Result<SearchResult> (*)(const Model&, const Control&, const SearchRules&);
constexpr double kDegrees = 180.0 / M_PI;

/// What is asked of a scenario under bench/, and the unit of its answer.
struct Case {
    const char* scenario;
    Search search;
    double unit;
    const char* unit_name;
};

constexpr Case kCases[] = {{"verification/column-20", criticalAngle, kDegrees, " deg"},
                           {"verification/column-40", criticalAngle, kDegrees, " deg"},
                           {"verification/column-20-3-deep", criticalAngle, kDegrees, " deg"},
                           {"verification/arch-27-1.2m", criticalAngle, kDegrees, " deg"},
                           {"verification/arch-27-1.5m", criticalAngle, kDegrees, " deg"},
                           {"verification/barla-table", criticalAngle, kDegrees, " deg"},
                           {"verification/brick-wall-1", criticalAcceleration, 1, ""},
                           {"verification/brick-wall-2", criticalAcceleration, 1, ""},
                           {"verification/goodman-bray", safetyFactor, 1, ""},
                           {"verification/alejano-alonso", safetyFactor, 1, ""},
                           {"verification/rock-slope-148", safetyFactor, 1, ""},
                           {"examples/rock-slope", safetyFactor, 1, ""},
                           {"verification/random-slope-225", safetyFactor, 1, ""}};

void searchBenchmark(benchmark::State& run, const std::string& file, const Case& asked) {
    const auto scenario = formats::readScenario(file);
    if (!scenario) {
        run.SkipWithError(formats::format(scenario.errors().front()).c_str());
        return;
    }
    SearchResult result;
    for (auto _ : run) {
        auto found = asked.search(scenario->model,
                                  {.threads = 1, .interval = false, .upper_bound = Beside::never}, {});
        if (!found) return run.SkipWithError(found.errors().front().message.c_str());
        result = *found;
    }
    const auto predicted = theory::predict(scenario->model);
    char label[80];
    std::snprintf(label, sizeof label, "%s %.4g%s, %016llx", toString(result.status),
                  result.answer * asked.unit, asked.unit_name,
                  static_cast<unsigned long long>(result.state_hash));
    run.SetLabel(label);
    run.counters["points"] = static_cast<double>(result.contact_points) * static_cast<double>(result.steps);
    run.counters["steps"] = static_cast<double>(result.steps);
    run.counters["factorisations"] = static_cast<double>(result.factors);
    run.counters["loading"] = result.time.loading;
    run.counters["path"] = result.time.path;
    if (asked.search == criticalAngle && predicted)
        run.counters["error"] = (result.answer - predicted->critical_tilt) * kDegrees;
}

}  // namespace

void addSearches(const Extent& extent) {
    constexpr std::int64_t kOnce = 1;
    const auto add_search = [&](const std::string& name, const std::string& scenario, const Case& asked) {
        const std::string file = TALUS_SOURCE_DIR "/bench/" + scenario + ".toml";
        add(
            extent, name, 1, [=](benchmark::State& run) { searchBenchmark(run, file, asked); }, kOnce);
    };
    for (const std::string name : kPaper)
        add_search("critical angle/" + name, "paper/" + name, {nullptr, criticalAngle, kDegrees, " deg"});
    for (const Case& asked : kCases)
        add_search(std::string("search/") + asked.scenario, asked.scenario, asked);
}

}  // namespace talus::bench
