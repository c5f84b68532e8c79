#include "reproduction/kept.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "replay/page.h"
#include "report/page.h"
#include "reproduction/laboratory.h"
#include "reproduction/slope.h"
#include "talus/parallel.h"

namespace talus::tools {

namespace {

/// The paper's photographs of the failed slope, by the fissure that holds water (0: none).
constexpr std::pair<int, const char*> kFigures[] = {{0, "Fig. 4"}, {5, "Fig. 5"}};

const char* figureOf(const PaperCase& what) {
    if (what.group != PaperGroup::table || what.friction_deg != kTableFrictionDeg) return nullptr;
    const int fissure = what.fissures.empty() ? 0 : what.fissures.front();
    for (const auto& [shown, figure] : kFigures)
        if (shown == fissure) return figure;
    return nullptr;
}

/// Adds up the shares of runs side by side for one progress line.
class Shares {
 public:
    Shares(std::size_t count, ProgressPrinter& printer) : shares_(count, 0.0), printer_(printer) {}

    void tell(std::size_t index, double share) {
        const std::lock_guard lock(mutex_);
        shares_[index] = share;
        double sum = 0;
        for (const double s : shares_) sum += s;
        printer_.show({"failing runs", sum / static_cast<double>(shares_.size()), ""});
    }

 private:
    std::mutex mutex_;
    std::vector<double> shares_;
    ProgressPrinter& printer_;
};

std::string capitalised(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

}  // namespace

std::string relativeTo(const std::string& folder, const std::string& path) {
    return std::filesystem::relative(path, folder).generic_string();
}

void markKept(std::vector<PaperCase>& cases) {
    for (PaperCase& what : cases) what.keep_failing = figureOf(what) != nullptr;
}

void keepFailures(PaperResults& results, const std::string& folder, const std::string& page_folder,
                  const Common& common) {
    makeFolder(folder);
    for (std::size_t i = 0; i < results.runs.size(); ++i) {
        const PaperCase& what = results.runs[i].what;
        if (!what.keep_failing || !results.runs[i].begun) continue;
        const std::string path = folder + "/" + what.name;
        results.kept.push_back({i, figureOf(what), path + ".mcap", path + ".html", {}});
    }
    ProgressPrinter printer(common);
    Shares shares(results.kept.size(), printer);
    inArena(threadsUsed(common), [&] {
        tbb::parallel_for(std::size_t{0}, results.kept.size(), [&](std::size_t k) {
            PaperKept& kept = results.kept[k];
            const PaperRun& run = results.runs[kept.of];
            const KeepRunOptions options{kept.file, std::nullopt, true};
            FailureKeeper keeper(options, common, run.what.scenario);
            const Control control{[&shares, k](const Progress& p) { shares.tell(k, p.fraction); },
                                  &stopRequested(), 1};
            kept.run = keeper.keep(run.search, *loadSearch("critical-angle"), control);
            if (kept.run.exit_code == kFileRefused) throw FileRefused(kept.run.reason);
            if (!kept.run.file.empty()) writeReplay(kept.file, kept.page);
            kept.file = relativeTo(page_folder, kept.file);
            kept.page = relativeTo(page_folder, kept.page);
        });
    });
}

std::string seenText(const KeptRun& kept) {
    const auto& stack = kept.scenario.model.stack;
    std::string seen;
    for (const auto& [names, does] :
         {std::pair{&kept.slides, " slid"}, {&kept.topples, " toppled"}, {&kept.stays, " stayed"}})
        if (!names->empty()) seen += (seen.empty() ? "" : "; ") + columnsText(*names, stack) + does;
    return capitalised(seen) + ".";
}

Json keptSection(const PaperResults& results) {
    const auto made = [](Json blocks) {
        return section("replays", "Replays", "Motion after failure", std::move(blocks));
    };
    if (results.kept.empty())
        return made(Json::array({paragraph(
            "This page has no failing runs. \u201ctalus paper --keep-run\u201d also keeps the failing runs "
            "of the slope dry and with water in fissure 5 (the paper\u2019s Figs. 4 and 5) and links to "
            "their replays. For one slope, use \u201ctalus critical-angle SCENARIO --keep-run "
            "failing.mcap\u201d, then \u201ctalus replay failing.mcap -o failing.html\u201d.")}));
    Json blocks = Json::array(
        {paragraph("Motion with true inertia, a few hundredths of a degree beyond the tilt of failure, until "
                   "a block is displaced by its own height. The pictures show the final state, to scale.")});
    std::vector<Drawing> pictures;
    for (const PaperKept& kept : results.kept) {
        const PaperCase& what = results.runs[kept.of].what;
        const std::string name = capitalised(label(what)) + " (the paper\u2019s " + kept.figure + ")";
        if (kept.run.file.empty()) {
            blocks.push_back(paragraph(name + ": not kept, " + kept.run.reason + "."));
            continue;
        }
        Drawing picture = drawEnd(kept.run, what.fissures, label(what));
        picture.caption_title = name;
        picture.caption = seenText(kept.run) + " Tilt " + text(degrees(kept.run.failure.load), 3) +
                          "\u00b0, after " + text(kept.run.run.simulated_seconds, 2) + " s " +
                          kept.run.farthest + " is displaced by " + text(1000 * kept.run.farthest_way, 0) +
                          " mm.";
        picture.links = {{kept.page + "#colour=role", "Play it"}, {kept.file, "snapshot file"}};
        pictures.push_back(std::move(picture));
    }
    if (!pictures.empty()) blocks.push_back(drawings(pictures, true));
    return made(std::move(blocks));
}

}  // namespace talus::tools
