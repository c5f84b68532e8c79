// What the page shows of the water bag: plots, a table, and links to the replays.

#include "reproduction/bag_page.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "cli/files.h"
#include "cli/json.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "replay/page.h"
#include "report/csv.h"
#include "report/page.h"
#include "report/svg.h"
#include "reproduction/bag.h"
#include "reproduction/kept.h"
#include "reproduction/results.h"
#include "reproduction/slope.h"
#include "talus/parallel.h"

namespace talus::tools {
namespace {

constexpr double kBeyond = 0.3;  ///< tilt beyond the critical angle: slides visibly, and can still stop [deg]
constexpr std::array<const char*, 3> kRoles{"rule", "laboratory", "theory"};  ///< colours of the curves
constexpr double kHeadroom = 1.2;  ///< above the largest displacement with a bag
constexpr double kBeside = 0.1;    ///< below and above the levels, share of their range
constexpr int kSteps = 6;          ///< marks on an axis

/// One curve a run over time, as far as it stays within `range`.
template <class Value>
Plot plotOverTime(const std::vector<BagRun>& runs, const std::string& id, const std::string& title,
                  const std::string& axis, const std::array<double, 2>& range, const Value& value) {
    Plot plot{id, title, title + " over time; one curve a run",
              axisOver("time (s)", 0, runs.front().history.back().time, kSteps),
              axisOver(axis, range[0], range[1], kSteps)};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        Series curve{"line", kRoles[k % kRoles.size()], runs[k].name, {}};
        for (const BagInstant& instant : runs[k].history)
            if (value(instant) <= range[1]) curve.add({instant.time, value(instant)});
        plot.series.push_back(std::move(curve));
    }
    return plot;
}

double lowestLevel(const BagRun& bag) {
    return std::min_element(bag.history.begin(), bag.history.end(),
                            [](const BagInstant& a, const BagInstant& b) { return a.level < b.level; })
        ->level;
}

Json endsTable(const std::vector<BagRun>& runs) {
    Json rows = Json::array();
    for (const BagRun& bag : runs) {
        const BagInstant& end = bag.history.back();
        rows.push_back({bag.name, 1e3 * end.displacement, 1e3 * end.speed, end.level, lowestLevel(bag)});
    }
    const Json columns{textColumn("run"), numberColumn("displacement [mm]", 2, "", kStart | kStrong),
                       numberColumn("speed [mm/s]", 2), numberColumn("level [m]", 3, "", kStart),
                       numberColumn("lowest level [m]", 3)};
    return table("At the end, after " + text(runs.front().history.back().time, 2) + " s", columns,
                 std::move(rows));
}

Json pictures(const std::vector<BagRun>& runs, const std::vector<int>& fissures) {
    std::vector<Drawing> items;
    for (const BagRun& bag : runs) {
        Drawing picture = drawEnd(bag.run, fissures, bag.name);
        picture.caption_title =
            std::string(1, static_cast<char>(std::toupper(bag.name[0]))) + bag.name.substr(1);
        picture.caption = "Displaced by " + text(1e3 * bag.history.back().displacement, 2) + " mm; level " +
                          text(bag.history.back().level, 3) + " m.";
        picture.links = {{bag.page, "Play it"}, {bag.file, "snapshot file"}};
        items.push_back(std::move(picture));
    }
    return drawings(items, false);
}

const PaperRun* slopeWithBag(const PaperResults& results) {
    for (const PaperRun& run : results.runs)
        if (run.what.keep_failing && run.what.fissures == std::vector{results.bag_fissure} &&
            criticalDeg(run))
            return &run;
    return nullptr;
}

}  // namespace

void keepBagRuns(PaperResults& results, const std::string& folder, const std::string& page_folder,
                 const Common& common) {
    const PaperRun* slope = slopeWithBag(results);
    if (!slope) return;
    makeFolder(folder);
    std::vector<BagRun> runs =
        bagRuns(slope->what.scenario.text, results.bag_fissure, *criticalDeg(*slope) + kBeyond);
    for (BagRun& bag : runs)
        bag.file = folder + "/water-" + bag.id + ".mcap", bag.page = folder + "/water-" + bag.id + ".html";
    inArena(threadsUsed(common), [&] {
        tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
            playBagRun(runs[k], common, {{}, &stopRequested(), 1});
            writeReplay(runs[k].file, runs[k].page);
        });
    });
    for (BagRun& bag : runs)
        for (std::string* path : {&bag.file, &bag.page}) *path = relativeTo(page_folder, *path);
    results.bag = std::move(runs);
}

