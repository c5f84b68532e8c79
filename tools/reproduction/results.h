#pragma once
// One computed case of the paper, all of them together, and the figures read off them. Everything the command
// prints and writes is a pure function of PaperResults.

#include <optional>
#include <string>
#include <vector>

#include "cli/json.h"
#include "recording/keep_run.h"
#include "report/numbers.h"
#include "reproduction/bag.h"
#include "reproduction/scatter.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/theory.h"

namespace talus::tools {

enum class PaperGroup {
    table,         ///< Table 1 and Fig. 6
    section5,      ///< twelve columns, fissures far from the toe
    points,        ///< the dry slope, one slice, with different contact points
    quarter_water  ///< the watered slopes, one slice, with the paper's contact points
};

/// Description of a case.
struct PaperCase {
    PaperGroup group = PaperGroup::table;
    std::string name;           ///< "dry", "fissure-3", "points-grid-4", ...
    std::vector<int> fissures;  ///< watered, numbered from the toe
    double water_depth = 0;     ///< [m]
    double friction_deg = 0;
    std::string points;               ///< rule of the contact points
    std::optional<double> paper_deg;  ///< laboratory average (Table 1) or the paper's DEM (section 5)
    formats::Scenario scenario;
    std::optional<theory::Prediction> theory;
    bool keep_failing = false;  ///< its failing run is kept (--keep-run)
};

/// Its result.
struct PaperRun {
    PaperCase what;
    bool begun = false;
    SearchResult search;
    std::vector<Error> errors;  ///< the engine refused the case
    double cpu_seconds = 0;
};

/// A failing run that was kept for the page. Paths are relative to the page's folder.
struct PaperKept {
    std::size_t of = 0;  ///< index into PaperResults::runs
    std::string figure;  ///< of the paper, which shows the same slope: "Fig. 4"
    std::string file, page;
    KeptRun run;
};

struct PaperResults {
    std::vector<PaperRun> runs;  ///< in the order of paperCases(), whatever the order of computing
    double wall_seconds = 0;
    int threads = 1;
    bool interrupted = false;
    std::string table_points;  ///< rule of Table 1 and section 5
    Json provenance = Json::object();
    std::string provenance_comments;   ///< the same as "# key: value" lines
    std::optional<Scatter> scatter{};  ///< with --monte-carlo
    std::vector<PaperKept> kept{};     ///< with --keep-run
    std::vector<BagRun> bag{};         ///< with --keep-run
    int bag_fissure = 5;               ///< of the paper's Fig. 5
};

const char* groupName(PaperGroup group);                 ///< "table-1", "section-5", ...
std::string groupTitle(PaperGroup group);                ///< in words
std::string label(const PaperCase& what);                ///< in words: "dry", "fissure 3", "fissures 7-10"
std::string fileName(const PaperCase& what);             ///< without ending: "dry-phi-19.5", "points-corner"
std::string statusText(const PaperRun& run);             ///< "found", "interrupted", "not_run", "failed", ...
std::optional<double> criticalDeg(const PaperRun& run);  ///< nothing unless found
std::optional<double> theoryDeg(const PaperRun& run);
std::optional<double> lessTheory(const PaperRun& run);  ///< DEM - theory [deg]
std::optional<double> lessPaper(const PaperRun& run);   ///< DEM - the paper's value [deg]
std::string failureText(const PaperRun& run);           ///< "sliding", ... or "" without an answer
std::string movingText(const PaperRun& run);            ///< "columns 1-3 (45 blocks)"

/// Blocks of a stack in words: "columns 1-3 (45 blocks)", with the rows when it is not all of them.
std::string columnsText(const std::vector<std::string>& blocks, const std::optional<StackShape>& stack);

/// "fissure 3 phi 19.5: 15.56", or the status in place of the angle.
std::string answerText(const PaperRun& run);

/// Distance of the watered fissure next to the toe from the toe [m], and that over the water depth; nothing
/// when dry.
std::optional<double> fissureDistance(const PaperCase& what);
std::optional<double> distanceOverDepth(const PaperCase& what);

/// The runs of one group, in order.
std::vector<const PaperRun*> runsOf(const PaperResults& results, PaperGroup group);

/// Table 1's run of one fissure (0: dry) and friction angle; nullptr when there is none.
const PaperRun* tableRun(const PaperResults& results, int fissure, double friction_deg);

/// A run of the study of contact points; nullptr when there is none.
const PaperRun* pointsRun(const PaperResults& results, const std::string& points);

/// Where the time went: one line per group, the costliest group first.
struct GroupCost {
    PaperGroup group = PaperGroup::table;
    std::size_t cases = 0;
    double cpu_seconds = 0;
    std::int64_t steps = 0;
};
std::vector<GroupCost> groupCosts(const PaperResults& results);
std::vector<const PaperRun*> costliest(const PaperResults& results, std::size_t count);

/// The value of largest magnitude; nothing without values.
std::optional<double> largest(const std::vector<std::optional<double>>& values);

}  // namespace talus::tools
