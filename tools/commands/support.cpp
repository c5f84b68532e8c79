// talus support: the pretension, or the number of bolts, required for a factor of safety.

#include <CLI/CLI.hpp>
#include <memory>

#include "answers/support_design.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

struct SupportOptions {
    Common common;
    ScenarioInput scenario;
    SupportQuestion question;
};

int design(const SupportOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    ProgressPrinter progress(options.common);
    const SupportDesign found =
        designSupport(options.question, scenario, controlOf(options.common, progress));
    progress.finish();
    if (options.common.json)
        printJson(supportDesignJson(options.question, found, scenario, options.common));
    else
        printResult(supportDesignText(options.question, found, scenario));
    return exitCode(found);
}

}  // namespace

Command addSupport(CLI::App& root) {
    auto options = std::make_shared<SupportOptions>();
    SupportQuestion& question = options->question;
    CLI::App* app = root.add_subcommand(
        "support",
        "The pretension of bolts, or the number of bolts of a pattern, that a factor of safety requires");
    addScenario(*app, options->scenario);
    app->add_option("--factor", question.factor, "Required factor of safety")
        ->check(CLI::Range(0.01, 99.0))
        ->capture_default_str();
    app->add_option_function<std::string>(
           "--by",
           [&question](const std::string& by) {
               question.by = by == "number" ? DesignedBy::number : DesignedBy::pretension;
           },
           "What to find: pretension (default), or number of bolts of a pattern")
        ->check(CLI::IsMember({"pretension", "number"}))
        ->type_name("WHAT");
    app->add_option("--bolt", question.bolt, "A [[bolt]] or [[bolt_pattern]] by its name (default: all)")
        ->type_name("NAME");
    app->add_option("--tolerance", question.tolerance,
                    "Width of the bracket of the pretension, as a share of the yield force")
        ->check(CLI::Range(1e-4, 0.5))
        ->capture_default_str();
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus support slope.toml --factor 1.5\n  talus support slope.toml --factor 1.3 --by "
        "number --bolt P\n  talus support slope.toml --json | jq .answer.pretension_n\n\nEach trial is a "
        "search for the factor of safety.\n\nBy pretension: each bolt pulls with the same share of its "
        "yield_force, constant from the start, as limit\nequilibrium counts an anchor. The share is at most "
        "1.\n\nBy number: the spacing of the pattern is scaled along and up the face alike, and in the end "
        "one of them alone. It is\nscaled from an eighth of its own value until one bolt is left. The "
        "spacing along the face is the width over the\nnumber of bolts in a row. A slice then has the force "
        "per metre of a wide slope.\n\nThe answer is the smallest amount found to be enough; `set` lists its "
        "--set options. A factor that is reached\nwithout the bolts, or not reached with the largest amount, "
        "is a result (exit code 0). An undecided one is not (exit code 3).");
    return {app, [options] { return design(*options); }};
}

}  // namespace talus::tools
