// talus schema: JSON Schemas of the files that are read.

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/text.h"
#include "commands/commands.h"
#include "schemas/schemas.h"

namespace talus::tools {

Command addSchema(CLI::App& root) {
    CLI::App* app = root.add_subcommand("schema", "JSON Schema of a scenario or a sweep, for editors");
    const auto what = std::make_shared<std::string>("scenario");
    const auto common = std::make_shared<Common>();  // a schema is JSON with --json and without
    addCommon(*app, *common, false);
    app->add_option("FILE", *what, "Kind of file: scenario or sweep")
        ->check(CLI::IsMember({"scenario", "sweep"}))
        ->capture_default_str();
    app->footer(
        "Example:\n  talus schema > talus-scenario.json\n\nEditors with a TOML plugin (Even Better TOML, "
        "taplo, tombi) complete and check the keys of a file if its\nfirst line is\n  #:schema "
        "./talus-scenario.json");
    return {app, [what, common] {
                printText(std::string(*what == "sweep" ? kSweepSchema : kScenarioSchema));
                return 0;
            }};
}

}  // namespace talus::tools
