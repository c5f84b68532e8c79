// talus blocks: a scenario's blocks before anything moves, as a table, a mesh, a picture.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "report/blocks_files.h"
#include "report/joints_svg.h"

namespace talus::tools {

namespace {

struct BlocksOptions {
    Common common;
    ScenarioInput scenario;
    std::string output, stereonet, sizes, fractures;
    std::vector<double> view = {235, 25};  ///< [deg]
};

/// Volumes and thicknesses of all blocks, sorted.
struct Sizes {
    std::vector<double> volume, thickness;
    double total = 0;
};

Sizes sizesOf(const Model& model) {
    Sizes sizes;
    for (const Block& block : model.blocks) {
        sizes.volume.push_back(massProperties(block.shape).volume);
        sizes.thickness.push_back(smallestExtent(block.shape));
        sizes.total += sizes.volume.back();
    }
    std::sort(sizes.volume.begin(), sizes.volume.end());
    std::sort(sizes.thickness.begin(), sizes.thickness.end());
    return sizes;
}

double median(const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; }

std::size_t fixedCount(const Model& model) {
    return static_cast<std::size_t>(std::count_if(model.blocks.begin(), model.blocks.end(),
                                                  [](const Block& b) { return b.motion == Motion::fixed; }));
}

std::string line(const std::string& name, const std::string& value) {
    return name + std::string(name.size() < 18 ? 18 - name.size() : 1, ' ') + value + "\n";
}

std::string shortText(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", value);
    return buffer;
}

/// The discs that were drawn for a fracture set, or read.
struct Network {
    std::string set;
    std::size_t discs = 0;
    double p32 = 0;  ///< their area in the region over its volume [m^2/m^3]
};

std::vector<Network> networksOf(const std::vector<formats::RockJoint>& joints, double volume) {
    std::vector<Network> networks;
    for (const formats::RockJoint& joint : joints) {
        if (!joint.disc) continue;
        auto network = std::find_if(networks.begin(), networks.end(),
                                    [&](const Network& n) { return n.set == joint.set; });
        if (network == networks.end()) network = networks.insert(network, Network{joint.set});
        ++network->discs;
        network->p32 += joint.area_inside / volume;
    }
    return networks;
}

std::string networkLines(const std::vector<Network>& networks) {
    std::string lines;
    for (const Network& network : networks) {
        const std::string p32 = shortText(network.p32) + " m2 of disc area per m3";
        lines += line("discs of " + network.set, std::to_string(network.discs) + ", " + p32);
    }
    return lines;
}

Json networkJson(const std::vector<Network>& networks) {
    Json list = Json::array();
    for (const Network& network : networks)
        list.push_back({{"name", network.set}, {"discs", network.discs}, {"p32", number(network.p32)}});
    return list;
}

std::string summary(const Model& model, const Sizes& sizes, const formats::FiniteCuts& cuts) {
    const auto range = [&](const std::vector<double>& v, const char* unit) {
        return shortText(v.front()) + " to " + shortText(v.back()) + " " + unit + ", median " +
               shortText(median(v));
    };
    return line("blocks",
                std::to_string(model.blocks.size()) + " (" + std::to_string(fixedCount(model)) + " fixed)") +
           line("volume", shortText(sizes.total) + " m3") + line("block volumes", range(sizes.volume, "m3")) +
           line("thickness", range(sizes.thickness, "m")) +
           (cuts.interfaces == 0
                ? ""
                : line("finite joints", shortText(cuts.beyond) + " of " + shortText(cuts.area) +
                                            " m2 of their cuts lie beyond the joints, " +
                                            (cuts.are_bridges ? "intact rock" : "with their strength")));
}

Json json(const Model& model, const Sizes& sizes, const formats::FiniteCuts& cuts) {
    const auto range = [](const std::vector<double>& v) {
        return Json{{"least", number(v.front())}, {"median", number(median(v))}, {"most", number(v.back())}};
    };
    return {{"blocks", model.blocks.size()},
            {"fixed_blocks", fixedCount(model)},
            {"volume_m3", number(sizes.total)},
            {"block_volume_m3", range(sizes.volume)},
            {"thickness_m", range(sizes.thickness)},
            {"finite_cuts",
             {{"interfaces", cuts.interfaces},
              {"bridged_interfaces", cuts.are_bridges ? cuts.bridged : 0},
              {"area_m2", number(cuts.area)},
              {"beyond_joints_m2", number(cuts.beyond)}}}};
}

std::string content(const BlocksOptions& options, const Model& model) {
    const auto has = [&](const char* ending) { return options.output.ends_with(ending); };
    const std::string comments = provenanceComments(options.common, options.scenario.name());
    if (has(".obj")) return blocksObj(model, comments);
    if (has(".csv")) return blocksCsv(model, comments);
    return blocksSvg(model, {radians(options.view[0]), radians(options.view[1])},
                     "Blocks of " + options.scenario.name());
}

/// Its duration is unknown, so the progress shows activity only.
std::string drawnWithProgress(const BlocksOptions& options, const Model& model) {
    ProgressPrinter progress(options.common);
    progress.show({"drawing", 0.0, std::to_string(model.blocks.size()) + " blocks"});
    return content(options, model);
}

struct JointsFile {
    const char* option;
    const std::string& path;
    const char* ending;
};

std::array<JointsFile, 3> jointsFiles(const BlocksOptions& options) {
    return {{{"--stereonet", options.stereonet, ".svg"},
             {"--sizes", options.sizes, ".svg"},
             {"--fractures", options.fractures, ".csv"}}};
}

std::string discsCsv(const BlocksOptions& options, const std::vector<formats::RockJoint>& joints) {
    std::vector<std::pair<std::string, Fracture>> discs;
    for (const formats::RockJoint& joint : joints)
        if (joint.disc) discs.emplace_back(joint.set, *joint.disc);
    return provenanceComments(options.common, options.scenario.name()) + formats::fracturesCsv(discs);
}

/// Pictures and table of the joints that cut the blocks. Returns warnings for outputs without joints; where
/// nothing else is wanted, that is an error.
std::vector<std::string> writeJoints(const BlocksOptions& options, const formats::Scenario& scenario,
                                     const std::vector<formats::RockJoint>& joints) {
    std::vector<const char*> asked;
    for (const JointsFile& file : jointsFiles(options))
        if (!file.path.empty()) asked.push_back(file.option);
    if (asked.empty()) return {};
    if (joints.empty()) {
        const std::string found = "no joint set in " + options.scenario.name();
        if (options.output.empty()) {
            throw BadInput(
                Error{asked[0], "found " + found + ", allowed: a scenario with [rock_mass] and joints"});
        }
        std::vector<std::string> warnings;
        warnings.reserve(asked.size());
        for (const char* option : asked)
            warnings.push_back(std::string(option) + ": " + found + " to plot; the file is not written");
        for (const std::string& warning : warnings) note(options.common, "warning: " + warning);
        return warnings;
    }
    if (!options.stereonet.empty())
        writeFile(options.stereonet, stereonetSvg(joints, "Joints of " + options.scenario.name()));
    if (!options.sizes.empty())
        writeFile(options.sizes, sizesSvg(joints, scenario.model, "Sizes in " + options.scenario.name()));
    if (!options.fractures.empty()) writeFile(options.fractures, discsCsv(options, joints));
    return {};
}

void refuseOneNameTwice(const BlocksOptions& options) {
    std::vector<std::string> names{options.output};
    for (const JointsFile& file : jointsFiles(options)) {
        if (file.path.empty()) continue;
        if (std::find(names.begin(), names.end(), file.path) != names.end()) {
            throw BadInput(Error{
                file.option, "found \"" + file.path +
                                 "\", which is also the name of another output file; choose another name"});
        }
        names.push_back(file.path);
    }
}

int blocks(const BlocksOptions& options) {
    if (!options.output.empty()) requireEnding("--output", options.output, {".obj", ".csv", ".svg"});
    for (const JointsFile& file : jointsFiles(options))
        if (!file.path.empty()) requireEnding(file.option, file.path, {file.ending});
    refuseOneNameTwice(options);
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    const auto joints = formats::rockJoints(scenario);
    if (!joints) throw BadInput(joints.errors());
    const std::vector<std::string> warnings = writeJoints(options, scenario, *joints);
    const auto [drawn, sizes] = [&] {
        const EndsAtOnce drawing = endsWhile("the blocks were drawn", options.common);
        return std::pair(options.output.empty() ? "" : drawnWithProgress(options, scenario.model),
                         sizesOf(scenario.model));
    }();
    if (!options.output.empty()) writeFile(options.output, drawn);
    const std::vector<Network> networks = networksOf(*joints, sizes.total);
    if (!options.common.json) {
        printResult(summary(scenario.model, sizes, scenario.finite_cuts) + networkLines(networks) +
                    warningLines(scenario));
        return kDone;
    }
    Json result = json(scenario.model, sizes, scenario.finite_cuts);
    result["fracture_sets"] = networkJson(networks);
    result["warnings"] = scenario.warnings;
    for (const std::string& warning : warnings) result["warnings"].push_back(warning);
    result["provenance"] = provenance(options.common, options.scenario.name());
    printJson(result);
    return kDone;
}

}  // namespace

Command addBlocks(CLI::App& root) {
    auto options = std::make_shared<BlocksOptions>();
    CLI::App* app = root.add_subcommand(
        "blocks", "Cut and count the blocks of a scenario; write a mesh, a table or a picture");
    addScenario(*app, options->scenario);
    app->add_option(
        "-o,--output", options->output,
        "Output file; its ending chooses the kind: .obj a mesh, .csv a table of the blocks, .svg a picture");
    app->add_option("--stereonet", options->stereonet,
                    "Picture of the joints' poles, equal-area, lower hemisphere (.svg)");
    app->add_option("--sizes", options->sizes, "Plot of the size distributions of discs and blocks (.svg)");
    app->add_option("--fractures", options->fractures, "Table of the discs of all fracture sets (.csv)");
    app->add_option("--view", options->view,
                    "Viewpoint of the picture: azimuth clockwise from north (+y) and elevation, in degrees")
        ->expected(2)
        ->delimiter(',')
        ->capture_default_str();
    addCommon(*app, options->common, false);
    app->footer("Example:\n  talus blocks slope.toml -o slope.svg --view 235,25");
    return {app, [options] { return blocks(*options); }};
}

}  // namespace talus::tools
