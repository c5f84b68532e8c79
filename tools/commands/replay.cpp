// talus replay: a run played again, as a page for the browser, as a summary in the terminal, or computed
// anew.

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "inspect/views.h"
#include "recording/keep_mechanism.h"
#include "recording/verify.h"
#include "replay/page.h"
#include "replay/terminal.h"

namespace talus::tools {

namespace {

constexpr double kHeavyPageBytes = 300e6;  // browsers take long for more, or refuse

struct ReplayOptions {
    Common common;
    std::string file, output;
    FrameChoice choice;
    std::size_t rows = 15;
    bool verify = false, force = false, without_contacts = false;
};

int writePage(formats::SnapshotReader& reader, const ReplayOptions& options) {
    refuseToReplace(options.output, options.file, options.force);
    const std::string page = [&] {
        const EndsAtOnce reading = whileReading(options.file, options.common);
        return replayPage(snapshotBytes(reader, options.file, options.choice));
    }();
    writeFile(options.output, page);
    if (static_cast<double>(page.size()) > kHeavyPageBytes)
        note(options.common,
             "note: a page of " + text(static_cast<double>(page.size()) / 1e6, 0) +
                 " MB may be slow in a browser; --every, --from, --to or --no-contacts make it smaller");
    if (options.common.json) {
        printJson({{"file", options.file},
                   {"page", options.output},
                   {"bytes", page.size()},
                   {"frames_in_file", reader.frames().size()}});
    } else {
        printResult(options.output + ": " + text(static_cast<double>(page.size()) / 1e6, 2) +
                    " MB; opens in any browser, without a network\n");
    }
    return kDone;
}

int showCourse(formats::SnapshotReader& reader, const ReplayOptions& options) {
    const View view = viewSummary(reader, options.file);
    if (options.common.json) {
        Json json{{"file", options.file}};
        for (const char* key :
             {"scenario", "blocks", "ended", "reached_s", "state_hash", "warnings", "faults"})
            if (view.facts.contains(key)) json[key] = view.facts[key];
        json["frames"] = view.table.json();
        printJson(json);
        return kDone;
    }
    const auto end = reader.end();
    std::string head = options.file + ": " + reader.header().scenario_path + ", " +
                       std::to_string(reader.header().names.size()) + " blocks, " +
                       std::to_string(reader.frames().size()) + " frames, " +
                       (end ? end->ended : "not finished: the run is still going on or was killed") + "\n\n";
    printResult(head);
    printText(courseText(view.table, options.rows, terminalSpeaksUnicode()));
    return kDone;
}

Json stretchesJson(const Verification& found) {
    Json list = Json::array();
    for (const Stretch& stretch : found.stretches)
        list.push_back({{"from_s", number(stretch.from)},
                        {"to_s", number(stretch.to)},
                        {"frames", stretch.frames},
                        {"equal", stretch.fault.empty()},
                        {"fault", stretch.fault.empty() ? Json(nullptr) : Json(stretch.fault)}});
    return list;
}

int verify(formats::SnapshotReader& reader, const ReplayOptions& options) {
    const auto& failure = reader.header().failure;
    const bool was_run = !failure || mechanismLoad(failure->analysis) == nullptr;
    const char* found_instead = "found the mechanism of a limit analysis, which was not computed as a run";
    if (!was_run) throw BadInput(Error{"--verify", found_instead, options.file});
    const bool same = sameBuild(reader.header());
    if (!same)
        note(options.common, "warning: the file was written by another build (" +
                                 reader.header().build.version + ", " + reader.header().build.git_hash +
                                 ", " + reader.header().build.compiler +
                                 "): this build may not reproduce it to the bit");
    ProgressPrinter progress(options.common, Fraction::of_time);
    const Verification found = verifyRun(reader, options.common, progress.callback());
    progress.finish();
    if (options.common.json) {
        printJson({{"file", options.file},
                   {"equal", found.equal()},
                   {"same_build", same},
                   {"frames", found.frames},
                   {"interrupted", found.interrupted},
                   {"stretches", stretchesJson(found)}});
    } else {
        std::string lines;
        for (const Stretch& stretch : found.stretches)
            if (!stretch.fault.empty())
                lines +=
                    text(stretch.from, 6) + " s to " + text(stretch.to, 6) + " s: " + stretch.fault + "\n";
        const std::string what = std::to_string(found.frames) + " frames in " +
                                 std::to_string(found.stretches.size()) + " intervals recomputed: ";
        printResult(options.file + ": " + what +
                    (found.interrupted ? "interrupted\n"
                     : found.equal()   ? "all state hashes agree\n"
                                       : "state hashes differ\n") +
                    lines);
    }
    return found.interrupted ? kInterrupted : found.equal() ? kDone : kBadInput;
}

int replay(ReplayOptions& options) {
    options.choice.contacts = !options.without_contacts;
    if (!options.output.empty()) requireEnding("--output", options.output, {".html", ".htm"});
    formats::SnapshotReader reader = openSnapshot(options.file);
    for (const std::string& fault : reader.faults())
        note(options.common, "note: " + options.file + ": " + fault);
    requireFrames(reader, options.file);
    if (options.verify) return verify(reader, options);
    return options.output.empty() ? showCourse(reader, options) : writePage(reader, options);
}

}  // namespace

Command addReplay(CLI::App& root) {
    auto options = std::make_shared<ReplayOptions>();
    CLI::App* app = root.add_subcommand("replay", "Play a run in a browser page or in the terminal");
    app->add_option("FILE", options->file, "Snapshot file of talus run (.mcap)")->required();
    auto* output = app->add_option("-o,--output", options->output,
                                   "Write one self-contained HTML page that plays the run; without it a "
                                   "summary is printed");
    for (auto* option :
         {app->add_option("--from", options->choice.from, "First time in the page [s]")
              ->check(CLI::NonNegativeNumber),
          app->add_option("--to", options->choice.to, "Last time in the page [s]")
              ->check(CLI::NonNegativeNumber),
          app->add_option("--every", options->choice.every, "Put only every Nth frame into the page")
              ->check(CLI::Range(1, 1000000000)),
          app->add_flag("--no-contacts", options->without_contacts,
                        "Leave out the full states: a smaller page without forces, joints and water"),
          app->add_flag("--force", options->force,
                        "Replace the output file even if it is not a replay page")})
        option->needs(output);
    app->add_option("--rows", options->rows, "Frames in the printed table")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    app->add_flag("--verify", options->verify,
                  "Recompute the run between its full states and compare every state hash; exit code 2 if "
                  "one differs")
        ->excludes(output);
    addCommon(*app, options->common);
    app->footer(
        "Examples:\n  talus replay run.mcap -o run.html\n  talus replay run.mcap\n  talus replay run.mcap "
        "--verify\n\nThe page needs no network and no other file. A link can open it at a given time and "
        "view:\nrun.html#t=0.2&colour=role&joints&select=c1r1s1. A snapshot file that is still being "
        "written, or was cut off, is\nplayed up to its last whole frame.");
    return {app, [options] { return replay(*options); }};
}

}  // namespace talus::tools
