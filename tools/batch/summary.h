#pragma once
// Statistics of a batch's rows: distribution of the answer, probability of failure, failure modes,
// sensitivity.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "batch/statistics.h"
#include "batch/store.h"
#include "batch/warnings.h"

namespace talus::tools::batch {

/// One run with a result.
struct Observation {
    std::uint64_t run = 0, case_index = 0;
    double answer = 0;       ///< -infinity: fails at the start; infinity: stands to the end of the search
    bool has_range = false;  ///< other loading histories lead to other answers, as far as that was asked
    /// The lower end of the answers of other loading histories, where that was asked; else the answer.
    double least = 0;
    double low = 0, high = 0;  ///< the search's bracket, in the answer's unit
    std::string mode;
    std::vector<double> values;  ///< of the numeric varied columns; NaN where a cell is empty
};

/// Whether a run with this answer (`answer` or `least`) has failed at a threshold; nothing when its search
/// did not reach there.
std::optional<bool> hasFailed(const Observation& seen, double answer, double threshold);

/// Probability that the slope has failed at a tilt, or has less than a factor of safety.
struct FailureShare {
    double threshold = 0;
    std::uint64_t failed = 0, count = 0;  ///< of the runs that can be told
    Interval interval;
};

/// Runs of one case, or of all.
struct Group {
    std::string label;  ///< "" for all
    std::optional<std::uint64_t> case_index;
    std::uint64_t runs = 0, decided = 0;
    Moments moments;             ///< of the finite answers
    std::vector<double> sorted;  ///< answers, infinite ones too
    std::vector<FailureShare> failure;
    std::vector<FailureShare>
        failure_at_least;      ///< by the lower ends of ranges; empty where none were asked for
    std::uint64_t ranges = 0;  ///< runs whose answer depends on the loading history
    std::map<std::string, std::uint64_t> modes;
};

struct Sensitivity {
    std::string column;
    std::size_t value = 0;  ///< index into Observation::values
    Correlation correlation;
};

struct Summary {
    BatchInfo info;
    std::vector<std::size_t> value_columns;  ///< the numeric varied columns, indices into info.columns
    std::vector<Observation> observations;   ///< by run
    std::map<std::string, std::uint64_t> statuses;
    std::uint64_t done = 0, failed = 0;
    std::uint64_t beyond = 0;  ///< rows of a larger batch that are left out
    std::vector<std::pair<std::uint64_t, std::string>> failures;  ///< the first ones: run and reason
    std::vector<WarningGroup> warnings;                           ///< of all runs, failed ones too
    Group all;
    std::vector<Group> cases;                ///< when there are several cases, and not too many to list
    std::vector<Sensitivity> sensitivities;  ///< the strongest first
};

Summary summarise(const StoredBatch& batch);
Json toJson(const Summary& summary);
Json toJson(const std::vector<WarningGroup>& warnings);

/// "water[0].depth = 0.2, ..." of a case, from one of its rows.
std::string caseLabel(const BatchInfo& info, const Row& row);

}  // namespace talus::tools::batch
