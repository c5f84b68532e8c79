// talus safety-factor: strength reduction at the scenario's own tilt.

#include <cmath>
#include <memory>

#include "command.h"
#include "search_report.h"

namespace talus::tools {

namespace {

struct SafetyFactorOptions {
    Common common;
    std::string scenario;
    bool verbose = false;
    int groups = 1;
    KeepRunOptions keep;
};

/// tan(phi) and C of every joint, peak and residual, over `factor`.
std::vector<Joint> reduced(std::vector<Joint> joints, double factor) {
    for (Joint& joint : joints) {
        joint.friction = std::atan(std::tan(joint.friction) / factor);
        joint.residual_friction = std::atan(std::tan(joint.residual_friction) / factor);
        joint.cohesion /= factor;
        joint.residual_cohesion /= factor;
    }
    return joints;
}

/// The closed formulas at reduced strength, at the model's own tilt.
class ReducedTheory {
 public:
    explicit ReducedTheory(const Model& model)
        : model_(model), joints_(model.joints), tilt_(model.gravity.tilt) {
        model_.analysis.start.reset();  // the question is about this tilt, not about where a search starts
    }

    std::optional<theory::Prediction> at(double factor) {
        model_.joints = reduced(joints_, factor);
        return theory::predict(model_);
    }
    bool slides(double factor) {
        const auto prediction = at(factor);
        return prediction && !prediction->topples && prediction->critical_tilt <= tilt_;
    }
    double tilt() const { return tilt_; }

 private:
    Model model_;
    std::vector<Joint> joints_;
    double tilt_;
};

/// The strength reduction at which the predicted critical tilt is the model's own tilt. Nothing where no formula
/// applies, and nothing where overturning decides: strength has no part in that. The formulas may be silent for strong
/// joints (columns lean) and for weak ones (water pushes uphill), so the first factor that slides is sought upwards.
std::optional<TheoryFigure> theoryOf(const Model& model) {
    constexpr double kLowest = 0.02, kHighest = 50, kRatio = 1.05;
    ReducedTheory theory(model);
    if (theory.slides(kLowest)) return std::nullopt;  // whatever the strength: nothing to divide
    double high = kLowest;
    while (high < kHighest && !theory.slides(high)) high *= kRatio;
    double low = high / kRatio;
    while (high / low > 1 + 1e-13) {
        const double middle = 0.5 * (low + high);
        (theory.slides(middle) ? high : low) = middle;
    }
    auto prediction = theory.at(high);
    if (prediction) prediction->formula = "with strengths divided by it: " + prediction->formula;
    const bool at_limit =
        prediction && !prediction->topples && std::abs(prediction->critical_tilt - theory.tilt()) < 1e-9;
    return at_limit ? std::optional(TheoryFigure{high, *prediction}) : std::nullopt;
}

Json groupsJson(const SearchResult& result) {
    Json groups = Json::array();
    for (const BlockGroup& group : result.groups)
        groups.push_back({{"factor", number(group.factor)}, {"blocks", group.blocks}});
    return groups;
}

std::string groupsText(const SearchResult& result) {
    std::string text_of_groups;
    for (std::size_t k = 1; k < result.groups.size(); ++k)
        text_of_groups += "then at           " + text(result.groups[k].factor, 4) + ": " +
                          compactNames(result.groups[k].blocks) + "\n";
    return text_of_groups;
}

Json toJson(const SearchReport& report) {
    Json json{{"status", statusText(report.result.status)},
              {"safety_factor", answerJson(report)},
              {"bracket", bracketJson(report)},
              {"theory_factor", report.theory ? number(report.theory->value) : Json(nullptr)},
              {"tilt_deg", number(degrees(report.scenario.model.gravity.tilt))}};
    json["groups"] = groupsJson(report.result);
    addSearchJson(json, report);
    return json;
}

int findSafetyFactor(const SafetyFactorOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    FailureKeeper keeper(options.keep, options.common, scenario);
    ProgressPrinter progress(options.common);
    Control control = controlOf(options.common, progress);
    control.keep_failing_state = keeper.wanted();
    control.groups = options.groups;
    const SearchResult result = valueOf(safetyFactor(scenario.model, control), scenario);
    SearchReport report{
        options.common, scenario, result, {"safety factor", "factor", "", 1, 4}, theoryOf(scenario.model)};
    if (keeper.wanted()) report.kept = keeper.keep(result, SearchKind::safety_factor, control);
    progress.finish();
    if (options.common.json) {
        printJson(toJson(report));
    } else {
        printText(searchText(report, options.verbose) + groupsText(result));
    }
    return exitCode(report);
}

}  // namespace

Command addSafetyFactor(CLI::App& root) {
    auto options = std::make_shared<SafetyFactorOptions>();
    CLI::App* app = root.add_subcommand("safety-factor",
                                        "Factor of safety by strength reduction, at the scenario's tilt");
    app->add_option("SCENARIO", options->scenario, "Scenario file (TOML)")->required();
    app->add_flag("--verbose", options->verbose, "Also print every probe and every block's motion");
    app->add_option(
           "--groups", options->groups,
           "How many groups of blocks to follow: after the answer, the search goes on without those that "
           "have gone, at the cost of a search each")
        ->check(CLI::Range(1, 1000));
    addKeepRun(*app, options->keep);
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus safety-factor slope.toml\n  talus safety-factor slope.toml --json | jq "
        ".safety_factor\n  talus safety-factor slope.toml --keep-run failing.mcap && talus replay "
        "failing.mcap -o "
        "failing.html\n\ntan(phi) and C of all joints are divided by the factor; the answer is the factor "
        "at "
        "which the assembly first fails.");
    return {app, [options] { return findSafetyFactor(*options); }};
}

}  // namespace talus::tools
