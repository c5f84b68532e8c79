// talus storm: the factor of safety over a rain.

#include <CLI/CLI.hpp>
#include <memory>

#include "answers/storm.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

struct StormOptions {
    Common common;
    ScenarioInput scenario;
    StormRequest request;
};

int compute(const StormOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    ProgressPrinter progress(options.common);
    const StormResult result =
        stormOf(scenario, options.request, options.common, controlOf(options.common, progress));
    progress.finish();
    if (options.common.json)
        printJson(stormJson(result, scenario, options.common));
    else
        printResult(stormText(result, scenario));
    return exitCode(result);
}

}  // namespace

Command addStorm(CLI::App& root) {
    constexpr double kLongest = 1e9;  // [s] as of a history: some thirty years
    auto options = std::make_shared<StormOptions>();
    StormRequest& request = options->request;
    CLI::App* app = root.add_subcommand("storm", "Factor of safety over a rain");
    addScenario(*app, options->scenario);
    app->add_option("--step-s", request.settings.step,
                    "Time between two factors of safety; times of tables come between [s]")
        ->check(CLI::Range(1e-3, kLongest))
        ->capture_default_str();
    app->add_option(
           "--duration-s", request.settings.duration,
           "End of the storm [s] (default: the end of the tables of rain, inflow, levels and strength)")
        ->check(CLI::Range(1e-3, kLongest));
    app->add_option("--plot", request.plot,
                    "FILE.svg: factor of safety and water level, or strength, over time")
        ->type_name("FILE");
    app->add_option("--csv", request.csv, "FILE.csv: a row for each time")->type_name("FILE");
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus storm slope.toml --step-s 600\n  talus storm slope.toml --plot storm.svg --csv "
        "storm.csv\n  talus storm slope.toml --json | jq .least.safety_factor\n\nLevels follow from rain, "
        "inflow, leak and overflow of closed volumes, and from tables of levels, with the walls\nfixed as "
        "built; strengths follow from strength_over_time of joints. For each level and strength the factor "
        "of\n"
        "safety is searched, with both held constant. If a single level or strength changes, factors "
        "between\n"
        "searches are interpolated where the error is below analysis.factor_tolerance.\n\nA factor below 1 "
        "is a result (exit code 0). An undecided one is not "
        "(exit code 3).");
    return {app, [options] { return compute(*options); }};
}

}  // namespace talus::tools
