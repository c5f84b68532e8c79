// talus limit-analysis: the greatest tilt, factor of safety or horizontal load of the associated rigid-block
// problem.

#include "talus/limit_analysis.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "answers/limit_report.h"
#include "cli/block_names.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "recording/keep_mechanism.h"
#include "report/numbers.h"

namespace talus::tools {

namespace {

struct LimitOptions {
    Common common;
    ScenarioInput scenario;
    const VariedQuantity* load = nullptr;
    std::size_t max_points = LimitSettings{}.max_contact_points;
    KeepMechanismOptions keep;
};

std::string answerText(const LimitOptions& options, const LimitResult& result) {
    const VariedQuantity& load = *options.load;
    const std::string unit = *load.unit != '\0' ? load.unit : load.of;
    const auto say = [&](double value) {
        return text(value / load.scale, load.limit_decimals) + (unit.empty() ? "" : " " + unit);
    };
    switch (result.status) {
        case SearchStatus::found:
            return say(result.lower) + (result.upper > result.lower ? " to " + say(result.upper) : "");
        case SearchStatus::unstable_at_start:
            return "none: no forces balance the loads at the start";
        case SearchStatus::stable_to_stop:
            return "none: forces balance the loads up to " + say(result.lower);
        case SearchStatus::interrupted:
            break;
        case SearchStatus::undecided:
            return "undecided";
    }
    const std::string least = std::isfinite(result.lower) ? "at least " + say(result.lower) : "";
    const std::string most = std::isfinite(result.upper) ? "at most " + say(result.upper) : "";
    if (least.empty() && most.empty()) return "interrupted before a bound was known";
    return "interrupted; so far: " + least + (least.empty() || most.empty() ? "" : ", ") + most;
}

std::string row(std::string label, const std::string& content) {
    label.resize(std::max<std::size_t>(label.size() + 1, 18), ' ');
    return label + content + "\n";
}

std::string movingText(const LimitResult& result) {
    return std::to_string(result.moving_blocks.size()) + " of " + std::to_string(result.blocks) +
           " free: " + compactNames(result.moving_blocks);
}

std::string toText(const LimitOptions& options, const formats::Scenario& scenario,
                   const LimitResult& result) {
    const std::string kind = result.plane_section ? "plane section" : "in space";
    std::string warnings;
    for (const std::string& warning : warningsOf(scenario, result.warnings))
        warnings += row("warning", warning);
    return row("scenario", options.scenario.name()) + row(options.load->limit, answerText(options, result)) +
           (result.moving_blocks.empty() ? "" : row("moving blocks", movingText(result))) + warnings +
           row("programme", kind + ", " + std::to_string(result.contact_points) + " contact points, " +
                                std::to_string(result.rows) + " equations, " +
                                std::to_string(result.columns) + " columns") +
           row("cost", std::to_string(result.programmes) + " programmes, " +
                           std::to_string(result.iterations) + " iterations, " +
                           text(result.wall_seconds, 2) + " s");
}

int exitCode(SearchStatus status) {
    if (status == SearchStatus::interrupted) return kInterrupted;
    return status == SearchStatus::undecided ? kUndecided : kDone;
}

int analyse(const LimitOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    requireFreeBlock(scenario);
    MechanismKeeper keeper(options.keep, options.common, scenario);
    ProgressPrinter progress(options.common);
    LimitSettings settings;
    settings.max_contact_points = options.max_points;
    const LimitResult result = valueOf(
        limitAnalysis(scenario.model, options.load->varied, controlOf(options.common, progress), settings),
        scenario);
    progress.finish();
    std::optional<KeptMechanism> kept;
    if (keeper.wanted()) kept = keeper.keep(result, *options.load);
    if (options.common.json) {
        Json json = limitJson(*options.load, result, options.common, scenario);
        if (kept) json["kept_mechanism"] = keptMechanismJson(*kept);
        printJson(json);
    } else {
        printResult(toText(options, scenario, result) +
                    (kept ? row("mechanism", keptMechanismText(*kept)) : ""));
    }
    return kept && kept->exit_code != kDone ? kept->exit_code : exitCode(result.status);
}

}  // namespace

Command addLimitAnalysis(CLI::App& root) {
    auto options = std::make_shared<LimitOptions>();
    CLI::App* app = root.add_subcommand(
        "limit-analysis",
        "Upper bound of the other answers: limit analysis of rigid blocks with associated flow");
    addScenario(*app, options->scenario);
    std::vector<std::string> names;
    std::string meanings;
    for (const VariedQuantity& quantity : variedQuantities()) {
        names.emplace_back(quantity.name);
        meanings += std::string(meanings.empty() ? "" : ", ") + quantity.name + " (" + quantity.limit + ")";
    }
    app->add_option_function<std::string>(
           "--for", [options](const std::string& name) { options->load = variedNamed(name); },
           "Load that increases: " + meanings)
        ->check(CLI::IsMember(names))
        ->type_name("LOAD")
        ->required();
    app->add_option("--max-points", options->max_points,
                    "Largest number of contact points; larger models are refused")
        ->capture_default_str();
    addKeepMechanism(*app, options->keep);
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus limit-analysis slope.toml --for factor\n  talus limit-analysis arch.toml --for "
        "tilt --json | jq .upper\n  talus limit-analysis arch.toml --for tilt --keep-mechanism arch.mcap\n  "
        "talus replay arch.mcap -o arch.html\n\nA linear programme over the contact points in their initial "
        "position, with joints that open by\ntan(phi) times their slide. No equilibrium of real joints in "
        "that position lies above the limit. It is close\nto the answer where blocks hinge or slide, and far "
        "above it where they interlock. `lower` and `upper`\nbracket the limit, with friction cones replaced "
        "by pyramids inside and outside of them.");
    return {app, [options] { return analyse(*options); }};
}

}  // namespace talus::tools
