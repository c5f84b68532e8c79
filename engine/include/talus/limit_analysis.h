#pragma once
// Limit analysis of rigid blocks: the greatest load for which contact forces exist that balance every block
// within the strength of every contact point. Friction is associated: a slide opens the joint by tan(phi) of
// its length.
//
// By the static theorem no equilibrium of the real, non-associated joints lies above that load (Drucker 1954;
// for blocks Livesley 1978). It is an upper bound of every critical angle and factor of safety while
// displacements are small. The bound is close where blocks hinge or slide, and high where they interlock.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "talus/analysis.h"
#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// How one block moves in the mechanism. The greatest speed of a block is 1 m/s.
struct BlockVelocity {
    std::string block;
    Vec3 velocity = Vec3::Zero();  ///< of its centroid [m/s]
    Vec3 spin = Vec3::Zero();      ///< [rad/s]
    double speed = 0;              ///< of its centroid, and of its fastest corner with the spin [m/s]
    bool moving = false;           ///< speed at least `kMechanismShare` of the fastest block's
};
inline constexpr double kMechanismShare = 0.01;

struct LimitSettings {
    double factor_width = 1e-4;               ///< of the bracket of a factor, as a share of it
    std::size_t max_contact_points = 20'000;  ///< beyond that the programme is not made
    std::vector<std::string> left_out{};      ///< blocks to leave out
};

/// The true limit of the associated problem lies between `lower` and `upper`: pyramids inside and outside
/// replace the friction cones, and are refined where that changes the limit. In a plane section both are the
/// cone.
struct LimitResult {
    SearchStatus status = SearchStatus::undecided;
    double lower = -kInfinity;  ///< [rad] for a tilt
    double upper = kInfinity;
    std::vector<std::string> moving_blocks;  ///< of the mechanism, sorted
    /// one per free block, in the order of the blocks; empty where none fails
    std::vector<BlockVelocity> mechanism;
    /// everything is symmetric about one vertical plane: three equations a block
    bool plane_section = false;
    std::size_t blocks = 0;             ///< free ones
    std::size_t contact_points = 0;     ///< in the programme
    std::size_t rows = 0, columns = 0;  ///< of the largest programme
    int programmes = 0;
    std::int64_t iterations = 0;  ///< of the simplex method, in all
    double wall_seconds = 0;
    std::vector<std::string> warnings;
};

/// Errors: those of the model; more contact points than `max_contact_points`.
Result<LimitResult> limitAnalysis(const Model& model, Varied load, const Control& control = {},
                                  const LimitSettings& settings = {});

/// Contact points up to which the upper bound is computed by default: it then takes less than a second, a
/// small share of the search. A programme in space takes ten times as long as one of a plane section.
inline constexpr std::size_t kCeilingPoints = 300;
inline constexpr std::size_t kCeilingPointsInSection = 2000;

/// The upper bound of limit analysis, without value where it is not made. \param always whatever the model's
/// size
Result<Ceiling> limitCeiling(const Model& model, Varied load, bool always, const Control& control = {},
                             const LimitSettings& settings = {});

/// Whether a stable load of a search exceeds the upper bound by more than elastic joints explain: half a per
/// cent of a factor, 0.05 degrees of a tilt.
bool isAbove(double stands, const Ceiling& ceiling, Varied load);

}  // namespace talus
