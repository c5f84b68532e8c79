#include "reproduction/scatter.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "batch/report.h"
#include "batch/schedule.h"
#include "batch/statistics.h"
#include "batch/store.h"
#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "paper_scenarios.h"
#include "report/page.h"
#include "reproduction/laboratory.h"

namespace talus::tools {

namespace {

constexpr const char* kSweep = "laboratory-scatter";
constexpr const char* kScenario = "fissure-1";
constexpr double kShares[] = {0.05, 0.25, 0.5, 0.75, 0.95};

std::string builtIn(std::string_view name) {
    for (const auto& file : kPaperScenarios)
        if (file.name == name) return std::string(file.text);
    throw std::logic_error("no built-in file named " + std::string(name));
}

/// The line of a file that begins with `start`, replaced.
std::string withLine(std::string text, const std::string& start, const std::string& line) {
    const auto at = ("\n" + text).find("\n" + start);
    if (at == std::string::npos) throw std::logic_error("no line " + start + " in the built-in sweep");
    return text.replace(at, text.find('\n', at) - at, line);
}

/// A file that is there with this text already stays: a second call in this process has read it as its input.
void provide(const std::string& path, const std::string& text) {
    std::ifstream file(path, std::ios::binary);
    if (file && std::string(std::istreambuf_iterator<char>(file), {}) == text) return;
    writeFile(path, text);
}

/// The sweep and its scenario as files beside the results. Returns the sweep's path.
std::string writeSweep(std::uint64_t samples, const std::string& folder) {
    std::string sweep = withLine(builtIn(kSweep), "samples =", "samples = " + std::to_string(samples));
    sweep = withLine(sweep, "scenario =", "scenario = \"" + std::string(kScenario) + ".toml\"");
    makeFolder(folder);
    provide(folder + "/" + kScenario + ".toml", builtIn(kScenario));
    provide(folder + "/" + kSweep + ".toml", sweep);
    return folder + "/" + kSweep + ".toml";
}

/// The sweep's cases are the laboratory's series, in the same order.
Scatter read(const batch::StoredBatch& stored) {
    Scatter scatter;
    scatter.samples = stored.info.samples;
    scatter.complete = stored.lines.size() >= stored.info.runs;
    for (const LaboratorySeries& series : kLaboratory)
        scatter.cases.push_back({series.fissure, series.repeats_deg, 0, 0, {}});
    const std::size_t angle = *stored.info.find("critical_angle_deg"), cpu = *stored.info.find("cpu_seconds");
    for (const auto& [run, line] : stored.lines) {
        const batch::Row row = stored.row(run);
        ScatterCase& one = scatter.cases.at(run % stored.info.cases);
        const auto found = numberIn(row[angle]);
        ++one.runs;
        if (found)
            one.angles_deg.push_back(*found);
        else
            ++one.failed;
        scatter.cpu_seconds += numberIn(row[cpu]).value_or(0);
    }
    for (ScatterCase& one : scatter.cases) std::sort(one.angles_deg.begin(), one.angles_deg.end());
    return scatter;
}

std::string caseName(const ScatterCase& one) {
    return one.fissure == 0 ? "dry" : "fissure " + std::to_string(one.fissure);
}

std::string boxTip(const ScatterCase& one) {
    return caseName(one) + ": half of the samples between " +
           text(batch::quantileOf(one.angles_deg, 0.25), 2) + " and " +
           text(batch::quantileOf(one.angles_deg, 0.75), 2);
}

/// How many of the repeats lie between the 5 % and the 95 % sample.
int repeatsInside(const ScatterCase& one) {
    const double low = batch::quantileOf(one.angles_deg, 0.05),
                 high = batch::quantileOf(one.angles_deg, 0.95);
    return static_cast<int>(std::count_if(one.repeats_deg.begin(), one.repeats_deg.end(),
                                          [&](double repeat) { return repeat >= low && repeat <= high; }));
}

std::string repeatsText(const ScatterCase& one) {
    std::string list;
    for (const double repeat : one.repeats_deg) list += (list.empty() ? "" : ", ") + text(repeat, 1);
    return list;
}

Json tableRow(const ScatterCase& one) {
    Json row{caseName(one), repeatsText(one), one.runs};
    if (one.angles_deg.empty()) {
        for (int i = 0; i < 4; ++i) row.push_back(nullptr);
        return row;
    }
    const batch::Moments moments = batch::momentsOf(one.angles_deg, 0.95);
    row.push_back(moments.mean);
    row.push_back(moments.sd);
    row.push_back(text(batch::quantileOf(one.angles_deg, 0.05), 2) + " to " +
                  text(batch::quantileOf(one.angles_deg, 0.95), 2));
    row.push_back(std::to_string(repeatsInside(one)) + " of 3");
    return row;
}

}  // namespace

Scatter computeScatter(std::uint64_t samples, const std::string& folder, const Common& common) {
    const formats::Sweep sweep = valueOf(formats::readSweep(writeSweep(samples, folder)));
    batch::Store store(folder, batch::describe(sweep), {});
    ProgressPrinter printer(common);
    batch::work({sweep,
                 store,
                 {},
                 threadsUsed(common),
                 false,
                 {},
                 stopRequested(),
                 requestStop,
                 [&](const batch::BatchProgress& progress) {
                     printer.show(
                         {"Monte Carlo",
                          static_cast<double>(progress.done) / static_cast<double>(progress.todo),
                          std::to_string(progress.done) + " of " + std::to_string(progress.todo) + " runs"});
                 }});
    printer.finish();
    const batch::StoredBatch stored = batch::readStored(folder);
    batch::writeReport(folder, stored, common);
    return read(stored);
}

Json scatterJson(const Scatter& scatter) {
    Json cases = Json::array();
    for (const ScatterCase& one : scatter.cases) {
        const bool any = !one.angles_deg.empty();
        const batch::Moments moments = batch::momentsOf(one.angles_deg, 0.95);
        Json quantiles = Json::object();
        for (const double share : kShares)
            if (any) quantiles[text(share, 2)] = batch::quantileOf(one.angles_deg, share);
        cases.push_back({{"fissure", one.fissure == 0 ? Json(nullptr) : Json(one.fissure)},
                         {"laboratory_deg", one.repeats_deg},
                         {"runs", one.runs},
                         {"without_answer", one.failed},
                         {"mean_deg", any ? number(moments.mean) : Json(nullptr)},
                         {"sd_deg", any ? number(moments.sd) : Json(nullptr)},
                         {"quantiles_deg", quantiles}});
    }
    return {{"samples", scatter.samples}, {"complete", scatter.complete}, {"cases", cases}};
}

Plot plotScatter(const Scatter& scatter) {
    Plot plot{"plot-scatter", "Scatter of the laboratory, computed",
              "Critical angles of samples in which every interface drew its own friction angle, with the "
              "three laboratory tests of each case.",
              PlotAxis{"watered fissure"}, PlotAxis{"critical angle (\u00b0)", {0, 22}, 2, 0}};
    Series boxes{"box", "band", "computed: middle half of the samples", {}};
    Series repeats{"points", "laboratory", "laboratory, each test", {}, {}, "circle", 3, 24};
    for (const ScatterCase& one : scatter.cases) {
        const auto place = static_cast<double>(plot.x.categories.size());
        plot.x.categories.push_back(one.fissure == 0 ? "dry" : std::to_string(one.fissure));
        if (!one.angles_deg.empty()) {
            std::vector<double> row{place};
            for (const double share : kShares) row.push_back(batch::quantileOf(one.angles_deg, share));
            boxes.add(std::move(row), boxTip(one));
        }
        for (const double repeat : one.repeats_deg)
            repeats.add({place, repeat}, "laboratory " + text(repeat, 1));
    }
    plot.series = {std::move(boxes), std::move(repeats)};
    plot.key = {{"line", "theory", "computed: median", {}},
                {"line", "frame", "computed: from 5 % to 95 %", {}}};
    return plot;
}

Json scatterSection(const Scatter& scatter) {
    Json blocks = Json::array(), rows = Json::array();
    if (!scatter.complete)
        blocks.push_back(paragraph("Interrupted: the page shows the samples finished before that.", "alert"));
    blocks.push_back(
        paragraph("Friction angles from 18\u00b0 to 21\u00b0 were measured on the blocks. Here every "
                  "interface of the slope draws its own friction angle uniformly from that range, in " +
                  std::to_string(scatter.samples) +
                  " samples, each computed dry and with water in each fissure. The width of the boxes is the "
                  "effect of that scatter on the critical angle. Where a laboratory test lies outside, "
                  "friction within that range does not explain it."));
    blocks.push_back(toJson(plotScatter(scatter)));
    for (const ScatterCase& one : scatter.cases) rows.push_back(tableRow(one));
    blocks.push_back(
        table("Critical angle (\u00b0) with friction angles of 18\u00b0 to 21\u00b0 per interface",
              {textColumn("case"), numberColumn("laboratory", 1), numberColumn("samples", 0),
               numberColumn("mean", 2), numberColumn("standard deviation", 2), numberColumn("5 % to 95 %", 2),
               numberColumn("laboratory tests in there", 0)},
              rows));
    return section("scatter", "Scatter", "The laboratory\u2019s scatter", std::move(blocks));
}

}  // namespace talus::tools
