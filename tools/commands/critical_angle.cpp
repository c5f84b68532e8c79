// talus critical-angle: the tilt at which the assembly first fails.

#include <memory>

#include "cli/command.h"
#include "commands/ceiling.h"
#include "commands/search_report.h"

namespace talus::tools {

namespace {

struct CriticalAngleOptions {
    Common common;
    std::string scenario;
    bool verbose = false;
    KeepRunOptions keep;
    CeilingOptions ceiling;
};

std::optional<TheoryFigure> theoryOf(const Model& model) {
    const auto prediction = theory::predict(model);
    if (!prediction) return std::nullopt;
    return TheoryFigure{prediction->critical_tilt, *prediction};
}

Json toJson(const SearchReport& report) {
    Json json{{"status", statusText(report.result.status)},
              {"critical_angle_deg", answerJson(report)},
              {"bracket_deg", bracketJson(report)},
              {"theory_deg", report.theory ? number(degrees(report.theory->value)) : Json(nullptr)}};
    addSearchJson(json, report);
    return json;
}

int findCriticalAngle(const CriticalAngleOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    FailureKeeper keeper(options.keep, options.common, scenario);
    ProgressPrinter progress(options.common);
    Control control = controlOf(options.common, progress);
    control.keep_failing_state = keeper.wanted();
    SearchResult result = valueOf(criticalAngle(scenario.model, control), scenario);
    const Ceiling ceiling = findCeiling(scenario, LimitLoad::tilt, options.ceiling, result, control);
    holdUnder(ceiling, LimitLoad::tilt, result);
    SearchReport report{
        options.common,           scenario, result, {"critical angle", "tilt_deg", " deg", kDegree, 3},
        theoryOf(scenario.model), ceiling};
    if (keeper.wanted()) report.kept = keeper.keep(result, SearchKind::critical_angle, control);
    progress.finish();
    if (options.common.json) {
        printJson(toJson(report));
    } else {
        printText(searchText(report, options.verbose));
    }
    return exitCode(report);
}

}  // namespace

Command addCriticalAngle(CLI::App& root) {
    auto options = std::make_shared<CriticalAngleOptions>();
    CLI::App* app = root.add_subcommand("critical-angle", "The tilt at which the assembly first fails");
    app->add_option("SCENARIO", options->scenario, "Scenario file (TOML)")->required();
    app->add_flag("--verbose", options->verbose, "Also print every probe and every block's motion");
    addKeepRun(*app, options->keep);
    addCeiling(*app, options->ceiling);
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus critical-angle slope.toml --verbose\n  talus critical-angle slope.toml --json | "
        "jq "
        ".critical_angle_deg\n  talus critical-angle slope.toml --keep-run failing.mcap && talus replay "
        "failing.mcap "
        "-o failing.html\n\nThe search runs from analysis.start_deg to analysis.stop_deg until the "
        "bracket "
        "is analysis.tolerance_deg wide.\nA slope that fails at the start or stands to the end is a result "
        "(exit code 0), an undecided one is not (3).");
    return {app, [options] { return findCriticalAngle(*options); }};
}

}  // namespace talus::tools
