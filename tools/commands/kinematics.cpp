// talus kinematics: which planes of a slope can slide or topple, on the stereonet.

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "answers/kinematics.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

struct KinematicsOptions {
    Common common;
    ScenarioInput input;
    std::string slope, scanline, stereonet;
    std::string view = kNetViews[0], net = kNetProjections[0], counting = kNetContours[0];
    double friction = 0, lateral = kLateralDeg, bias_limit = kBiasLimitDeg, counting_area = 1;  // [deg], [%]
    bool has_bias_limit = false;
    std::size_t sets = 0;
};

KinematicsQuestion questionOf(const KinematicsOptions& options) {
    KinematicsQuestion question;
    const auto [dip, direction] =
        anglesOf("--slope", options.slope, "DIP/DIPDIRECTION in degrees, such as 70/135");
    if (!(dip > 0 && dip <= 90)) {
        throw BadInput(Error{"--slope", "found a dip of " + options.slope.substr(0, options.slope.find('/')) +
                                            ", allowed: greater than 0 and at most 90 degrees"});
    }
    if (!(std::abs(direction) <= 360)) {
        throw BadInput(Error{"--slope", "found a dip direction of " +
                                            options.slope.substr(options.slope.find('/') + 1) +
                                            ", allowed: -360 to 360 degrees"});
    }
    question.face = {radians(dip), radians(direction < 0 ? direction + 360 : direction)};
    question.limits = {radians(options.friction), radians(options.lateral)};
    question.find_sets = options.sets;
    if (!options.scanline.empty()) {
        const auto [trend, plunge] =
            anglesOf("--scanline", options.scanline, "TREND/PLUNGE in degrees, such as 90/5");
        question.scanline = scanlineOf(trend, plunge);
    }
    if (options.has_bias_limit) question.bias_limit = radians(options.bias_limit);
    return question;
}

PoleSource sourceOf(const KinematicsOptions& options, const KinematicsQuestion& question) {
    if (!isPoleTable(options.input.path))
        return polesOf(loadScenario(options.input, options.common), question);
    if (!options.input.sets.empty())
        throw BadInput(Error{"--set", "found together with a table of poles, allowed: with a scenario"});
    const formats::PoleTable table = valueOf(formats::readPoles(options.input.path));
    if (!table.passed_over.empty()) {
        std::string list;
        for (const std::string& title : table.passed_over) list += (list.empty() ? "" : ", ") + title;
        note(options.common, "columns ignored: " + list);
    }
    return polesOf(table, question);
}

int analyse(const KinematicsOptions& options) {
    if (!options.stereonet.empty()) {
        requireEnding("--stereonet", options.stereonet, {".svg"});
        refuseUnwritable(options.stereonet);
    }
    const KinematicsQuestion question = questionOf(options);
    PoleSource source = sourceOf(options, question);
    const EndsAtOnce computing = endsWhile("the planes were tested", options.common);
    const KinematicsAnswer answer = answerKinematics(std::move(source), question);
    if (!options.stereonet.empty()) {
        refuseInput("--stereonet", options.stereonet);
        const NetPicture picture =
            netPicture(options.view, options.net, options.counting, options.counting_area);
        writeFile(options.stereonet, kinematicsSvg(answer, picture, "Kinematics of " + options.input.name()));
    }
    if (options.common.json) {
        printJson(kinematicsJson(answer, options.common, options.input.name()));
    } else {
        printResult(kinematicsText(answer));
    }
    return kDone;
}

