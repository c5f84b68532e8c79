#pragma once
// [[water]]: in a joint of a stack, on the interface of two blocks, or on one face of a block.

#include <optional>
#include <string>
#include <vector>

#include "scenario/directory.h"
#include "scenario/reading.h"
#include "scenario/rock_mass.h"
#include "scenario/stack.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// What a [[water]] table says; its walls are looked up once the blocks are built.
struct WaterEntry {
    enum class Where { stack_joint, between_blocks, block_face, rock_joint, below_surface };
    Where where = Where::stack_joint;
    Water water;                ///< complete but for its walls
    PhreaticSurface surface{};  ///< below_surface
    Place place;
    std::size_t stack = 0;                ///< stack_joint: which stack
    int fissure = 0;                      ///< stack_joint: between this many columns and the others
    std::int32_t block = 0;               ///< block_face
    Vec3 direction = Vec3::UnitX();       ///< block_face: the face whose normal is nearest
    std::size_t rock_joint = 0;           ///< rock_joint: index into the sets, then the single joints
    std::optional<std::int64_t> plane{};  ///< rock_joint: one plane of a set
    /// rock_joint: its level is this share of the height of `crack` and, unless `fills_crack_alone`, of the
    /// joint [-]
    std::optional<double> filled{};
    std::optional<std::size_t>
        crack{};  ///< with `filled`: the joint of a tension crack, as rock_joint; it is wet, too
    bool fills_crack_alone = false;
};

/// The joints that can hold water.
struct WaterPlaces {
    const std::vector<Stack>& stacks;
    const RockMassInput* rock = nullptr;
    std::string folder{};  ///< where files are looked for: "" or with a slash at its end
};

std::vector<WaterEntry> readWaters(Report& report, TableReader& root, const WaterPlaces& places,
                                   const BlockDirectory& blocks);

/// What bounds water in a rock mass.
struct JointWalls {
    std::vector<WetFace> faces{};
    std::vector<Vec3> outline{};  ///< Water::outline
    std::string name{};           ///< of the joint
};
struct RockWalls {
    JointWalls joint{}, crack{};
};

/// Looks up the walls and adds the waters to the model. \param rock_walls  per entry, of those in a rock mass
/// \pre the model has all its blocks
void appendWaters(Report& report, const std::vector<WaterEntry>& entries, const std::vector<Stack>& stacks,
                  const std::vector<RockWalls>& rock_walls, Model& model);

}  // namespace talus::formats::scenario
