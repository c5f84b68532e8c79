#pragma once
// The mechanism of a limit analysis as a motion for viewers: blocks move along their velocities, without the
// forces of a run.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "cli/failures.h"
#include "cli/json_fwd.h"
#include "recording/run_output.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"

namespace CLI {
class App;
}

namespace talus::tools {

struct KeepMechanismOptions {
    std::string file;  ///< empty: nothing is kept
    bool force = false;
};

/// Adds --keep-mechanism and --force to a subcommand.
void addKeepMechanism(CLI::App& app, KeepMechanismOptions& options);

/// The kept motion, or why there is none.
struct KeptMechanism {
    std::string file;    ///< empty when nothing was kept
    std::string reason;  ///< why nothing was kept
    int exit_code = kDone;
    FailureMode mode = FailureMode::none;
    double displacement = 0;  ///< of the fastest block's farthest corner at the end [m]
    std::size_t frames = 0;
    std::uint64_t bytes = 0;
};

Json keptMechanismJson(const KeptMechanism& kept);
std::string keptMechanismText(const KeptMechanism& kept);

/// Keeps one. A file that must not be replaced, or cannot be written, is refused at once: throws BadInput or
/// FileRefused.
class MechanismKeeper {
 public:
    /// All arguments must outlive the keeper.
    MechanismKeeper(const KeepMechanismOptions& options, const Common& common,
                    const formats::Scenario& scenario);

    bool wanted() const { return recorder_ != nullptr; }

    /// A refusal of the file system is part of the result, so that the answer is not lost. \pre wanted()
    KeptMechanism keep(const LimitResult& result, const VariedQuantity& load);

 private:
    void write(const LimitResult& result, const VariedQuantity& load, double limit, KeptMechanism& kept);

    const KeepMechanismOptions& options_;
    const formats::Scenario& scenario_;
    RunOptions run_options_;
    formats::Scenario at_limit_;
    std::unique_ptr<RunRecorder> recorder_;
};

/// The limit analysis by which a file was kept: "limit-analysis --for tilt". nullptr when by another
/// analysis.
std::string mechanismSource(const VariedQuantity& load);
const VariedQuantity* mechanismLoad(const std::string& analysis);

}  // namespace talus::tools
