#include "cli/command.h"

#include <CLI/CLI.hpp>

namespace talus::tools {

void addCommon(CLI::App& app, Common& common, bool computes) {
    app.add_flag("--json", common.json, "Print the result as one JSON object on stdout");
    app.add_flag("--quiet", common.quiet, "No progress and no notes on stderr");
    if (computes)
        app.add_option("--threads", common.threads, "Threads to compute with (0: all cores)")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
}

}  // namespace talus::tools
