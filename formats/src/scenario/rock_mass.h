#pragma once
// [rock_mass], [[joint_set]], [[single_joint]]: a region cut into blocks.

#include <optional>
#include <string>
#include <vector>

#include "scenario/directory.h"
#include "scenario/properties.h"
#include "scenario/reading.h"
#include "talus/model.h"
#include "talus/rock_mass.h"

namespace talus::formats::scenario {

/// One entry of rock_mass.fixed.
struct FixedEntry {
    std::string field;
    Place place;
    std::optional<BlockSelection> by_place;
    std::string name;  ///< instead: of a block
    Place name_place;
};

/// One entry of rock_mass.names.
struct PointName {
    std::string name, field;
    Place place;
    Vec3 point = Vec3::Zero();
};

/// What the tables say.
struct RockMassInput {
    RockMass description;
    NameList joint_names{"joint set or single joint"};  ///< of those that have a name
    std::vector<std::size_t> joint_of_name;             ///< index into the sets, then the singles
    std::string prefix;                                 ///< of its blocks' names
    std::vector<FixedEntry> fixed;
    std::vector<PointName> names;
    std::int32_t material = 0;
    double density = 0;      ///< of that material [kg/m^3]
    std::int32_t joint = 0;  ///< strength of faces no joint made
    std::optional<std::size_t> max_blocks{};
    Place place;
};

/// The blocks, in the order of `cut.blocks`.
struct RockMassBlocks {
    CutRockMass cut;
    std::vector<std::string> names;
    std::vector<bool> fixed;
};

/// Nothing when the scenario has no rock mass. \param folder  of the scenario, where mesh files are looked for
std::optional<RockMassInput> readRockMass(Report& report, TableReader& root, const Materials& materials,
                                          const Joints& joints, const std::string& folder);

/// The surface that rock_mass.region means; nothing when that is reported. \param table  rock_mass
std::optional<TriangleSurface> readRegion(Report& report, TableReader& table, const std::string& folder);

/// Cuts it, names its blocks and finds the fixed ones; faults are reported. \pre the input has no faults
std::optional<RockMassBlocks> cutBlocks(Report& report, const RockMassInput& input);

/// Appends the blocks. \pre the model has all its joints
void appendRockMass(const RockMassInput& input, RockMassBlocks blocks, Model& model);

/// All faces a joint made, or one plane of a joint set. \param first  index of the rock mass's first block
std::vector<WetFace> jointWalls(const CutRockMass& cut, std::size_t joint, std::optional<std::int64_t> plane,
                                std::int32_t first);

}  // namespace talus::formats::scenario
