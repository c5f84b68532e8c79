#pragma once
// The analyses: critical angle, factor of safety, critical acceleration, and what they return.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/control.h"
#include "talus/frame.h"
#include "talus/model.h"
#include "talus/result.h"
#include "talus/search_rules.h"
#include "talus/supports.h"

namespace talus {

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

/// Wall time of a search [s].
struct TimeSpent {
    double loading = 0;  ///< weight, water and tilt, up to where the search begins
    double path = 0;     ///< the path of the load that is searched for
    double beside = 0;   ///< the interval, and what else stands beside the answer

    TimeSpent& operator+=(const TimeSpent& other) {
        loading += other.loading;
        path += other.path;
        beside += other.beside;
        return *this;
    }
};

/// One equilibrium of a search's path, or the failure at its end.
struct Probe {
    double load = 0;  ///< tilt [rad], factor of safety, or seismic coefficient
    Verdict verdict = Verdict::undecided;
    std::int64_t steps = 0;
    std::int64_t factors = 0;   ///< factorisations since the one before
    double out_of_balance = 0;  ///< largest out-of-balance force of a block over its weight
    double displacement = 0;    ///< of the block that has moved farthest since the path began [m]
    std::string reason;         ///< why this verdict
};

/// A point of the load-displacement curve of a search.
struct PathPoint {
    double load = 0;          ///< as the answer's
    double displacement = 0;  ///< of the block that has moved farthest [m]
};

/// How one block moves at failure, and the evidence for it.
struct BlockMotion {
    std::string block;
    FailureMode mode = FailureMode::none;
    Vec3 translation = Vec3::Zero();  ///< of its centroid during the continuation [m]
    double rotation = 0;              ///< during the continuation [rad]
    Vec3 turn = Vec3::Zero();         ///< the same with its axis: axis times angle [rad]
    double rotation_share = 0;        ///< motion at its corners that is due to rotation, 0..1
    double open_share = 0;            ///< area share of its contact points that are open, 0..1
    double mobilised_friction = 0;  ///< shear force over shear strength, summed over its closed points, 0..1
    bool moving = false;
};

/// The assembly in failure, as a search found it; `runFailing` continues it as a time history.
struct FailingState {
    FullFrame state;
    double load = 0;             ///< as searched for, a little above the first failing one
    double contact_damping = 0;  ///< dashpots against contact chatter, as `Damping::contact` [s]
    /// Square of the highest angular frequency of the time history [1/s^2]. Small, faster blocks get more
    /// inertia, in all at most 1 % of the moving mass.
    double frequency = 0;
    double block_size = 0;  ///< median of the blocks' smallest extents [m]
};

/// Blocks that fail together.
struct BlockGroup {
    double factor = 0;                   ///< of safety, or the load of another search
    std::vector<std::string> blocks{};   ///< sorted
    double low = factor, high = factor;  ///< the loads at which they were stable and failed
    double volume = 0, mass = 0;         ///< [m^3, kg]
};

/// The upper bound that limit analysis gives for an answer: a tilt [rad], a factor of safety or a share of
/// the weight.
struct Ceiling {
    std::optional<double> value{};
    std::string reason{};  ///< why there is none
};

/// The answer for another failure displacement.
struct DisplacementAnswer {
    double displacement = 0;  ///< share of the median block size
    double load = 0;          ///< the answer
};

/// Of blocks that slide as one body (talus/block_theory.h), or of a row of columns that lean on each other.
struct LimitEquilibrium {
    double value = 0;                   ///< load of the search, as SearchResult::answer
    std::string kind{};                 ///< "sliding on one plane", ...
    bool translation_only = true;       ///< else toppling counts, too
    std::vector<std::string> blocks{};  ///< sorted
};

/// Strength that joints lose for good where they first slip or open.
struct LostStrength {
    enum class Kind : std::uint8_t { cohesion, tension, friction };
    Kind kind = Kind::cohesion;
    double share = 0;      ///< of the area of such joints at failure, 0..1
    bool is_torn = false;  ///< tensile strength is lost, too
};

struct SearchResult {
    SearchStatus status = SearchStatus::undecided;
    /// Midpoint of the bracket: tilt [rad], factor of safety or seismic coefficient; valid when found.
    double answer = 0;
    double low = 0;   ///< the last equilibrium (or -infinity)
    double high = 0;  ///< the load at which the assembly was found to fail (or infinity)
    FailureMode mode = FailureMode::none;
    std::vector<std::string> moving_blocks;  ///< sorted
    std::vector<BlockMotion> motions;        ///< evidence, one per free block, in the order of the blocks
    double failing_volume = 0;               ///< of the moving blocks [m^3]
    double failing_mass = 0;                 ///< [kg]
    /// fall whatever the strength: removed before the search; sorted
    std::vector<std::string> fallen_at_start;
    /// failed below the answer with less mass than AnalysisSettings::least_mass_share, in that order
    std::vector<BlockGroup> removed_groups{};
    /// The lowest and the highest answer found, and how each was found; valid when found.
    std::optional<std::pair<double, double>> answer_interval{};
    std::pair<std::string, std::string> answer_interval_reasons{};
    /// The least load at which blocks slide as one body that have enough mass to be the answer, or at which
    /// columns topple; where either can.
    std::optional<LimitEquilibrium> limit_equilibrium{};
    Ceiling upper_bound{};            ///< for joints that open as they slide, in the shape as built
    double failure_displacement = 0;  ///< failure displacement [share of the median block size]
    /// The answers by other failure displacements where they differ from the answer by more than the
    /// tolerance; ascending.
    std::vector<DisplacementAnswer> answers_by_displacement{};
    std::vector<PathPoint> path{};                ///< load against displacement, from the start of the search
    std::optional<LostStrength> lost_strength{};  ///< on which the answer depends
    /// Share of brittle joint area that has lost its cohesion in the failure, 0..1.
    double lost_cohesion = 0;
    /// The answer if that cohesion were kept, as in limit equilibrium; where some is lost.
    std::optional<double> kept_cohesion{};
    std::vector<BlockGroup> groups;  ///< of `safetyFactor`: successive failure groups and their factors; the
                                     ///< first is the answer
    bool groups_undecided = false;   ///< the search for the next group ended so
    /// Of flow whose apertures follow the joints: at the last stable load.
    std::optional<FlowCoupling> flow_coupling{};
    std::vector<Supports> supports;  ///< at failure, or at the last stable load
    std::vector<Probe> probes;       ///< the path, step by step
    std::int64_t steps = 0;          ///< along paths
    std::int64_t factors = 0;        ///< factorisations
    double wall_seconds = 0;
    TimeSpent time{};              ///< of that
    std::uint64_t state_hash = 0;  ///< over the state at the end of the last step computed
    std::size_t blocks = 0, interfaces = 0, contact_points = 0;
    std::vector<std::string> warnings;
    std::shared_ptr<const FailingState> failing;  ///< when `Control` asks for it
};

/// The tilt at which the assembly first fails. Loading order: gravity at the start tilt, water, tilt.
Result<SearchResult> criticalAngle(const Model& model, const Control& control = {},
                                   const SearchRules& rules = {});

/// Strength reduction (tan phi and C, peak and residual, over F) at the model's own tilt.
Result<SearchResult> safetyFactor(const Model& model, const Control& control = {},
                                  const SearchRules& rules = {});

/// The horizontal seismic coefficient, from the model's own upwards, at which the assembly first fails at its
/// own tilt.
Result<SearchResult> criticalAcceleration(const Model& model, const Control& control = {},
                                          const SearchRules& rules = {});

/// The model without these blocks, and without the joints, bolts and waters that belong to them alone.
Model withoutBlocks(const Model& model, const std::vector<std::string>& names);

}  // namespace talus
