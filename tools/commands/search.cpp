// talus critical-angle, talus safety-factor, and whatever else can be searched for: a command per entry of
// talus/searches.h.

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/ceiling.h"
#include "commands/commands.h"
#include "commands/search_report.h"

namespace talus::tools {

namespace {

struct SearchOptions {
    Common common;
    std::string scenario;
    bool verbose = false;
    int groups = 1;
    KeepRunOptions keep;
    CeilingOptions ceiling;
    bool always_range = false, no_range = false;
};

/// Contact points of models whose searches also try another loading history; as much again as a search.
constexpr std::size_t kMostPointsOfRange = 1000;

std::size_t mostPointsOfRange(const SearchOptions& options) {
    if (options.no_range) return 0;
    return options.always_range ? std::numeric_limits<std::size_t>::max() : kMostPointsOfRange;
}

/// Of what the answer is for: without the blocks that fall at the start.
Ceiling ceilingOf(const formats::Scenario& scenario, Varied load, const CeilingOptions& options,
                  const SearchResult& result, const Control& control) {
    if (result.fallen_at_start.empty()) return findCeiling(scenario, load, options, result, control);
    formats::Scenario rest = scenario;
    rest.model = withoutBlocks(scenario.model, result.fallen_at_start);
    return findCeiling(rest, load, options, result, control);
}

int find(const LoadSearch& search, const SearchOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    FailureKeeper keeper(options.keep, options.common, scenario);
    ProgressPrinter progress(options.common);
    Control control = controlOf(options.common, progress);
    control.keep_failing_state = keeper.wanted();
    control.groups = options.groups;
    control.most_points_of_range = mostPointsOfRange(options);
    SearchResult result = valueOf(search.find(scenario.model, control, {}), scenario);
    const Ceiling ceiling = ceilingOf(scenario, search.load->varied, options.ceiling, result, control);
    holdUnder(ceiling, search.load->varied, result);
    SearchReport report{options.common, scenario, search, result, search.theory(scenario.model), ceiling};
    if (keeper.wanted()) report.kept = keeper.keep(result, search, control);
    progress.finish();
    if (options.common.json) {
        printJson(searchJson(report));
    } else {
        printText(searchText(report, options.verbose));
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
    app->add_option("SCENARIO", options->scenario, "Scenario file (TOML)")->required();
    app->add_flag("--verbose", options->verbose, "Also print every probe and every block's motion");
    if (search.follows_groups)
        app->add_option(
               "--groups", options->groups,
               "How many groups of blocks to follow: after the answer the search goes on without those "
               "that have gone, at the cost of a search each")
            ->check(CLI::Range(1, 1000));
    addKeepRun(*app, options->keep);
    addCeiling(*app, options->ceiling);
    CLI::Option* never = app->add_flag("--no-range", options->no_range, "Try no other loading history");
    app->add_flag("--range", options->always_range,
                  "Whether the answer depends on the loading history, whatever the size (default: up to " +
                      std::to_string(kMostPointsOfRange) + " contact points)")
        ->excludes(never);
    addCommon(*app, options->common);
    app->footer(footerOf(search));
    return {app, [&search, options] { return find(search, *options); }};
}

}  // namespace talus::tools
