#pragma once
// Sweep files: a scenario, an analysis, and what varies. A sweep is a list of runs that is never stored: each
// run's sample follows from its number alone. So any worker can compute any run, and any run can be repeated.
//
//   format = 1
//   scenario = "slope.toml"        # beside the sweep file
//   analysis = "critical-angle"    # any search of talus/searches.h ("safety-factor", ...), or "run"
//   range = true                   # default false: each run of a search also tries other loading histories
//   samples = 1000                 # of the random variables
//   seed = 1                       # default 1
//   sampling = "random"            # or "latin-hypercube"
//
//   [[grid]]                       # every value with every value of the other grids
//   field = "water[0].depth"       # a field of the scenario, or a list of fields that get the same value
//   values = [0.1, 0.2, 0.35]      # or from = 0.1, to = 0.35 with count = 6 or step = 0.05
//
//   [table]                        # one case per row
//   file = "cases.csv"             # its header names the fields; a column "name" names the cases
//   # or columns = ["water[0].depth", ...] and rows = [[0.1, ...], ...]
//
//   [[random]]
//   field = "joint.default.friction_deg"   # "joint.*.friction_deg": of all joints
//   per = "run"                    # one draw a run; "joint": one a joint; "interface": one an interface
//   distribution = "uniform"       # min, max. "normal": mean, sd. "truncated-normal": mean, sd, min, max.
//                                  # "lognormal": mean, sd. "triangular": min, mode, max. "beta": alpha,
//                                  beta, min, max
//   [correlation]                  # of the normal scores of random variables
//   fields = ["joint.default.friction_deg", "joint.default.cohesion"]
//   matrix = [[1.0, -0.5], [-0.5, 1.0]]
//
//   [report]
//   tilt_deg = [15.0, 18.0]        # critical-angle: probability of failure at these tilts
//   factor = [1.0]                 # safety-factor: probability of less than these
//   confidence = 0.95
//
// Runs are numbered from 0, sample by sample: run = sample * cases + case. Cases are the table's rows times
// the grids' values, the last grid fastest. A sample draws the same numbers in every case, so that cases
// differ by what was changed and not by chance.

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "talus/formats/distribution.h"
#include "talus/formats/scenario.h"
#include "talus/result.h"
#include "talus/searches.h"
#include "talus/simulation.h"

namespace talus::formats {

using SweepValue = std::variant<bool, std::int64_t, double, std::string>;
std::string toString(const SweepValue& value);  ///< the shortest text that reads back as the same value

enum class SweepSource : std::uint8_t { table, grid, random };
enum class SampledPer : std::uint8_t { run, joint, interface };

/// Share of another column's normal score in a correlated one.
struct ScoreShare {
    std::size_t column = 0;
    double weight = 0;
};

/// What varies together: one column of the results, or three (mean, smallest, largest) for draws per
/// interface.
struct SweepColumn {
    std::string name;                  ///< the (first) field
    std::string unit;                  ///< "deg", "Pa/m", ...; "" when it has none or is not known
    std::vector<std::string> targets;  ///< fields of the scenario that get the value
    SweepSource source = SweepSource::grid;
    SampledPer per = SampledPer::run;
    std::vector<SweepValue> values;    ///< of a grid, or of the table's rows
    Distribution distribution;         ///< of a random variable
    std::vector<ScoreShare> scores{};  ///< normal scores that make up its own; none: independent
};

struct SweepReport {
    std::vector<double> thresholds;  ///< of the search's answer, in its unit
    double confidence = 0.95;
};

struct Sweep {
    std::string path, scenario_path;
    const LoadSearch* search = nullptr;  ///< the search of each run; nullptr: its time history
    bool tries_histories = false;        ///< also finds whether other loading histories give other answers
    std::vector<SweepColumn> columns;
    std::vector<std::string> case_names;  ///< of the table's rows; may be empty
    std::uint64_t cases = 1, samples = 1;
    std::uint64_t seed = 1;
    bool latin_hypercube = false;
    SweepReport report;
    std::string text, scenario_text;  ///< of the two files

    // Shared input of all runs, so that they need not read the text again.
    std::shared_ptr<const Scenario> base{};  ///< the scenario as its file says
    bool only_overrides = false;             ///< a run's values can all be put into its model (overrides.h)
    std::shared_ptr<const std::vector<TouchingPair>> base_pairs{};  ///< of all runs, when they have the same

    std::uint64_t runs() const { return cases * samples; }
    const char* analysis() const { return search ? search->name : "run"; }
};

/// Reads and checks a sweep file, its scenario and its table. Tries every value of a table or grid, and the
/// median and ends of each distribution, so that errors are found before the first run.
Result<Sweep> readSweep(const std::string& path);
/// The same for text in memory; `path` is used in messages and to find what lies beside it. `scenario`, when
/// given, stands in for the file that the text names.
Result<Sweep> parseSweep(const std::string& text, const std::string& path,
                         std::shared_ptr<const Scenario> scenario = nullptr);

/// 16 hex digits over everything that defines the runs: scenario, analysis, variables, seed. Comments and the
/// report do not count, nor does the number of samples in random sampling: a batch can be extended later.
std::string identityOf(const Sweep& sweep);

/// One run: its number and the values of its columns (nothing for a column of draws per interface).
struct SweepRun {
    std::uint64_t index = 0, case_index = 0, sample = 0;
    std::vector<SweepValue> values;
};

/// \pre index < sweep.runs()
SweepRun runOf(const Sweep& sweep, std::uint64_t index);

/// Mean, smallest and largest of the draws of one column over the interfaces.
struct DrawnRange {
    std::size_t column = 0;
    std::size_t interfaces = 0;
    double mean = 0, min = 0, max = 0;
};

struct SampledScenario {
    Scenario scenario;
    std::vector<DrawnRange> drawn;  ///< one per column of draws per interface
};

/// The scenario of a run. Errors: what the scenario reader says of these values; interfaces cannot be listed.
Result<SampledScenario> scenarioOf(const Sweep& sweep, const SweepRun& run);

/// The same as the text of a scenario file, which reads back as the same model. Draws per interface stand in
/// it as one [[interface]] each.
Result<std::string> scenarioTextOf(const Sweep& sweep, const SweepRun& run);

}  // namespace talus::formats
