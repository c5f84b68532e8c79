#pragma once
// The questions a user asks: run, critical angle, factor of safety, failure mode.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/frame.h"
#include "talus/model.h"
#include "talus/result.h"
#include "talus/supports.h"

namespace talus {

/// How far a long computation has come; called now and then from the computing thread.
struct Progress {
    std::string stage;    ///< "loading", "probe 7", "run", ...
    double fraction = 0;  ///< of the whole, 0..1 (an estimate)
    std::string detail;   ///< one line for people: "tilt 19.53 deg, failing"
};

/// What the caller lends to a computation. Threads: 1 runs in the calling thread; 0 takes all cores.
struct Control {
    std::function<void(const Progress&)> progress{};
    const std::atomic<bool>* stop = nullptr;  ///< set it to end early; what was found so far is returned
    int threads = 1;
    bool keep_failing_state = false;  ///< a search also hands out SearchResult::failing
    int groups = 1;  ///< most groups of SearchResult::groups; each further one is a search more
    /// contact points of models of which a search also tries another loading history (SearchResult::range)
    std::size_t most_points_of_range = 0;
    /// explicit steps after which a search ends undecided, a factorisation of the implicit solve counted as ten; 0: none. Looked
    /// at from probe to probe
    std::int64_t most_work = 0;
};

/// What an analysis varies until the assembly fails; described in talus/searches.h.
enum class Varied : std::uint8_t {
    tilt,       ///< of gravity about y [rad]
    factor,     ///< by which tan(phi) and C, peak and residual, are divided
    horizontal  ///< k_h of a pseudo-static earthquake: level body force on free blocks over their weight
};

enum class SearchStatus { found, unstable_at_start, stable_to_stop, undecided, interrupted };
enum class FailureMode { none, sliding, toppling, mixed };
enum class Verdict { stable, failing, undecided };

const char* toString(SearchStatus status);
const char* toString(FailureMode mode);
const char* toString(Verdict verdict);

/// Wall time of a search by what it went to [s]; what is left went to contacts as built and to what stands beside the answer.
struct TimeSpent {
    double stepping = 0;  ///< explicit steps towards rest
    double solving = 0;   ///< the implicit solve
    double watching = 0;  ///< failures, let go with true inertia

