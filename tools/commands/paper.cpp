// talus paper: the paper's Table 1, Fig. 6 and section 5, computed again.

#include <CLI/CLI.hpp>
#include <chrono>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "report/page.h"
#include "report/svg.h"
#include "reproduction/bag_page.h"
#include "reproduction/cases.h"
#include "reproduction/data.h"
#include "reproduction/kept.h"
#include "reproduction/page.h"
#include "reproduction/plots.h"
#include "reproduction/run.h"
#include "reproduction/slope.h"
#include "reproduction/table.h"

namespace talus::tools {
namespace {

struct PaperOptions {
    Common common;
    std::string out = "talus-paper";
    std::string points = "vertex";
    bool keep = false;
    std::string keep_folder;        ///< empty: OUT/failing
    std::uint64_t monte_carlo = 0;  ///< samples of the laboratory's scatter; 0: none
};

PaperResults computeAll(const PaperOptions& options, std::vector<PaperCase> cases) {
    PaperResults results;
    results.threads = threadsUsed(options.common);
    results.table_points = options.points;
    results.provenance = provenance(options.common, "");
    results.provenance_comments = provenanceComments(options.common, "");
    ProgressPrinter printer(options.common, Fraction::of_time);
    const auto begin = std::chrono::steady_clock::now();
    results.runs = runCases(
        std::move(cases),
        [](const Model& model, const Control& control) { return criticalAngle(model, control); },
        results.threads, stopRequested(),
        [&](const PaperProgress& progress) {
            printer.show(
                {doneText(progress), progress.fraction, progress.last ? answerText(*progress.last) : ""});
        });
    results.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    results.interrupted = stopRequested();
    return results;
}

void writeScenarios(const PaperResults& results, const std::string& folder) {
    makeFolder(folder);
    for (const PaperRun& run : results.runs) {
        writeFile(folder + "/" + fileName(run.what) + ".toml", run.what.scenario.text);
    }
}

void writeSlopes(const PaperResults& results, const std::string& folder) {
    makeFolder(folder);
    for (const PaperRun& run : results.runs) {
        if (criticalDeg(run)) writeFile(folder + "/" + fileName(run.what) + ".svg", svgFile(drawSlope(run)));
    }
}

void writeBag(const PaperResults& results, const std::string& out) {
    writeFile(out + "/water-bag.csv", bagCsv(results.bag, results.provenance_comments));
    writeFile(out + "/water-bag-level.svg", svgFile(plotBagLevel(results.bag)));
    writeFile(out + "/water-bag-displacement.svg", svgFile(plotBagDisplacement(results.bag)));
    for (const BagRun& bag : results.bag)
        writeFile(out + "/scenarios/water-" + bag.id + ".toml", bag.run.scenario.text);
}

void writeAll(const PaperResults& results, const std::string& out) {
    makeFolder(out);
    writeFile(out + "/cases.csv", paperCsv(results));
    writeFile(out + "/laboratory.csv", laboratoryCsv(results));
    writeFile(out + "/results.json", jsonText(paperJson(results), 2) + '\n');
    writeFile(out + "/fig6.svg", svgFile(plotFig6(results)));
    writeFile(out + "/difference.svg", svgFile(plotDifference(results)));
    writeFile(out + "/contact-points.svg", svgFile(plotPoints(results)));
    if (results.scatter) writeFile(out + "/scatter.svg", svgFile(plotScatter(*results.scatter)));
    writeSlopes(results, out + "/slopes");
    writeScenarios(results, out + "/scenarios");
    if (!results.bag.empty()) writeBag(results, out);
    const Json report = paperReport(results);
    writeFile(out + "/index.json", jsonText(report) + '\n');
    writeFile(out + "/index.html", reportPage(report));
}

int exitCode(const PaperResults& results) {
    if (results.interrupted) return kInterrupted;
    bool undecided = false;
    for (const PaperRun& run : results.runs) {
        if (!run.errors.empty()) return kInternalError;  // a scenario built in was refused
        undecided = undecided || run.search.status == SearchStatus::undecided;
    }
    return undecided ? kUndecided : kDone;
}

int execute(const PaperOptions& options) {
    std::vector<PaperCase> cases = paperCases(options.points);
    // A folder that cannot be made is reported before minutes of computing.
    makeFolder(options.out);
    const std::string keep_folder =
        options.keep_folder.empty() ? options.out + "/failing" : options.keep_folder;
    if (options.keep) {
        makeFolder(keep_folder);
        markKept(cases);
    }
    PaperResults results = computeAll(options, std::move(cases));
    const auto begin = std::chrono::steady_clock::now();
    if (options.keep && !results.interrupted) {
        keepFailures(results, keep_folder, options.out, options.common);
        keepBagRuns(results, keep_folder, options.out, options.common);
    }
    if (options.monte_carlo > 0 && !results.interrupted)
        results.scatter = computeScatter(options.monte_carlo, options.out + "/scatter", options.common);
    results.interrupted = stopRequested();
    results.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    writeAll(results, options.out);
    if (options.common.json) {
        printJson(paperJson(results));
    } else {
        printText(terminalTable(results) + "\nPage, plots and tables: " + options.out + "/index.html\n");
    }
    return exitCode(results);
}

}  // namespace

Command addPaper(CLI::App& root) {
    CLI::App* app = root.add_subcommand("paper", "Recompute Table 1, Fig. 6 and section 5 of the paper");
    const auto options = std::make_shared<PaperOptions>();
    app->add_option("--out,-o", options->out, "Folder for the page, plots and tables")->capture_default_str();
    app->add_option("--points", options->points,
                    "Contact points of Table 1 and section 5: quarter, corner, vertex or \"grid N\"")
        ->capture_default_str();
    const auto* keep =
        app->add_option("--keep-run", options->keep_folder,
                        "Also keep the failing runs of the slope, dry and with water in fissure 5, and "
                        "runs with the water bag, with their replays, in this folder (default OUT/failing; "
                        "existing files are replaced)")
            ->type_name("[DIR]")
            ->expected(0, 1);
    app->add_option("--monte-carlo", options->monte_carlo,
                    "Also compute the laboratory's scatter from N samples with a friction angle drawn per "
                    "interface (about 5 s of processor time per sample)")
        ->check(CLI::Range(1, 1000000));
    app->footer(
        "Example:\n  talus paper --out reproduction\n  talus paper --out reproduction --keep-run\n  talus "
        "paper --out reproduction --monte-carlo 100\n\nThe Monte Carlo simulation keeps its rows in "
        "OUT/scatter. Run the same command again to continue one that was stopped.");
    addCommon(*app, options->common);
    return {app, [options, keep] {
                options->keep = keep->count() > 0;
                return execute(*options);
            }};
}

}  // namespace talus::tools
