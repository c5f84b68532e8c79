// talus flow: steady flow of water in the joint network.

#include "talus/flow.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "answers/flow_picture.h"
#include "answers/flow_report.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "talus/formats/export.h"

namespace talus::tools {

namespace {

struct FlowOptions {
    Common common;
    ScenarioInput scenario;
    std::string vtk, csv, picture;  ///< files; empty: not written
};

void refuse(const char* option, const std::string& file, const char* ending) {
    if (file.empty()) return;
    requireEnding(option, file, {ending});
    refuseInput(option, file);
    refuseUnwritable(file);
}

void writeFiles(const FlowOptions& options, const SteadyFlow& flow, const Model& model) {
    const std::string name = options.scenario.name();
    if (!options.vtk.empty()) writeFile(options.vtk, formats::vtpFlow(flow));
    if (!options.csv.empty())
        writeFile(options.csv, flowCsv(flow, model, provenanceComments(options.common, name)));
    if (!options.picture.empty()) writeFile(options.picture, flowSvg(flow, name));
}

Result<SteadyFlow> solve(const Model& model, const Control& control) {
    return model.flow->coupled ? coupledFlow(model, control) : steadyFlow(model, control);
}

int analyse(const FlowOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    if (!scenario.model.flow)
        throw BadInput(
            formats::placed(scenario, {{"flow", "found no [flow], allowed: a scenario with one"}}));
    refuse("--vtk", options.vtk, ".vtp");
    refuse("--csv", options.csv, ".csv");
    refuse("--picture", options.picture, ".svg");
    const EndsAtOnce solving = endsWhile("the flow was computed", options.common);
    ProgressPrinter progress(options.common);
    const Control control{.progress = progress.callback(), .threads = options.common.threads};
    const SteadyFlow flow = valueOf(solve(scenario.model, control), scenario);
    const Result<MeshChange> compared = meshChange(scenario.model, flow, control);
    progress.finish();
    if (!compared)
        note(options.common,
             "the flow was not compared with that of another mesh: " + compared.errors().front().message);
    const auto change = compared ? std::optional(*compared) : std::nullopt;
    writeFiles(options, flow, scenario.model);
    if (options.common.json)
        printJson(flowJson(flow, change, options.common, scenario));
    else
        printResult(flowText(flow, change, options.scenario.name()) + warningLines(scenario, flow.warnings));
    return kDone;
}

}  // namespace

Command addFlow(CLI::App& root) {
    auto options = std::make_shared<FlowOptions>();
    CLI::App* app = root.add_subcommand("flow", "Steady flow of water in the joint network");
    addScenario(*app, options->scenario);
    app->add_option("-o,--vtk", options->vtk,
                    "FILE.vtp: the joints with head, pressure and discharge, for ParaView")
        ->type_name("FILE");
    app->add_option("--csv", options->csv, "FILE.csv: the same, a row a triangle of the mesh")
        ->type_name("FILE");
    app->add_option("--picture", options->picture,
                    "FILE.svg: the joints seen along y, coloured by the pressure of their water")
        ->type_name("FILE");
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus flow slope.toml\n  talus flow slope.toml --json | jq '.boundaries[0]'\n  talus "
        "flow slope.toml -o flow.vtp --csv flow.csv --picture flow.svg\n\nThe scenario has a [flow] with the "
        "joints' hydraulic aperture and the heads. Laminar flow between parallel\nwalls (the cubic law) in "
        "every joint that bounds a free block, as the blocks lie at the start; with coupled =\ntrue, as they "
        "lie in equilibrium. The other commands put the pressure of this flow on the walls of the\njoints.");
    return {app, [options] { return analyse(*options); }};
}

}  // namespace talus::tools
