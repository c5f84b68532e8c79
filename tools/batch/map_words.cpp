#include "batch/map_words.h"

#include <filesystem>

#include "batch/plots.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/page.h"

namespace talus::tools::batch {

namespace {

std::string cubicMetres(double volume) { return text(volume, volume < 10 ? 3 : 1) + " m\u00b3"; }

}  // namespace

std::string percent(double share) {
    return text(100 * share, share < 0.001 ? 3 : share < 0.01 ? 2 : share < 0.995 ? 1 : 0) + "\u00a0%";
}

std::string mapTitle(const BatchInfo& info) {
    return "Probability of failure of " + std::filesystem::path(info.scenario).filename().string();
}

std::string leadText(const FailureMap& map, const BatchInfo& info) {
    const Interval interval = shareInterval(map.failed, map.runs, map.confidence);
    const double share = map.runs > 0 ? static_cast<double>(map.failed) / static_cast<double>(map.runs) : 0;
    return std::to_string(map.failed) + " of " + std::to_string(map.runs) +
           " samples fail: " + thresholdText(info, map.threshold) + " with a probability of " +
           percent(share) + " (" + percent(interval.low) + " to " + percent(interval.high) + " with " +
           text(100 * map.confidence, 0) + " % confidence).";
}

std::string uncountedText(const FailureMap& map, const BatchInfo& info) {
    if (map.runs >= info.runs) return "";
    if (info.runs - map.runs == 1)
        return "1 sample is not counted: it is not computed, or did not tell whether it fails.";
    return std::to_string(info.runs - map.runs) +
           " samples are not counted: they are not computed, or did not tell whether they fail.";
}

Facts mapFacts(const FailureMap& map) {
    return {{"face", text(map.face.area, 1) + " m\u00b2 in " + std::to_string(map.face.cells.size()) +
                         " cells of " + csvNumber(map.face.cell_size) + " m"},
            {"expected failing volume", cubicMetres(map.volume) + ", mean of all samples"},
            {"without a free face",
             cubicMetres(map.hidden_volume) + " of it, in failures that reach no cell of the face"}};
}

std::string readingText(const BatchInfo& info) {
    return std::string(info.find(kGroupBlocks)
                           ? "Each sample counts the groups of blocks that fail in it. "
                           : "Each sample counts the first group of blocks that fails in it. ") +
           "A cell counts when its centre lies on a free face of such a block, at its place before it moves. "
           "A block\u2019s volume is shared over its own free face; blocks behind others share theirs over "
           "the face of their group." +
           (info.latin_hypercube
                ? " The intervals are those of independent samples; a Latin hypercube has less scatter."
                : "");
}

Facts mapProvenance(const BatchInfo& info, const Common& common) {
    Json facts = provenance(common, info.scenario);
    facts.erase("threads");
    Facts items = provenanceFacts(facts);
    items.emplace_back("identity of the sweep", info.identity);
    items.emplace_back("seed", std::to_string(info.seed));
    return items;
}

}  // namespace talus::tools::batch
