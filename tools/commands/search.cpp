// talus critical-angle, talus safety-factor, and whatever else can be searched for: a command per entry of
// talus/searches.h.

#include <CLI/CLI.hpp>
#include <memory>

#include "answers/search.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

struct SearchOptions {
    Common common;
    ScenarioInput scenario;
    bool verbose = false;
    SearchRequest request;
};

int find(const LoadSearch& search, const SearchOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    ProgressPrinter progress(options.common);
    const SearchReport report =
        answer(search, scenario, options.request, options.common, controlOf(options.common, progress));
    progress.finish();
    if (options.common.json) {
        printJson(searchJson(report));
    } else {
        printResult(searchText(report, options.verbose));
    }
    return exitCode(report);
}

std::string footerOf(const LoadSearch& search) {
    const std::string call = "  talus " + std::string(search.name) + " slope.toml ";
    return "Example:\n" + call + "--verbose\n" + call + "--json | jq ." + search.answer_key + "\n" + call +
           "--keep-run failing.mcap && talus replay failing.mcap -o failing.html\n\n" + search.details;
}

}  // namespace

Command addSearch(CLI::App& root, const LoadSearch& search) {
    auto options = std::make_shared<SearchOptions>();
    CLI::App* app = root.add_subcommand(search.name, search.about);
    addScenario(*app, options->scenario);
    app->add_flag("--verbose", options->verbose, "Also print every probe and every block's motion");
    if (search.follows_groups)
        app->add_option(
               "--groups", options->request.groups,
               "How many groups of blocks to follow: after the answer the search goes on without those "
               "that have gone, at the cost of a search each")
            ->check(CLI::Range(1, 1000));
    addKeepRun(*app, options->request.keep);
    addCeiling(*app, options->request.ceiling);
    RangeOptions& range = options->request.range;
    CLI::Option* never = app->add_flag("--no-range", range.never, "Try no other loading history");
    app->add_flag("--range", range.always,
                  "Whether the answer depends on the loading history, whatever the size (default: up to " +
                      std::to_string(kMostPointsOfRange) + " contact points)")
        ->excludes(never);
    addCommon(*app, options->common);
    app->footer(footerOf(search));
    return {app, [&search, options] { return find(search, *options); }};
}

}  // namespace talus::tools