    TimeSpent& operator+=(const TimeSpent& other) {
        stepping += other.stepping;
        solving += other.solving;
        watching += other.watching;
        return *this;
    }
};

/// One probe of a search: the load was brought to `load`, then the assembly came to rest or did not.
struct Probe {
    double load = 0;  ///< tilt [rad], factor of safety, or seismic coefficient
    Verdict verdict = Verdict::undecided;
    std::int64_t steps = 0;
    std::int64_t factors = 0;   ///< factorisations of the implicit solve, where it was asked
    double out_of_balance = 0;  ///< largest out-of-balance force of a block over its weight, at the end
    double displacement = 0;    ///< largest of a block during the probe [m]
    TimeSpent time{};
    std::string reason;  ///< why this verdict, for people
};

/// How one block moves at failure, and on what that rests.
struct BlockMotion {
    std::string block;
    FailureMode mode = FailureMode::none;
    Vec3 translation = Vec3::Zero();  ///< of its centroid during the continuation [m]
    double rotation = 0;              ///< during the continuation [rad]
    double rotation_share = 0;        ///< motion at its corners that is due to rotation, 0..1
    double open_share = 0;            ///< area share of its contact points that are open, 0..1
    double mobilised_friction = 0;  ///< shear force over shear strength, summed over its closed points, 0..1
    bool moving = false;
};

/// The assembly as it is let go at the end of a search; `runFailing` plays it on.
struct FailingState {
    FullFrame state;
    double load = 0;             ///< as searched for, a few cells beyond the first failing one
    double contact_damping = 0;  ///< dashpots of the continuation, as `Damping::contact` [s]
    double block_size = 0;       ///< median of the blocks' smallest extents [m]
};

/// Blocks that go together.
struct BlockGroup {
    double factor = 0;                  ///< of safety, or the load of another search
    std::vector<std::string> blocks{};  ///< sorted
    /// of those let go: the loads at which they stood and failed, `factor` in the middle; of others, and at the start, that
    double low = factor, high = factor;
};

struct SearchResult {
    SearchStatus status = SearchStatus::undecided;
    double answer =
        0;  ///< midpoint of the bracket: tilt [rad], factor of safety or seismic coefficient; valid when found
    double low = 0;   ///< last stable load (or -infinity)
    double high = 0;  ///< first failing load (or infinity)
    FailureMode mode = FailureMode::none;
    std::vector<std::string> moving_blocks;  ///< sorted
    std::vector<BlockMotion> motions;        ///< evidence, one per free block, in the order of the blocks
    /// fall whatever the strength: taken out before the search; sorted
    std::vector<std::string> fallen_at_start;
    /// failed below the answer and had too little mass to be it (AnalysisSettings::least_mass_share), in that order, each with
    /// what did not stand without it
    std::vector<BlockGroup> let_go{};
    /// low and high answers of other ways to the same load, where they differ; valid when found
    std::optional<std::pair<double, double>> range;
    std::string range_reason;  ///< why there is a range, or none
    /// Share of the area of joints whose cohesion goes at the first slip that has lost it in the failure, 0..1.
    double lost_cohesion = 0;
    /// The answer were that cohesion kept to the end, as limit equilibrium has it: of models as small as those of `range`, where
    /// some is lost and that is found within four times the work
    std::optional<double> kept_cohesion{};
    std::vector<BlockGroup> groups;  ///< of `safetyFactor`: who goes at which factor; the first is the answer
    bool groups_undecided = false;   ///< the search for the next group ended so
    std::vector<Supports> supports;  ///< as the failure is let go, or at the last load that stands
    double continuation_seconds = 0;  ///< simulated time of the continuation with true inertia [s]
    bool confirmed = false;           ///< the continuation bore the failure out
    std::vector<Probe> probes;
    std::int64_t steps = 0;
    std::int64_t factors = 0;  ///< factorisations of the implicit solve
    double wall_seconds = 0;
    TimeSpent time{};              ///< of that
    std::uint64_t state_hash = 0;  ///< over the state at the end of the last step computed
    bool inertia_scaled = false;
    double damping_local = 0;  ///< what the quasi-static part used
    double time_step = 0;      ///< true-inertia step of the continuation [s]
    std::size_t blocks = 0, interfaces = 0, contact_points = 0;
    std::vector<std::string> warnings;
    std::shared_ptr<const FailingState> failing;  ///< of a confirmed failure, when `Control` asks for it
};

/// Knobs of the quasi-static machinery; the answers do not depend on them by more than the bracket.
struct QuasiStatic {
    double local_damping = 0.3;  ///< Cundall; takes out what chatters
    double drag_ratio = 0.5;  ///< drag on translation and rotation, over the critical one of the slowest mode
    double step_safety = 0.6;    ///< share of the stability bound
    double ramp_periods = 2.0;   ///< slowest periods over which a load is changed
    double watch_periods = 1.5;  ///< slowest periods in a window in which a plateau is looked for
    std::int64_t max_steps_per_probe = 2'000'000;
};

/// The tilt at which the assembly first fails. Loading order: gravity at the start tilt, water, tilt.
Result<SearchResult> criticalAngle(const Model& model, const Control& control = {},
                                   const QuasiStatic& settings = {});

/// Strength reduction (tan phi and C, peak and residual, over F) at the model's own tilt.
Result<SearchResult> safetyFactor(const Model& model, const Control& control = {},
                                  const QuasiStatic& settings = {});

/// The horizontal seismic coefficient, from the model's own upwards, at which the assembly first fails at its own tilt.
Result<SearchResult> criticalAcceleration(const Model& model, const Control& control = {},
                                          const QuasiStatic& settings = {});

/// The model as if these blocks had been removed before the start: what joined or wetted only them goes with them.
Model withoutBlocks(const Model& model, const std::vector<std::string>& names);

}  // namespace talus
