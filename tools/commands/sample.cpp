// talus sample: one run of a sweep as a scenario file of its own.

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "talus/formats/sweep.h"

namespace talus::tools {

namespace {

struct SampleOptions {
    Common common;
    std::string sweep, output;
    std::uint64_t run = 0;
};

std::string headOf(const formats::Sweep& sweep, const formats::SweepRun& run) {
    std::string head = "# Run " + std::to_string(run.index) + " of the sweep " + sweep.path + " (case " +
                       std::to_string(run.case_index) + ", sample " + std::to_string(run.sample) + ", seed " +
                       std::to_string(sweep.seed) + ", identity " + formats::identityOf(sweep) +
                       ").\n#   talus " + sweep.analysis() + " recomputes it.\n";
    for (char& c : head)
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n') c = ' ';
    return head;
}

int writeSample(const SampleOptions& options) {
    if (!options.output.empty()) requireEnding("--output", options.output, {".toml"});
    const formats::Sweep sweep = [&] {
        const EndsAtOnce reading = whileReading(options.sweep, options.common);
        return valueOf(formats::readSweep(options.sweep));
    }();
    if (options.run >= sweep.runs())
        throw BadInput(Error{"RUN", "found " + std::to_string(options.run) + ", allowed: 0 to " +
                                        std::to_string(sweep.runs() - 1)});
    const formats::SweepRun run = formats::runOf(sweep, options.run);
    const std::string scenario = headOf(sweep, run) + valueOf(formats::scenarioTextOf(sweep, run));
    if (!options.output.empty()) writeFile(options.output, scenario);
    if (options.common.json)
        printJson({{"run", run.index},
                   {"output", options.output.empty() ? Json(nullptr) : Json(options.output)},
                   {"scenario", scenario}});
    else if (options.output.empty())
        printText(scenario);
    return kDone;
}

}  // namespace

Command addSample(CLI::App& root) {
    auto options = std::make_shared<SampleOptions>();
    CLI::App* app = root.add_subcommand("sample", "One run of a sweep as a scenario file");
    app->add_option("SWEEP", options->sweep, "Sweep file (TOML)")->required();
    app->add_option("RUN", options->run, "Number of the run, as in results.csv")->required();
    app->add_option("-o,--output", options->output, "Scenario file to write (default: stdout)");
    addCommon(*app, options->common, false);
    app->footer(
        "Example:\n  talus sample bench/sweeps/monte-carlo.toml 17 -o run17.toml\n  talus critical-angle "
        "run17.toml --verbose\n\nThe file gives the same model to the last bit, so its result equals that of "
        "the batch, including the state hash.");
    return {app, [options] { return writeSample(*options); }};
}

}  // namespace talus::tools