void addPictureOptions(CLI::App& app, KinematicsOptions& options) {
    app.add_option("--stereonet", options.stereonet, "Picture on the lower hemisphere (.svg)")
        ->type_name("FILE");
    app.add_option("--view", options.view,
                   "What the picture shows: poles (planar sliding, flexural toppling) or intersections "
                   "(wedge sliding, direct toppling)")
        ->check(CLI::IsMember(std::vector<std::string>(kNetViews.begin(), kNetViews.end())))
        ->type_name("WHAT")
        ->capture_default_str();
    app.add_option("--net", options.net,
                   "Projection of the picture: equal-area (Schmidt) or equal-angle (Wulff)")
        ->check(CLI::IsMember(std::vector<std::string>(kNetProjections.begin(), kNetProjections.end())))
        ->type_name("NET")
        ->capture_default_str();
    app.add_option("--contours", options.counting,
                   "How the contours count poles: fisher (each pole spread by Fisher's distribution), "
                   "circle, or none")
        ->check(CLI::IsMember(std::vector<std::string>(kNetContours.begin(), kNetContours.end())))
        ->type_name("HOW")
        ->capture_default_str();
    app.add_option("--counting-area", options.counting_area,
                   "Area of the counting circle, in % of the hemisphere")
        ->check(CLI::Range(0.1, 20.0))
        ->type_name("PERCENT")
        ->capture_default_str();
}

}  // namespace

Command addKinematics(CLI::App& root) {
    auto options = std::make_shared<KinematicsOptions>();
    CLI::App* app = root.add_subcommand(
        "kinematics",
        "Planar sliding, wedges and toppling of a face on the stereonet, with sets and Fisher statistics");
    addScenario(*app, options->input);
    app->get_option("SCENARIO")
        ->description(
            "Scenario file (TOML), or a table of poles: a name that ends in .csv, .tsv, .txt or .dat");
    app->add_option("--slope", options->slope, "The face: dip and dip direction in degrees, such as 70/135")
        ->required()
        ->type_name("DIP/DIPDIRECTION");
    app->add_option("--friction", options->friction, "Friction angle of all planes [deg]")
        ->required()
        ->check(CLI::Range(0.0, 90.0))
        ->type_name("DEG");
    app->add_option("--lateral", options->lateral,
                    "Lateral limits on each side of the face's dip direction [deg]")
        ->check(CLI::Range(0.0, 90.0))
        ->type_name("DEG")
        ->capture_default_str();
    app->add_option("--sets", options->sets, "Number of sets to find, instead of the sets named in the file")
        ->check(CLI::Range(1, 50))
        ->type_name("N");
    app->add_option("--scanline", options->scanline,
                    "Apply the Terzaghi weighting for this scanline to the poles of a table [deg]")
        ->type_name("TREND/PLUNGE");
    app->add_option_function<double>(
           "--bias-limit",
           [options = options.get()](double limit) {
               options->bias_limit = limit;
               options->has_bias_limit = true;
           },
           "Smallest angle between scanline and plane that a weight is computed for; default 15 [deg]")
        ->check(CLI::Range(1.0, 90.0))
        ->type_name("DEG");
    addPictureOptions(*app, *options);
    addCommon(*app, options->common, false);
    app->footer(
        "Example:\n  talus kinematics poles.csv --slope 70/135 --friction 30 --stereonet poles.svg\n  talus "
        "kinematics poles.csv --slope 70/135 --friction 30 --sets 3 --stereonet lines.svg --view "
        "intersections\n  talus kinematics slope.toml --slope 70/270 --friction 35 --json\n\nSCENARIO may "
        "also be a table of poles, with a name that ends in .csv, .tsv, .txt or .dat. It has a header and "
        "one plane per row, given by dip_deg and dip_direction_deg; by strike_deg and dip_deg (right-hand "
        "rule, or N45E and 60SE); by trend_deg and plunge_deg of the pole; or by nx, ny, nz. It may also "
        "have the columns set, quantity, and one of weight, spacing_m or scanline_trend_deg with "
        "scanline_plunge_deg. In a scenario, each plane that cuts the rock mass is a pole. Wedge sliding and "
        "direct toppling are tested on the lines of intersection of all pairs. The lateral limits apply to "
        "planar sliding and to direct and flexural toppling, not to wedges.");
    return {app, [options] { return analyse(*options); }};
}

}  // namespace talus::tools
