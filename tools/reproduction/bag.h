#pragma once
// The water bag of the experiment: the slope with water in fissure 5 slides with the level held, with a
// closed volume of water, and with a closed volume that a supply fills.

#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "recording/keep_run.h"
#include "report/figures.h"

namespace talus::tools {

struct BagInstant {
    double time = 0;          ///< [s]
    double level = 0;         ///< depth of the water [m]
    double displacement = 0;  ///< of the lowest block in front of the fissure, since the start [m]
    double speed = 0;         ///< of that block [m/s]
};

/// One time history.
struct BagRun {
    std::string id;    ///< "held", "bag", "supply"
    std::string name;  ///< for people
    KeptRun run{};     ///< its scenario, then where it ends; blocks that move have the role "sliding"
    std::vector<BagInstant> history{};
    std::string file{}, page{};  ///< snapshots and replay, relative to the page's folder
};

/// The three scenarios: one slice of the stack in `slope`, tilted by `tilt_deg`. Width of the bag and rate of
/// the supply are assumed.
/// \param slope  text of a scenario with a [[stack]] of the paper's blocks and water in `fissure`
std::vector<BagRun> bagRuns(const std::string& slope, int fissure, double tilt_deg);

/// Computes one, and keeps its snapshots in its file. Throws FileRefused.
void playBagRun(BagRun& bag, const Common& common, const Control& control);

Plot plotBagLevel(const std::vector<BagRun>& runs);         ///< level over time
Plot plotBagDisplacement(const std::vector<BagRun>& runs);  ///< displacement over time
/// run, time, level, displacement, speed; below the lines of provenance
std::string bagCsv(const std::vector<BagRun>& runs, const std::string& provenance_comments);
Json bagJson(const std::vector<BagRun>& runs);  ///< how each run ends

}  // namespace talus::tools
