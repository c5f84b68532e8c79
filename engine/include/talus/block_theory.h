#pragma once
// Block theory: which blocks of a slope can move at all, and at which factor of safety, by limit equilibrium.
//
// A block is removable when it can move in some direction without pressing into a neighbour (R. E. Goodman
// and G.-H. Shi, Block Theory and Its Application to Rock Engineering, 1985). Its direction of motion follows
// from the resultant force on it by vector algebra (P. M. Warburton, Int. J. Rock Mech. Min. Sci. 18:
// 415-427, 1981). Blocks that obstruct each other along a direction move as one body.
//
// Translation only: toppling is not covered. Contacts are those of the model as built; stiffness plays no
// part.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "talus/control.h"
#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// How a body moves under the resultant of the forces on it.
enum class SlidingMode : std::uint8_t {
    none,    ///< the resultant has no component along any free direction
    falls,   ///< it leaves every plane, or slides along planes without normal force
    slides,  ///< on one plane
    wedge    ///< along the line of intersection of two planes
};
const char* toString(SlidingMode mode);

/// A plane that a body slides on and presses: all its contacts of one orientation and one joint.
struct SlidingPlane {
    std::string joint;
    Vec3 normal = Vec3::UnitZ();  ///< unit, into the body
    double area = 0;              ///< of its contacts [m^2]
    double normal_force = 0;      ///< effective, compression positive [N]
    double resistance = 0;        ///< shear strength at its mean normal stress, times area [N]
};

/// Limit equilibrium of one body.
struct Sliding {
    SlidingMode mode = SlidingMode::none;
    Vec3 direction = Vec3::Zero();  ///< unit, in the model frame; zero without a mode
    double factor = kInfinity;      ///< resisting over driving; 0: nothing holds it; infinity without a mode
    double driving = 0;             ///< component of the resultant along the direction [N]
    double resisting = 0;           ///< shear strength of all contacts it slides along [N]
    std::vector<SlidingPlane> planes;  ///< that carry normal force, most of it first
    std::vector<std::string> joints;   ///< of these planes, sorted, each once
};

/// A free block by itself: all its neighbours are held still.
struct KeyBlock {
    std::string name;
    bool removable = false;
    /// Where it is removable: a direction in which it can leave. That of sliding, if it has one; else the
    /// free direction nearest to the outward normals of its free faces.
    Vec3 free_direction = Vec3::Zero();
    Sliding sliding;
    double volume = 0;  ///< [m^3]
    double mass = 0;    ///< [kg]
};

/// Free blocks that move as one body. One block is a group, too.
struct MovingGroup {
    std::vector<std::string> blocks;  ///< sorted
    /// Blocks that lean on the group, are unstable without it, and cannot move with it; sorted. Their forces
    /// on the group are not counted: the factor is that of the group without them.
    std::vector<std::string> carries{};
    Sliding sliding;
    double volume = 0;  ///< [m^3]
    double mass = 0;    ///< [kg]
};

struct KeyBlockSettings {
    std::size_t most_groups = 100;  ///< groups to return, those with the least factors
    bool factor_volume = true;      ///< the curve of factor and volume, too
};

struct KeyBlockResult {
    std::vector<KeyBlock> blocks;  ///< one per free block, in the order of the model
    std::vector<MovingGroup>
        groups;  ///< ascending by factor; of equal factors the heavier first; no two of the same blocks
    /// The curve of factor and volume. Both rise along it. The first group of at least some volume has the
    /// least factor of all such groups examined, groups that carry others excepted.
    std::vector<MovingGroup> factor_volume;
    std::size_t directions = 0;     ///< tried for every block
    std::size_t groups_judged = 0;  ///< different ones
    bool interrupted = false;       ///< `control` asked to stop: groups are those found so far
    double wall_seconds = 0;
    std::vector<std::string> warnings;
};

/// Errors: those of the model; a model without a fixed or driven block.
Result<KeyBlockResult> keyBlocks(const Model& model, const Control& control = {},
                                 const KeyBlockSettings& settings = {});

/// The group with the least factor of safety.
struct LeastGroup {
    double value = 0;                 ///< factor of safety
    const char* kind = "";            ///< "sliding on one plane", ...
    std::vector<std::string> blocks;  ///< sorted
};

/// Groups that carry others are left out; among equal factors the heaviest counts. Falling blocks have factor
/// 0 and come first: `withoutBlocks` removes them. Nothing where no group can move. Errors: those of
/// `keyBlocks`, and an interruption.
Result<std::optional<LeastGroup>> leastGroup(const Model& model, const Control& control = {});

}  // namespace talus
