// talus critical-angle, talus safety-factor, and the other searches: a command per entry of talus/searches.h.

#include <CLI/CLI.hpp>
#include <memory>

#include "answers/search.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "talus/limit_analysis.h"

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
           "--keep-run failing.mcap && talus replay failing.mcap -o failing.html\n" + call +
           "--plot curve.svg --picture slope.svg\n\n" + search.details;
}

}  // namespace

Command addSearch(CLI::App& root, const LoadSearch& search) {
    auto options = std::make_shared<SearchOptions>();
    CLI::App* app = root.add_subcommand(search.name, search.about);
    addScenario(*app, options->scenario);
    app->add_flag(
        "--verbose", options->verbose,
        "Also print every step of the path, the motion of every block and the parameters of the search");
    if (search.follows_groups)
        app->add_option("--groups", options->request.groups,
                        "Number of groups of blocks to find that fail one after the other; each group is "
                        "removed before the next is sought")
            ->check(CLI::Range(1, 1000));
    addKeepRun(*app, options->request.keep);
    addSearchFiles(*app, options->request.files);
    const auto beside = [options](Beside wish) {
        return [options, wish] { options->request.upper_bound = wish; };
    };
    CLI::Option* no_bound = app->add_flag_callback("--no-upper-bound,--no-ceiling", beside(Beside::never),
                                                   "Do not compute the upper bound by limit analysis");
    app->add_flag_callback(
           "--upper-bound,--ceiling", beside(Beside::always),
           "Compute the upper bound by limit analysis for models of any size (default: up to " +
               std::to_string(kCeilingPointsInSection) + " contact points in a plane section, " +
               std::to_string(kCeilingPoints) + " in space)")
        ->excludes(no_bound);
    CLI::Option* no_interval = app->add_flag_callback(
        "--no-interval,--no-range", [options] { options->request.interval = false; },
        "Do not search for a lower answer on another loading path");
    app->add_flag_callback(
           "--interval,--range", [options] { options->request.interval = true; },
           "Also search for a lower answer on another loading path (default)")
        ->excludes(no_interval);
    addCommon(*app, options->common);
    app->footer(footerOf(search));
    return {app, [&search, options] { return find(search, *options); }};
}

}  // namespace talus::tools
