// talus export: snapshots for ParaView, spreadsheets and CAD.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "recording/snapshot_view.h"
#include "report/table.h"
#include "talus/formats/export.h"

namespace talus::tools {

namespace {

struct ExportOptions {
    Common common;
    std::string file, vtk, csv, stl, ply, gltf, frame, output;
    std::size_t every = 1;
};

std::string numbered(const char* stem, std::size_t frame) {
    char name[48];
    std::snprintf(name, sizeof name, "%s_%06zu.vtp", stem, frame);
    return name;
}

/// The frames to export: every so many, and the last.
std::vector<std::size_t> chosen(const formats::SnapshotReader& reader, std::size_t every) {
    std::vector<std::size_t> frames;
    const std::size_t n = reader.frames().size();
    for (std::size_t k = 0; k < n; k += every) frames.push_back(k);
    if (n > 0 && frames.back() != n - 1) frames.push_back(n - 1);
    return frames;
}

bool stopped() { return stopRequested().load(std::memory_order_relaxed); }

std::string vtkText(const Json& vtk) {
    return jsonText(vtk["block_files"]) + " frames and " + jsonText(vtk["contact_files"]) +
           " sets of contacts in " + vtk["folder"].get<std::string>() +
           " (open blocks.pvd and contacts.pvd)\n";
}

/// Files of the frames, and their lists for ParaView. Where a single frame takes long, the lists are kept up
/// to date, so that the export can be stopped at once.
class VtkExport {
 public:
    VtkExport(formats::SnapshotReader& reader, const ExportOptions& options)
        : reader_(reader), options_(options), folder_(options.vtk) {}

    Json run(ProgressPrinter& progress) {
        makeFolder(options_.vtk);
        const std::vector<std::size_t> frames = chosen(reader_, options_.every);
        for (const std::size_t k : frames) {
            if (isLarge()) writeLists();
            if (stopped() || !exportFrame(k)) break;
            progress.show(
                {"export", static_cast<double>(blocks_.size()) / static_cast<double>(frames.size()), ""});
        }
        writeLists();
        return facts();
    }

 private:
    using Files = std::vector<std::pair<double, std::string>>;

    bool isLarge() const {
        constexpr std::size_t kLarge = 2000;  // blocks: some hundredths of a second a frame
        return reader_.header().names.size() > kLarge;
    }

    Json facts() const {
        return {
            {"folder", options_.vtk}, {"block_files", blocks_.size()}, {"contact_files", contacts_.size()}};
    }

    void writeLists() {
        writeFile(folder_ / "blocks.pvd", formats::pvdSeries(blocks_));
        writeFile(folder_ / "contacts.pvd", formats::pvdSeries(contacts_));
    }

    /// False when it is stopped.
    bool exportFrame(std::size_t k) {
        const double time = reader_.frames()[k].time;
        const auto blocks = [&] { return formats::vtpBlocks(reader_.header(), valueOf(reader_.frame(k))); };
        if (!write(time, numbered("blocks", k), blocks, blocks_)) return false;
        if (!reader_.frames()[k].full) return true;
        if (isLarge()) writeLists();
        const auto contacts = [&] {
            return formats::vtpContacts(valueOf(reader_.full(*reader_.frames()[k].full)));
        };
        return write(time, numbered("contacts", k), contacts, contacts_);
    }

    template <class Make>
    bool write(double time, const std::string& name, const Make& make, Files& files) {
        std::string bytes;
        {
            std::optional<EndsAtOnce> making;
            if (isLarge()) making.emplace(onStdout(), "interrupted: only the finished part was exported\n");
            if (stopped()) return false;
            bytes = make();
        }
        if (!writeFile(folder_ / name, bytes, &stopRequested())) return false;
        files.emplace_back(time, name);
        return true;
    }

