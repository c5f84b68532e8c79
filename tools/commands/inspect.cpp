// talus inspect: what is in a snapshot file.

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "inspect/views.h"

namespace talus::tools {

namespace {

struct InspectOptions {
    Common common;
    std::string file, frame = "last", block, difference, by = "displacement";
    std::vector<std::string> interface;
    std::size_t top = 0;
    bool verify = false, csv = false, frame_given = false;
};

View viewOf(formats::SnapshotReader& reader, const InspectOptions& options) {
    if (options.verify) return viewVerify(reader);
    if (!options.difference.empty()) {
        formats::SnapshotReader other = openSnapshot(options.difference);
        return viewDifference(reader, other, options.difference);
    }
    const bool whole =
        !options.frame_given && options.block.empty() && options.interface.empty() && options.top == 0;
    if (whole) return viewSummary(reader, options.file);
    const std::size_t frame = frameIndex(reader, options.frame, options.file);
    if (!options.block.empty()) return viewBlock(reader, frame, options.block, options.file);
    if (!options.interface.empty())
        return viewInterface(reader, frame, options.interface[0], options.interface[1], options.file);
    if (options.top > 0) return viewTop(reader, frame, options.top, options.by);
    return viewFrame(reader, frame);
}

std::string factText(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return Table{{""}, {{value}}}.text().substr(1);
    return jsonText(value);
}

/// "key: value" lines; lists of texts one a line, lists of objects as a table of their own.
std::string factsText(const Json& facts) {
    std::string lines;
    for (const auto& [key, value] : facts.items()) {
        if (value.is_null() || (value.is_array() && value.empty())) continue;
        if (value.is_object()) {
            for (const auto& [inner, part] : value.items())
                lines += key + "." + inner + ": " + factText(part) + "\n";
        } else if (value.is_array() && value[0].is_object()) {
            for (const Json& item : value) lines += factsText(item);
        } else if (value.is_array() && value[0].is_string()) {
            for (const Json& item : value) lines += key + ": " + item.get<std::string>() + "\n";
        } else {
            std::string fact = key + ": " + factText(value);
            while (fact.ends_with("\n")) fact.pop_back();
            lines += fact + "\n";
        }
    }
    return lines;
}

/// A long history is for --csv and --json; the text shows its first and last frames.
std::string tableText(const Table& table) {
    constexpr std::size_t kEnds = 6;
    if (table.rows.empty()) return "";
    if (table.columns.front() != "frame" || table.rows.size() <= 2 * kEnds) return "\n" + table.text();
    Table ends{table.columns, {}};
    ends.rows.assign(table.rows.begin(), table.rows.begin() + kEnds);
    ends.rows.insert(ends.rows.end(), table.rows.end() - kEnds, table.rows.end());
    std::string lines = "\n" + ends.text();
    std::size_t at = 1;
    for (std::size_t k = 0; k < kEnds; ++k) at = lines.find('\n', at) + 1;
    at = lines.find('\n', at) + 1;
    return lines.insert(
        at, "... " + std::to_string(table.rows.size() - 2 * kEnds) + " more rows; --csv prints all\n");
}

int inspect(const InspectOptions& options) {
    const EndsAtOnce reading = whileReading(options.file, options.common);
    formats::SnapshotReader reader = openSnapshot(options.file);
    const View view = viewOf(reader, options);
    for (const std::string& fault : reader.faults())
        note(options.common, "note: " + options.file + ": " + fault);
    if (options.common.json) {
        Json json = view.facts;
        json["file"] = options.file;
        if (!view.table_name.empty()) json[view.table_name] = view.table.json();
        printJson(json);
    } else if (options.csv) {
        printText(view.table.csv());
    } else {
        printResult(view.title + "\n" + factsText(view.facts));
        printText(tableText(view.table));
    }
    const bool unsound = options.verify && !view.facts.at("sound").get<bool>();
    return unsound ? kBadInput : kDone;
}

}  // namespace

Command addInspect(CLI::App& root) {
    auto options = std::make_shared<InspectOptions>();
    CLI::App* app = root.add_subcommand(
        "inspect", "Contents of a snapshot file: frames, blocks, contacts, and whether it is sound");
    app->add_option("FILE", options->file, "Snapshot file of talus run (.mcap)")->required();
    auto* frame = app->add_option("--frame", options->frame,
                                  "Frame to print: last, a number from 0, or a time such as 0.05 or 2s")
                      ->capture_default_str();
    auto* block = app->add_option("--block", options->block,
                                  "Pose and velocity of a block, and its contact forces by neighbour");
    auto* interface =
        app->add_option("--interface", options->interface,
                        "Every contact point between two blocks: N, S, P, area, state, mobilised friction")
            ->expected(2);
    auto* top = app->add_option("--top", options->top,
                                "Print the N blocks with the largest displacement, velocity or rotation")
                    ->check(CLI::PositiveNumber);
    app->add_option("--by", options->by, "Quantity that --top sorts by")
        ->check(CLI::IsMember({"displacement", "velocity", "rotation"}))
        ->capture_default_str()
        ->needs(top);
    auto* verify = app->add_flag("--verify", options->verify,
                                 "Check every checksum and state hash; exit code 2 if one is wrong");
    auto* difference =
        app->add_option("--diff", options->difference,
                        "Compare with another file; print the first frame and field that differ");
    for (auto* one : {block, interface, top, static_cast<CLI::Option*>(verify), difference})
        for (auto* other : {block, interface, top, static_cast<CLI::Option*>(verify), difference})
            if (one != other) one->excludes(other);
    auto* csv = app->add_flag("--csv", options->csv, "Print the table as CSV");
    addCommon(*app, options->common, false);
    csv->excludes("--json");
    app->footer(
        "Examples:\n  talus inspect run.mcap\n  talus inspect run.mcap --top 10 --by velocity --frame 0.05\n "
        " talus inspect run.mcap --interface c1r1s1 floor --json\n\nContacts are stored only in full states. "
        "The last full state up to the frame is shown, with its time\n(contacts_at_s). A file that is still "
        "being written, or was cut off, is read up to its last whole record.");
    return {app, [options, frame] {
                options->frame_given = frame->count() > 0;
                return inspect(*options);
            }};
}

}  // namespace talus::tools
