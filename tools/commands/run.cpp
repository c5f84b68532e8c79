// talus run: time history of a scenario, new or resumed.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "answers/run_report.h"
#include "answers/support_report.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "report/page.h"

namespace talus::tools {

namespace {

std::string triple(const Vec3& value, int decimals) {
    return "(" + text(value.x(), decimals) + ", " + text(value.y(), decimals) + ", " +
           text(value.z(), decimals) + ")";
}

const char* describe(InitialState start) {
    switch (start) {
        case InitialState::equilibrium:
            return "starts in equilibrium under weight and water\n";
        case InitialState::held:
            return "no equilibrium at the start: joints have unlimited strength until time 0, then their "
                   "own\n";
        case InitialState::unstressed:
            break;
    }
    return "starts unstressed: weight and water are applied at once\n";
}

/// Which water drains, and when: in rock masses also by default.
std::string drainsText(const Model& model) {
    std::string lines;
    const auto add = [&](const std::string& field, double aperture) {
        char figure[32];
        std::snprintf(figure, sizeof figure, "%.4g", aperture);
        if (aperture < kInfinity)
            lines +=
                field + ": drains from joints that open wider than " + figure + " m (drains_at_aperture)\n";
    };
    for (const Water& water : model.waters) add(water.field, water.drains_at_aperture);
    if (model.phreatic) add(model.phreatic->field, model.phreatic->drains_at_aperture);
    return lines;
}

std::string toText(const RunOptions& options, const formats::Scenario& scenario, const RunResult& result,
                   const RunRecorder& recorder) {
    const std::string name = options.resume.empty() ? options.scenario.name() : options.resume;
    if (!result.began) {
        return name + ": interrupted before the run began" + (options.resume.empty() ? ", " : " again, ") +
               text(result.wall_seconds, 2) + " s; nothing more is written\n";
    }
    std::string lines =
        name + ": " + (result.interrupted ? "interrupted after " : "") + text(result.simulated_seconds, 6) +
        " s simulated in " + std::to_string(result.steps) + " steps of " + text(result.time_step * 1e6, 4) +
        " us, " + text(result.wall_seconds, 2) + " s\n" + std::to_string(result.blocks) + " blocks, " +
        std::to_string(result.interfaces) + " interfaces, " + std::to_string(result.contact_points) +
        " contact points\n" + "kinetic energy " + text(result.kinetic_energy, 9) + " J, state hash " +
        hashText(result.state_hash) + "\n";
    if (options.resume.empty()) lines += describe(result.start);
    lines += drainsText(scenario.model);
    for (const BlockReport& block : result.watch)
        lines += block.name + ": at " + triple(block.position, 6) + " m, velocity " +
                 triple(block.velocity, 6) + " m/s, moved " + text(block.displacement.norm(), 9) +
                 " m, turned " + text(degrees(block.rotation), 5) + " deg\n";
    const std::size_t farthest = farthestBlock(result);
    lines += "moved farthest: " + scenario.model.blocks[farthest].name + ", by " +
             text(result.displacements[farthest].norm(), 9) + " m\n";
    for (const SupportTexts& kind : supportTexts(result.supports))
        for (const std::string& line : kind.lines) lines += kind.kind + ": " + line + "\n";
    for (const WaterReport& water : result.waters)
        lines += water.name + ": level " + text(water.level, 6) + " m, volume " + text(water.volume, 9) +
                 " m3" + (water.run_over > 0 ? ", " + text(water.run_over, 9) + " m3 have run over" : "") +
                 (water.leaked > 0 ? ", " + text(water.leaked, 9) + " m3 have leaked" : "") + "\n";
    return lines + warningLines(scenario, result.warnings) + recorder.lines();
}

struct Options {
    RunOptions run;
    std::string report;  ///< path of the page; empty: none
};

void checkReport(const Options& options) {
    if (options.report.empty()) return;
    if (!options.run.resume.empty())
        throw BadInput(
            Error{"--report", "the page would lack the time before the restart; allowed: without --resume"});
    requireEnding("--report", options.report, {".html"});
    refuseInput("--report", options.report);
}

int runScenario(const Options& all) {
    const RunOptions& options = all.run;
    if (options.scenario.path.empty() == options.resume.empty())
        throw BadInput(
            Error{"SCENARIO", "give either a scenario or --resume FILE, which contains its scenario"});
    std::optional<Resumed> resumed;
    if (!options.resume.empty()) resumed.emplace(readResumed(options));
    const formats::Scenario scenario =
        resumed ? resumed->scenario : loadScenario(options.scenario, options.common);
    checkReport(all);
    MotionWatch watch;
    RunRecorder recorder(options, scenario, resumed ? &*resumed : nullptr);
    ProgressPrinter progress(options.common, Fraction::of_time);
    const RunResult result =
        runRecorded(scenario, resumed ? &resumed->from : nullptr, recorder,
                    controlOf(options.common, progress), all.report.empty() ? nullptr : &watch);
    progress.finish();
    const bool has_page = !all.report.empty() && result.began;
    if (has_page) {
        writeFile(all.report,
                  reportPage(watch.report(scenario, result, provenance(options.common, scenario.path))));
    }
    if (options.common.json) {
        printJson(runJson(options, scenario, result, recorder));
    } else {
        printResult(toText(options, scenario, result, recorder) +
                    (has_page ? "page in " + all.report + "\n" : ""));
    }
    return result.interrupted ? kInterrupted : kDone;
}

}  // namespace

Command addRun(CLI::App& root) {
    auto all = std::make_shared<Options>();
    RunOptions* options = &all->run;
    CLI::App* app = root.add_subcommand("run", "Time history of a scenario");
    addScenario(*app, options->scenario, false);
    app->add_option(
        "-o,--output", options->output,
        "FILE.mcap for snapshots (talus inspect, replay, export); FILE.csv for a table of energies and the "
        "blocks of run.watch");
    app->add_option("--report", all->report,
                    "FILE.html: a page with displacements over time, the ground motion, and the final "
                    "displacement of every block");
    app->add_option(
        "--resume", options->resume,
        "Continue the run in this .mcap file from its last full state, in place or, with -o, in a copy");
    app->add_option("--full-every", options->frames_per_full,
                    "Write the full state every Nth frame: contacts, and what a restart needs")
        ->check(CLI::Range(1, 1000000000))
        ->capture_default_str();
    app->add_flag("--force", options->force,
                  "Replace the output file even if it holds a finished run or is of another kind");
    addCommon(*app, options->common);
    app->footer(
        "Examples:\n  talus run slope.toml -o run.mcap\n  talus run --resume run.mcap\n  talus run "
        "slope.toml -o history.csv\n  talus run shaken.toml --report motion.html\n\nA separate thread writes "
        "a frame every run.frame_interval_s. Before compression a frame takes 36 bytes per block;\na full "
        "state takes about 240 bytes per block, 350 per interface and 81 per contact point. Ctrl-C ends the "
        "run and\nkeeps what was written. If the process is killed, at most its last\nsecond is lost. A "
        "resumed run ends in the same state to the bit (state_hash) as one that was never\ninterrupted, on "
        "any number of threads.");
    return {app, [all] { return runScenario(*all); }};
}

}  // namespace talus::tools
