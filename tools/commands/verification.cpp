// talus verification: every row of bench/verification/rows.csv computed again, beside its reference.

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "report/page.h"
#include "verification/manual.h"

namespace talus::tools {

namespace {

struct VerificationOptions {
    Common common;
    std::string out = "talus-verification";
    bool quick = false, accept_stated = false;
    std::string only;  ///< in a row's name, section or scenario
};

bool isWanted(const VerificationRow& row, const VerificationOptions& options) {
    if (options.quick && row.seconds > kQuickSeconds) return false;
    for (const std::string* text : {&row.name, &row.section, &row.scenario})
        if (text->find(options.only) != std::string::npos) return true;
    return false;
}

std::vector<VerificationRow> wantedRows(const VerificationOptions& options) {
    std::vector<VerificationRow> rows = verificationRows();
    std::erase_if(rows, [&](const VerificationRow& row) { return !isWanted(row, options); });
    if (rows.empty())
        throw BadInput(
            Error{"--only", "no row's name, section or scenario contains \"" + options.only + "\""});
    return rows;
}

Manual compute(const VerificationOptions& options) {
    const std::vector<VerificationRow> rows = wantedRows(options);
    ProgressPrinter printer(options.common, Fraction::of_time);
    const auto begin = std::chrono::steady_clock::now();
    Manual manual{.rows = verify(rows, threadsUsed(options.common), stopRequested(), printer.callback()),
                  .quick = options.quick,
                  .interrupted = stopRequested(),
                  .wall_seconds = 0,
                  .provenance = provenance(options.common, "")};
    manual.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return manual;
}

void writeAll(const Manual& manual, const std::string& out) {
    makeFolder(out + "/scenarios");
    for (const VerifiedRow& row : manual.rows)
        writeFile(out + "/scenarios/" + scenarioName(row.what) + ".toml", scenarioText(row.what));
    writeFile(out + "/rows.csv", manualCsv(manual));
    const Json report = manualReport(manual);
    writeFile(out + "/index.json", jsonText(report) + '\n');
    writeFile(out + "/index.html", reportPage(report));
}

int execute(const VerificationOptions& options) {
    makeFolder(options.out);  // a folder that cannot be made is reported before minutes of computing
    const Manual manual = compute(options);
    writeAll(manual, options.out);
    if (options.common.json)
        printJson(manualJson(manual));
    else
        printText(manualText(manual) + "\nPage and table: " + options.out + "/index.html\n");
    if (manual.interrupted) return kInterrupted;
    const std::size_t faults = options.accept_stated ? manual.unexpected() : manual.outside();
    return faults > 0 ? kOutsideBand : kDone;
}

}  // namespace

Command addVerification(CLI::App& root) {
    CLI::App* app = root.add_subcommand(
        "verification",
        "Verification manual: recompute closed forms, values of other programs and laboratory tests");
    const auto options = std::make_shared<VerificationOptions>();
    app->add_option("--out,-o", options->out, "Folder for the page, the table and the scenarios")
        ->capture_default_str();
    app->add_flag("--quick", options->quick, "Only the rows that take seconds");
    app->add_flag(
        "--accept-stated", options->accept_stated,
        "Exit code 0 if every row is as the table states, including known values outside their bands");
    app->add_option("--only", options->only, "Only rows whose name, section or scenario contains this text");
    addCommon(*app, options->common);
    app->footer(
        "Examples:\n  talus verification --quick\n  talus verification --only wedge --json | jq '.rows[] | "
        "{name, value, difference}'\n\nExit code 1: a row is outside its band (red in the page). With "
        "--accept-stated: a row is not as the table states.");
    return {app, [options] { return execute(*options); }};
}

}  // namespace talus::tools
