// talus report: one page about a slope, with its figures beside it.

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "slope_report/slope_report.h"

namespace talus::tools {

namespace {

struct ReportOptions {
    Common common;
    ScenarioInput scenario;
    std::string output, figures;
    SlopeReportRequest request;
};

int report(const ReportOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    for (const std::string& warning : scenario.warnings)
        note(options.common, "warning: " + options.scenario.name() + ": " + warning);
    requireFreeBlock(scenario);
    SlopeReportFiles files = slopeReportFiles(options.output, options.figures);
    refuseSlopeReportFiles(files);
    ProgressPrinter progress(options.common);
    const auto computed =
        computeSlopeReport(scenario, options.request, options.common, controlOf(options.common, progress));
    progress.finish();
    if (!computed) {
        note(options.common, "interrupted: no report was written");
        if (options.common.json) printJson({{"page", nullptr}, {"interrupted", true}});
        return kInterrupted;
    }
    writeSlopeReport(*computed, files);
    if (options.common.json)
        printJson(slopeReportJson(*computed, files));
    else {
        printResult("report   " + files.page + "\nfigures  " + files.folder + ", " +
                    std::to_string(files.figures.size()) + " files\n");
    }
    return exitCode(computed->search);
}

}  // namespace

Command addReport(CLI::App& root) {
    constexpr double kPercent = 10;
    auto options = std::make_shared<ReportOptions>();
    CLI::App* app =
        root.add_subcommand("report", "One page about a slope: answer, volume, key blocks, figures");
    addScenario(*app, options->scenario);
    app->add_option("-o,--output", options->output, "The page, FILE.html")->required()->type_name("FILE");
    app->add_option("--figures", options->figures,
                    "Folder of the figures as SVG and CSV; by default FILE_figures beside the page")
        ->type_name("DIR");
    std::vector<std::string> names;
    for (const LoadSearch& search : loadSearches()) names.emplace_back(search.name);
    app->add_option("--analysis", options->request.analysis,
                    "The question; by default the one that [analysis] has keys of, critical-angle where the "
                    "scenario gives gravity.tilt_deg, else safety-factor")
        ->check(CLI::IsMember(names))
        ->type_name("SEARCH");
    app->add_option("--groups", options->request.groups,
                    "How many groups of blocks a search for a factor of safety follows")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app->add_option(
           "--slope", options->request.slope,
           "The face of the stereonet: dip and dip direction in degrees; by default that of the model")
        ->type_name("DIP/DIPDIRECTION");
    app->add_option_function<double>(
           "--sensitivity",
           [options = options.get()](double percent) { options->request.sensitivity = percent / 100; },
           "Search again with friction and stiffness less and more by so many percent, 10 without a number, "
           "and with the horizontal coefficient less and more by 0.05")
        ->expected(0, 1)
        ->default_str(std::to_string(static_cast<int>(kPercent)))
        ->check(CLI::Range(0.1, 100 * kMostShare))
        ->type_name("PERCENT");
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus report slope.toml -o slope.html\n  talus report slope.toml -o slope.html "
        "--sensitivity --figures figures\n  talus report slope.toml -o slope.html --analysis "
        "critical-acceleration\n\nThe page is one file without scripts that needs no network and prints on "
        "A4. It has the question, a picture\nof the slope, the answer with its interval and reasons, the "
        "curve of load and displacement, groups with volume\nand mass, limit equilibrium, key blocks with "
        "the curve of factor and volume, stereonets where the scenario\nhas joint sets, water and bolts, "
        "warnings and provenance. The same input gives the same bytes.");
    return {app, [options] { return report(*options); }};
}

}  // namespace talus::tools
