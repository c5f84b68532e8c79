#include "cli/command.h"

#include <CLI/CLI.hpp>

#include "cli/scenario.h"

namespace talus::tools {

void addScenario(CLI::App& app, ScenarioInput& input, bool required) {
    CLI::Option* scenario =
        app.add_option("SCENARIO", input.path, "Scenario file (TOML); - reads the standard input")
            ->required(required);
    app.add_option("--set", input.sets,
                   "Set a field of the scenario to another value, for instance joint.default.friction_deg=30 "
                   "or 'run.watch=[\"nose\"]'; may be repeated")
        ->type_name("FIELD=VALUE")
        ->allow_extra_args(false)
        ->needs(scenario);
}

void addCommon(CLI::App& app, Common& common, bool computes) {
    app.add_flag("--json", common.json, "Print the result as one JSON object on stdout");
    app.add_flag("--quiet", common.quiet, "No progress and no notes on stderr");
    if (computes)
        app.add_option("--threads", common.threads, "Threads to compute with (0: all cores)")
            ->check(CLI::Range(0, kMostThreads))
            ->capture_default_str();
}

}  // namespace talus::tools