    /// The message of an immediate stop.
    std::string onStdout() const {
        const Json json = {{"frames", reader_.frames().size()}, {"vtk", facts()}, {"interrupted", true}};
        return options_.common.json ? jsonText(json, 2) + "\n" : vtkText(json["vtk"]);
    }

    formats::SnapshotReader& reader_;
    const ExportOptions& options_;
    std::filesystem::path folder_;
    Files blocks_{}, contacts_{};
};

/// One row a frame and block.
Json exportCsv(formats::SnapshotReader& reader, const ExportOptions& options) {
    const formats::SnapshotHeader& header = reader.header();
    Table table;
    table.columns = {"frame", "time_s", "block",  "x_m",    "y_m",    "z_m",    "dx_m",   "dy_m",
                     "dz_m",  "vx_m_s", "vy_m_s", "vz_m_s", "rx_deg", "ry_deg", "rz_deg", "failure_role"};
    const std::string rows = [&] {
        const EndsAtOnce reading = whileReading(options.file, options.common);
        for (const std::size_t k : chosen(reader, options.every)) {
            const LightFrame frame = valueOf(reader.frame(k));
            const std::vector<FailureMode> roles = formats::failureRoles(header, frame);
            for (std::size_t b = 0; b < header.names.size(); ++b) {
                const Vec3 moved = get(frame.displacement, b), x = get(header.geometry.centroid, b) + moved;
                const Vec3 v = get(frame.velocity, b), r = get(frame.rotation, b) / kDegree;
                table.rows.push_back({k, number(frame.time), header.names[b], number(x.x()), number(x.y()),
                                      number(x.z()), number(moved.x()), number(moved.y()), number(moved.z()),
                                      number(v.x()), number(v.y()), number(v.z()), number(r.x()),
                                      number(r.y()), number(r.z()), toString(roles[b])});
            }
        }
        return table.csv();
    }();
    writeFile(options.csv, rows);
    return {{"file", options.csv}, {"rows", table.rows.size()}};
}

/// One frame as a file of another program: STL, PLY.
Json exportFrame(formats::SnapshotReader& reader, const ExportOptions& options, const std::string& which,
                 const char* ending,
                 std::string (*bytes)(const formats::SnapshotHeader&, const LightFrame&)) {
    const std::size_t frame = frameIndex(reader, which, options.file);
    const std::string path = !options.output.empty() ? options.output
                                                     : std::filesystem::path(options.file).stem().string() +
                                                           "-" + std::to_string(frame) + ending;
    const std::string content = [&] {
        const EndsAtOnce reading = whileReading(options.file, options.common);
        return bytes(reader.header(), valueOf(reader.frame(frame)));
    }();
    writeFile(path, content);
    return {{"file", path}, {"frame", frame}};
}

/// The whole run, or the frame that was chosen.
Json exportGltf(formats::SnapshotReader& reader, const ExportOptions& options) {
    std::vector<std::size_t> wanted = chosen(reader, options.every);
    if (!options.frame.empty()) wanted = {frameIndex(reader, options.frame, options.file)};
    const std::string bytes = [&] {
        const EndsAtOnce reading = whileReading(options.file, options.common);
        std::vector<LightFrame> frames;
        frames.reserve(wanted.size());
        for (const std::size_t k : wanted) frames.push_back(valueOf(reader.frame(k)));
        return formats::gltfBlocks(reader.header(), frames);
    }();
    writeFile(options.gltf, bytes);
    return {{"file", options.gltf}, {"frames", wanted.size()}};
}

int exportSnapshot(const ExportOptions& options) {
    if (!options.output.empty() && options.stl.empty() && options.ply.empty())
        throw BadInput(Error{"--output", "is only for --stl and --ply"});
    if (options.vtk.empty() && options.csv.empty() && options.stl.empty() && options.ply.empty() &&
        options.gltf.empty())
        throw BadInput(
            Error{"", "missing; allowed: --vtk DIR, --csv FILE, --gltf FILE, --stl FRAME or --ply FRAME"});
    if (!options.gltf.empty()) requireEnding("--gltf", options.gltf, {".glb"});
    if (!options.csv.empty()) requireEnding("--csv", options.csv, {".csv"});
    if (!options.output.empty())
        requireEnding("--output", options.output, {options.stl.empty() ? ".ply" : ".stl"});
    formats::SnapshotReader reader = [&] {
        const EndsAtOnce reading = whileReading(options.file, options.common);
        return openSnapshot(options.file);
    }();
    for (const std::string& fault : reader.faults())
        note(options.common, "note: " + options.file + ": " + fault);
    requireFrames(reader, options.file);
    ProgressPrinter progress(options.common, Fraction::of_time);
    Json json = {{"frames", reader.frames().size()}};
    if (!options.vtk.empty()) json["vtk"] = VtkExport(reader, options).run(progress);
    if (!options.csv.empty() && !stopped()) json["csv"] = exportCsv(reader, options);
    if (!options.stl.empty() && !stopped())
        json["stl"] = exportFrame(reader, options, options.stl, ".stl", formats::stlBlocks);
    if (!options.ply.empty() && !stopped())
        json["ply"] = exportFrame(reader, options, options.ply, ".ply", formats::plyBlocks);
    if (!options.gltf.empty() && !stopped()) json["gltf"] = exportGltf(reader, options);
    json["interrupted"] = stopped();
    progress.finish();
    if (options.common.json) {
        printJson(json);
    } else {
        std::string lines;
        if (json.contains("vtk")) lines += vtkText(json["vtk"]);
        if (json.contains("csv")) lines += jsonText(json["csv"]["rows"]) + " rows in " + options.csv + "\n";
        for (const char* kind : {"stl", "ply", "gltf"})
            if (json.contains(kind)) lines += "blocks in " + json[kind]["file"].get<std::string>() + "\n";
        printResult(lines);
        if (stopped()) note(options.common, "interrupted: only the finished part was exported");
    }
    return stopped() ? kInterrupted : kDone;
}

}  // namespace

Command addExport(CLI::App& root) {
    auto options = std::make_shared<ExportOptions>();
    CLI::App* app = root.add_subcommand(
        "export", "Snapshots for ParaView (VTK), spreadsheets (CSV), CAD (STL, PLY) and the web (glTF)");
    app->add_option("FILE", options->file, "Snapshot file of talus run (.mcap)")->required();
    app->add_option("--vtk", options->vtk,
                    "Folder for .vtp files of blocks and contact points, with blocks.pvd and contacts.pvd");
    app->add_option("--csv", options->csv, "File for a table with one row per frame and block");
    auto* stl =
        app->add_option("--stl", options->stl,
                        "Write the blocks at one frame as STL: last, a frame number from 0, or a time");
    app->add_option("--ply", options->ply, "The same as PLY, with block numbers and colours")->excludes(stl);
    auto* gltf = app->add_option("--gltf", options->gltf,
                                 "glTF 2.0 (.glb) of the whole run, animated, in the run's time");
    app->add_option("--frame", options->frame,
                    "Write only this frame as glTF: last, a frame number from 0, or a time")
        ->needs(gltf);
    app->add_option("-o,--output", options->output, "STL or PLY file (default: FILE-FRAME.stl or .ply here)");
    app->add_option("--every", options->every, "Export every Nth frame and the last one")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    addCommon(*app, options->common, false);
    app->footer(
        "Examples:\n  talus export run.mcap --vtk paraview\n  talus export run.mcap --stl last -o "
        "slope.stl\n  talus export run.mcap --gltf run.glb --every 5\n\nEvery frame has its blocks "
        "(block_id, failure_role, displacement, velocity, rotation). Contact points and\ntheir forces are "
        "exported for frames with a full state (talus run --full-every).");
    return {app, [options] { return exportSnapshot(*options); }};
}

}  // namespace talus::tools
