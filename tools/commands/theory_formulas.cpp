// The formulas that take numbers.

#include "commands/theory_formulas.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/text.h"
#include "reproduction/laboratory.h"
#include "talus/theory.h"

namespace talus::tools {

namespace {

/// CLI11's own number checks let nan pass.
CLI::Validator finite(std::function<bool(double)> allowed, const std::string& words) {
    return CLI::Validator(
        [allowed = std::move(allowed), words](const std::string& word) {
            double value = 0;
            const bool ok = CLI::detail::lexical_cast(word, value) && std::isfinite(value) && allowed(value);
            return ok ? std::string() : "found '" + word + "', allowed: " + words;
        },
        words);
}

}  // namespace

CLI::Validator within(double low, double high) {
    return finite([low, high](double value) { return value >= low && value <= high; },
                  text(low, 1) + " to " + text(high, 1));
}

namespace {

/// One line of output: its key in JSON, its words, and the value in their common unit.
struct Figure {
    std::string key, words;
    double value;
    std::string unit;
};

int print(const Common& common, const std::vector<Figure>& figures, const std::string& formula) {
    if (common.json) {
        Json json;
        for (const Figure& figure : figures) json[figure.key] = number(figure.value);
        json["formula"] = formula;
        printJson(json);
        return kDone;
    }
    std::string lines = formula + "\n";
    for (const Figure& figure : figures)
        lines += figure.words + ": " + text(figure.value, 4) +
                 (figure.unit.empty() ? "" : " " + figure.unit) + "\n";
    printResult(lines);
    return kDone;
}

CLI::Option* positive(CLI::Option* option) {
    return option->check(finite([](double value) { return value > 0; }, "above 0"));
}
CLI::Option* notNegative(CLI::Option* option) {
    return option->check(finite([](double value) { return value >= 0; }, "0 or more"));
}

void rejectDeepWater(const theory::SlidingMass& mass) {
    if (mass.water_depth > mass.height)
        throw BadInput(Error{"--water-depth", text(mass.water_depth, 4) + " m is more than the height of " +
                                                  text(mass.height, 4) + " m"});
}

}  // namespace

CLI::App* addFormula(CLI::App& parent, Common& common, const std::string& name, const std::string& what,
                     const std::string& example) {
    CLI::App* app = parent.add_subcommand(name, what);
    addCommon(*app, common, false);
    app->footer("Example:\n  talus theory " + name + " " + example);
    return app;
}

// --- sliding
// --------------------------------------------------------------------------------------------------------

namespace {

struct SlidingOptions {
    theory::SlidingMass mass{0.4, 0.5, 2700, 1000, 0, 0, 0, 9.81};
    double friction_deg = 0;
    std::optional<double> tilt_deg;
};

int sliding(const Common& common, SlidingOptions options) {
    rejectDeepWater(options.mass);
    options.mass.friction = radians(options.friction_deg);
    std::vector<Figure> figures{
        {"critical_angle_deg", "critical angle", degrees(theory::criticalTiltSliding(options.mass)), "deg"}};
    if (options.tilt_deg)
        figures.push_back({"safety_factor", "factor of safety at " + text(*options.tilt_deg, 4) + " deg",
                           theory::factorOfSafetySliding(options.mass, radians(*options.tilt_deg)), ""});
    return print(common, figures,
                 options.mass.cohesion > 0 ? "sliding mass: W sin(beta) + rho_w g H^2/2 cos(beta) = W "
                                             "cos(beta) tan(phi) + C x, W = rho g x h"
                                           : "sliding mass: tan(beta) = tan(phi) - rho_w H^2 / (2 rho x h)");
}

void addMassOptions(CLI::App& app, theory::SlidingMass& mass) {
    positive(app.add_option("--length", mass.length, "Length x of the mass along the plane [m]"))->required();
    positive(app.add_option("--height", mass.height, "Height h of the mass [m]"))->required();
    positive(app.add_option("--density", mass.density, "Density of the rock [kg/m^3]"))
        ->capture_default_str();
    positive(app.add_option("--water-density", mass.water_density, "[kg/m^3]"))->capture_default_str();
    notNegative(app.add_option("--water-depth", mass.water_depth, "Depth H of the water behind it [m]"))
        ->capture_default_str();
}

}  // namespace

Command addSliding(CLI::App& parent, std::shared_ptr<Common> common) {
    auto options = std::make_shared<SlidingOptions>();
    CLI::App* app = addFormula(parent, *common, "sliding",
                               "A mass sliding on a plane, with water behind it (eqs 10-17, corrected)",
                               "--length 0.4 --height 0.5 --water-depth 0.35 --friction 19.5 --tilt 10");
    addMassOptions(*app, options->mass);
    app->add_option("--friction", options->friction_deg, "Friction angle phi [deg]")
        ->required()
        ->check(within(0., 89.));
    notNegative(app->add_option("--cohesion", options->mass.cohesion, "C [Pa]"))->capture_default_str();
    positive(
        app->add_option("--gravity", options->mass.gravity, "Gravity; it matters only with cohesion [m/s^2]"))
        ->capture_default_str();
    app->add_option("--tilt", options->tilt_deg, "Also compute the factor of safety at this tilt [deg]")
        ->check(within(-89., 89.));
    return {app, [common, options] { return sliding(*common, *options); }};
}

// --- toppling
// -------------------------------------------------------------------------------------------------------

namespace {

int toppling(const Common& common, const theory::SlidingMass& mass) {
    rejectDeepWater(mass);
    const double tilt = theory::criticalTiltToppling(mass.length, mass.height, mass.density, mass.water_depth,
                                                     mass.water_density);
    return print(common, {{"critical_angle_deg", "critical angle", degrees(tilt), "deg"}},
                 "overturning about the toe: tan(beta) = x/h - rho_w H^3 / (3 rho x h^2)");
}

}  // namespace

Command addToppling(CLI::App& parent, std::shared_ptr<Common> common) {
    auto mass =
        std::make_shared<theory::SlidingMass>(theory::SlidingMass{0.2, 0.5, 2700, 1000, 0, 0, 0, 9.81});
    CLI::App* app = addFormula(parent, *common, "toppling", "A single body overturning about its toe",
                               "--length 0.2 --height 0.5 --water-depth 0.35");
    addMassOptions(*app, *mass);
    return {app, [common, mass] { return toppling(*common, *mass); }};
}

// --- tension crack
// --------------------------------------------------------------------------------------------------

namespace {

struct CrackOptions {
    theory::TensionCrack slope;
    double face_deg = 0, plane_deg = 0, friction_deg = 0;
};

void rejectWrongCrack(const theory::TensionCrack& slope, const theory::TensionCrackResult& result) {
    if (!(slope.plane < slope.face)) throw BadInput(Error{"--plane", "must be flatter than the face"});
    if (!(result.crack_depth > 0))
        throw BadInput(Error{"--crest-distance",
                             "the plane meets the crest in front of the crack; move the crack "
                             "closer, or take a flatter plane"});
    if (slope.crack_water_depth > result.crack_depth)
        throw BadInput(Error{"--water-depth", text(slope.crack_water_depth, 4) +
                                                  " m is more than the depth of the crack, " +
                                                  text(result.crack_depth, 4) + " m"});
}

int crack(const Common& common, CrackOptions options) {
    options.slope.face = radians(options.face_deg);
    options.slope.plane = radians(options.plane_deg);
    options.slope.friction = radians(options.friction_deg);
    const theory::TensionCrackResult result = theory::planeFailure(options.slope);
    rejectWrongCrack(options.slope, result);
    return print(
        common,
        {{"safety_factor", "factor of safety", result.factor_of_safety, ""},
         {"crack_depth_m", "crack depth", result.crack_depth, "m"},
         {"base_area_m2_m", "base area", result.base_area, "m2/m"},
         {"weight_n_m", "weight", result.weight, "N/m"},
         {"uplift_n_m", "uplift U", result.uplift, "N/m"},
         {"thrust_n_m", "thrust V", result.thrust, "N/m"}},
        "plane failure with a tension crack (Hoek and Bray): FS = [C A + (W cos p - U - V sin p) tan phi] / "
        "(W sin p + V cos p)");
}

}  // namespace

Command addCrack(CLI::App& parent, std::shared_ptr<Common> common) {
    auto options = std::make_shared<CrackOptions>();
    theory::TensionCrack& slope = options->slope;
    CLI::App* app =
        addFormula(parent, *common, "crack", "Plane failure with a water-filled tension crack",
                   "--slope-height 12 --face 60 --plane 35 --crest-distance 4 --cohesion 25000 --friction "
                   "37 --water-depth 2");
    positive(app->add_option("--slope-height", slope.slope_height, "[m]"))->required();
    app->add_option("--face", options->face_deg, "Dip of the slope's face [deg]")
        ->required()
        ->check(within(1., 89.));
    app->add_option("--plane", options->plane_deg, "Dip of the failure plane [deg]")
        ->required()
        ->check(within(1., 89.));
    notNegative(app->add_option("--crest-distance", slope.crest_distance,
                                "Distance of the crack behind the crest [m]"))
        ->required();
    app->add_option("--friction", options->friction_deg, "phi [deg]")->required()->check(within(0., 89.));
    notNegative(app->add_option("--cohesion", slope.cohesion, "C [Pa]"))->capture_default_str();
    positive(app->add_option("--unit-weight", slope.unit_weight, "Unit weight of the rock [N/m^3]"))
        ->capture_default_str();
    positive(app->add_option("--water-unit-weight", slope.water_unit_weight, "[N/m^3]"))
        ->capture_default_str();
    notNegative(
        app->add_option("--water-depth", slope.crack_water_depth, "Depth of the water in the crack [m]"))
        ->capture_default_str();
    return {app, [common, options] { return crack(*common, *options); }};
}

// --- the paper's 6 %
// ------------------------------------------------------------------------------------------------

namespace {

struct DropOptions {
    double ratio = 3, density = 2700, water_density = 1000, friction_deg = kTableFrictionDeg;
};

int drop(const Common& common, const DropOptions& options) {
    const theory::SlidingMass mass{
        options.ratio, 1, options.density, options.water_density, 1, radians(options.friction_deg), 0, 9.81};
    const double tan_phi = std::tan(mass.friction), tilt = theory::criticalTiltSliding(mass);
    return print(common,
                 {{"tangent_drop", "tan(phi) - tan(beta)", tan_phi - std::tan(tilt), ""},
                  {"share_of_tan_friction_percent", "as a share of tan(phi)",
                   100 * (1 - std::tan(tilt) / tan_phi), "%"},
                  {"critical_angle_deg", "critical angle", degrees(tilt), "deg"},
                  {"angle_drop_deg", "below the dry one by", options.friction_deg - degrees(tilt), "deg"}},
                 "a fissure full to the top, x/y times as far from the toe as it is deep (eq 17 without its "
                 "stray g): tan(phi) - tan(beta) = rho_w y / (2 rho x). The paper takes the drop of 0.06 for "
                 "an error of 6 %; the share of tan(phi) is given below");
}

}  // namespace

Command addDrop(CLI::App& parent, std::shared_ptr<Common> common) {
    auto options = std::make_shared<DropOptions>();
    CLI::App* app =
        addFormula(parent, *common, "drop",
                   "How much a full fissure lowers the critical angle: the paper's 6 %", "--ratio 3");
    positive(app->add_option("--ratio", options->ratio, "x/y: distance from the toe over depth"))
        ->capture_default_str();
    positive(app->add_option("--density", options->density, "Density of the rock [kg/m^3]"))
        ->capture_default_str();
    positive(app->add_option("--water-density", options->water_density, "[kg/m^3]"))->capture_default_str();
    app->add_option("--friction", options->friction_deg, "phi [deg]")
        ->check(within(0.1, 89.))
        ->capture_default_str();
    return {app, [common, options] { return drop(*common, *options); }};
}

}  // namespace talus::tools