Plot plotBagLevel(const std::vector<BagRun>& runs) {
    double low = kInfinity, high = 0;
    for (const BagRun& bag : runs)
        for (const BagInstant& instant : bag.history)
            low = std::min(low, instant.level), high = std::max(high, instant.level);
    const double beside = kBeside * (high - low);
    return plotOverTime(runs, "bag-level", "Level of the water in the fissure", "level (m)",
                        {low - beside, high + beside},
                        [](const BagInstant& instant) { return instant.level; });
}

/// The slope with the level held slides far beyond the others: its curve leaves the plot.
Plot plotBagDisplacement(const std::vector<BagRun>& runs) {
    double most = 0;
    for (std::size_t k = 1; k < runs.size(); ++k) most = std::max(most, runs[k].history.back().displacement);
    return plotOverTime(runs, "bag-displacement", "Displacement of the columns in front of the fissure",
                        "displacement (mm)", {0, 1e3 * kHeadroom * most},
                        [](const BagInstant& instant) { return 1e3 * instant.displacement; });
}

std::string bagCsv(const std::vector<BagRun>& runs, const std::string& provenance_comments) {
    std::string csv = provenance_comments + "run,time_s,level_m,displacement_m,speed_m_s\n";
    for (const BagRun& bag : runs)
        for (const BagInstant& at : bag.history)
            csv += csvLine({bag.id, csvNumber(at.time), csvNumber(at.level), csvNumber(at.displacement),
                            csvNumber(at.speed)});
    return csv;
}

Json bagJson(const std::vector<BagRun>& runs) {
    Json list = Json::array();
    for (const BagRun& bag : runs) {
        const BagInstant& end = bag.history.back();
        list.push_back({{"name", bag.id},
                        {"file", bag.file},
                        {"page", bag.page},
                        {"time_s", end.time},
                        {"level_m", end.level},
                        {"lowest_level_m", lowestLevel(bag)},
                        {"displacement_m", end.displacement},
                        {"speed_m_s", end.speed},
                        {"state_hash", hashText(bag.run.run.state_hash)}});
    }
    return list;
}

Json bagSection(const PaperResults& results) {
    const auto made = [](Json blocks) {
        return section("bag", "Water bag", "The water bag: what the level does when the slope slides",
                       std::move(blocks));
    };
    if (results.bag.empty())
        return made(Json::array({paragraph(
            "This page has no runs with the water bag. \u201ctalus paper --keep-run\u201d plays the slope "
            "with water in fissure 5 three times: with the level held, with a bag that holds its volume, "
            "and with a bag that a supply fills.")}));
    const Model& model = results.bag.front().run.scenario.model;
    Json blocks = Json::array(
        {paragraph("In the laboratory the water stood in a flexible bag, and a supply kept its level until "
                   "the slope slid. The level then fell, although the supply went on (the paper\u2019s "
                   "section 2). A level that is held, as in the searches, gives the same limit, but not "
                   "this motion."),
         paragraph("One slice of the slope with water in fissure 5 slides at " +
                   text(degrees(model.gravity.tilt), 2) +
                   "\u00b0, 0.3\u00b0 beyond its critical angle. The paper gives neither the width of the "
                   "bag nor the rate of the supply. Assumed are 5 mm and 1 litre per second and metre of "
                   "width. The bag without a supply empties into the opening fissure, and the columns "
                   "stop. With the supply they stop and slide again as the level rises.")});
    blocks.push_back(toJson(plotBagLevel(results.bag)));
    blocks.push_back(toJson(plotBagDisplacement(results.bag)));
    blocks.push_back(endsTable(results.bag));
    blocks.push_back(pictures(results.bag, {results.bag_fissure}));
    return made(std::move(blocks));
}

}  // namespace talus::tools
