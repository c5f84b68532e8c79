// talus keyblocks: removable blocks and groups that move together, by block theory.

#include <CLI/CLI.hpp>
#include <memory>

#include "answers/factor_volume.h"
#include "answers/keyblocks_report.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "report/svg.h"
#include "talus/block_theory.h"

namespace talus::tools {

namespace {

struct KeyBlockOptions {
    Common common;
    ScenarioInput scenario;
    KeyBlockSettings settings;
    std::string curve, csv;  ///< files; empty: not written
};

/// Before a computation of up to a minute.
void refuseFiles(const KeyBlockOptions& options) {
    refuseOutput("--curve", options.curve, ".svg");
    refuseOutput("--csv", options.csv, ".csv");
}

void writeFiles(const KeyBlockOptions& options, const KeyBlockResult& result) {
    if (result.factor_volume.empty()) {
        if (!options.curve.empty() || !options.csv.empty())
            note(options.common, "no curve of factor and volume: no group of blocks can move");
        return;
    }
    const std::string name = options.scenario.name();
    if (!options.curve.empty()) writeFile(options.curve, svgFile(factorVolumePlot(result, name), true));
    if (!options.csv.empty())
        writeFile(options.csv, factorVolumeCsv(result, provenanceComments(options.common, name)));
}

int analyse(const KeyBlockOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    requireFreeBlock(scenario);
    refuseFiles(options);
    ProgressPrinter progress(options.common);
    const KeyBlockResult result =
        valueOf(keyBlocks(scenario.model, controlOf(options.common, progress), options.settings), scenario);
    progress.finish();
    writeFiles(options, result);
    if (options.common.json)
        printJson(keyBlocksJson(result, options.common, scenario));
    else
        printResult(keyBlocksText(result, options.scenario.name(), options.settings.most_groups) +
                    warningLines(scenario, result.warnings));
    return result.interrupted ? kInterrupted : kDone;
}

}  // namespace

Command addKeyBlocks(CLI::App& root) {
    constexpr std::size_t kMostGroups = 100'000;
    auto options = std::make_shared<KeyBlockOptions>();
    CLI::App* app = root.add_subcommand(
        "keyblocks", "Removable blocks and groups that move together, by limit equilibrium");
    addScenario(*app, options->scenario);
    app->add_option("--most", options->settings.most_groups,
                    "Number of groups to list, the lowest factors of safety first")
        ->check(CLI::Range(std::size_t{1}, kMostGroups))
        ->capture_default_str();
    app->add_option("--curve", options->curve,
                    "FILE.svg: the least factor of safety of a failure of at least a volume, against it")
        ->type_name("FILE");
    app->add_option("--csv", options->csv, "FILE.csv: all points of that curve, with their blocks")
        ->type_name("FILE");
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus keyblocks slope.toml\n  talus keyblocks slope.toml --most 10 --json | jq "
        "'.moving_groups[0]'\n  talus keyblocks slope.toml --curve curve.svg --csv curve.csv\n\nBlock theory "
        "(Goodman and Shi) for the blocks in their initial position. It counts contacts, water, "
        "loads,\nbolts "
        "with their pretension, the seismic coefficient, friction and cohesion. Each block is first tested "
        "with\nits neighbours fixed. Blocks that obstruct each other are then tested as one body. A body "
        "that "
        "leaves all its\njoints falls and has factor 0; one that cannot move has no factor. The method is "
        "limit "
        "equilibrium of\ntranslations: toppling is not covered.");
    return {app, [options] { return analyse(*options); }};
}

}  // namespace talus::tools
