// talus theory: the closed formulas, by numbers or for a scenario.

#include "talus/theory.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "commands/theory_formulas.h"
#include "talus/held.h"

namespace talus::tools {

namespace {

int ofScenario(const Common& common, const ScenarioInput& input) {
    const formats::Scenario scenario = loadScenario(input, common);
    const std::string path = input.name();
    const auto prediction = theory::predict(scenario.model);
    std::vector<std::string> warnings;
    if (prediction) warnings = heldAtTimeZero(scenario.model);
    if (common.json) {
        printJson({{"applies", prediction.has_value()},
                   {"theory_deg", prediction ? number(degrees(prediction->critical_tilt)) : Json(nullptr)},
                   {"failure_mode",
                    !prediction ? Json(nullptr) : Json(prediction->topples ? "toppling" : "sliding")},
                   {"formula", prediction ? Json(prediction->formula) : Json(nullptr)},
                   {"applies_because", prediction ? Json(prediction->applies_because) : Json(nullptr)},
                   {"warnings", warningsJson(scenario, warnings)},
                   {"provenance", provenance(common, path)}});
    } else if (prediction) {
        printResult(path + ": critical angle " + text(degrees(prediction->critical_tilt), 4) + " deg, " +
                    (prediction->topples ? "toppling" : "sliding") + "\n" + prediction->formula + "\n" +
                    "applies because: " + prediction->applies_because + "\n" +
                    warningLines(scenario, warnings));
    } else {
        printResult(path + ": no closed formula applies\n" + warningLines(scenario));
    }
    return kDone;
}

}  // namespace

Command addTheory(CLI::App& root) {
    auto common = std::make_shared<Common>();
    auto scenario = std::make_shared<ScenarioInput>();
    CLI::App* app = root.add_subcommand("theory", "Closed formulas, from given numbers or for a scenario");
    addScenario(*app, *scenario, false);
    addCommon(*app, *common, false);
    app->footer(
        "Example:\n  talus theory slope.toml\n  talus theory sliding --length 0.4 --height 0.5 --water-depth "
        "0.35 "
        "--friction 19.5\n\n'talus theory FORMULA --help' lists a formula's options.");
    const std::vector<Command> formulas{addSliding(*app, common), addToppling(*app, common),
                                        addCrack(*app, common), addDrop(*app, common),
                                        addTable1(*app, common)};
    app->require_subcommand(0, 1);
    return {app, [common, scenario, formulas, app] {
                for (const Command& formula : formulas)
                    if (formula.app->parsed()) return formula.execute();
                if (scenario->path.empty())
                    throw BadInput(Error{"SCENARIO", "missing; name a scenario file or a formula (" +
                                                         app->get_name() + " --help lists them)"});
                return ofScenario(*common, *scenario);
            }};
}

}  // namespace talus::tools
