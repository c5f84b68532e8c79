#pragma once
// A subcommand of the command line. Each is one file that offers one `addX(root)` (commands/commands.h); it
// fills a CLI::App and returns the function that does the work. Only these files include <CLI/CLI.hpp>, which
// takes three seconds to compile.

#include <functional>

#include "cli/common.h"

namespace CLI {
class App;
}

namespace talus::tools {

struct ScenarioInput;

/// A subcommand: its options, and what it does once they are parsed; `execute` returns an exit code.
struct Command {
    CLI::App* app = nullptr;
    std::function<int()> execute;
};

/// Adds SCENARIO and --set to a subcommand that reads a scenario.
void addScenario(CLI::App& app, ScenarioInput& input, bool required = true);

/// Adds --json, --quiet and (where it computes) --threads to a subcommand.
void addCommon(CLI::App& app, Common& common, bool computes = true);

}  // namespace talus::tools
