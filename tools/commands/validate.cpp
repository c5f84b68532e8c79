// talus validate: reads and checks a scenario, computes nothing.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/json.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "talus/simulation.h"

namespace talus::tools {

namespace {

/// A water table is one of them.
std::size_t watersOf(const Model& model) { return model.waters.size() + (model.phreatic ? 1 : 0); }

struct ValidateOptions {
    Common common;
    ScenarioInput scenario;
};

std::size_t count(const Model& model, Motion motion) {
    return static_cast<std::size_t>(
        std::count_if(model.blocks.begin(), model.blocks.end(),
                      [motion](const Block& block) { return block.motion == motion; }));
}

Json counts(const Model& model) {
    return {{"blocks", model.blocks.size()},
            {"free_blocks", count(model, Motion::free)},
            {"fixed_blocks", count(model, Motion::fixed)},
            {"driven_blocks", count(model, Motion::driven)},
            {"joints", model.joints.size()},
            {"pair_joints", model.pair_joints.size()},
            {"waters", watersOf(model)},
            {"watched_blocks", model.run.watch.size()}};
}

std::string summary(const std::string& path, const Model& model, const ModelCheck& found) {
    const auto item = [](std::size_t n, const char* one) {
        return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
    };
    return path + ": ok: " + item(model.blocks.size(), "block") + " (" +
           std::to_string(count(model, Motion::free)) + " free, " +
           std::to_string(count(model, Motion::fixed)) + " fixed, " +
           std::to_string(count(model, Motion::driven)) + " driven), " + item(model.joints.size(), "joint") +
           ", " + item(watersOf(model), "water") + "; " + item(found.interfaces, "interface") + " with " +
           item(found.contact_points, "contact point") + ", " +
           item(found.idle_interfaces, "idle interface") + "\n";
}

int validate(const ValidateOptions& options) {
    const EndsAtOnce checking = whileReading(options.scenario.name(), options.common);
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    ModelCheck found;
    ProgressPrinter progress(options.common);
    const std::vector<Error> errors = checkModel(scenario.model, controlOf(options.common, progress), &found);
    progress.finish();
    if (!errors.empty()) refuse(scenario, errors);
    if (!options.common.json) {
        printResult(summary(options.scenario.name(), scenario.model, found) +
                    warningLines(scenario, found.warnings));
        return kDone;
    }
    Json json{{"ok", true}, {"errors", Json::array()}};
    json.update(counts(scenario.model));
    json["interfaces"] = found.interfaces;
    json["contact_points"] = found.contact_points;
    json["idle_interfaces"] = found.idle_interfaces;
    json["warnings"] = warningsJson(scenario, found.warnings);
    json["provenance"] = provenance(options.common, options.scenario.name());
    printJson(json);
    return kDone;
}

}  // namespace

Command addValidate(CLI::App& root) {
    auto options = std::make_shared<ValidateOptions>();
    CLI::App* app = root.add_subcommand("validate", "Read and check a scenario without computing");
    addScenario(*app, options->scenario);
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus validate slope.toml\n\nFaults are printed as FILE:LINE:COLUMN: error: FIELD: what "
        "was found, what is allowed.");
    return {app, [options] { return validate(*options); }};
}

}  // namespace talus::tools
