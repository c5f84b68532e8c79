#pragma once
// [rock_mass], [[joint_set]], [[single_joint]]: a region cut into blocks.

#include <optional>
#include <string>
#include <vector>

#include "scenario/directory.h"
#include "scenario/properties.h"
#include "scenario/reading.h"
#include "scenario/slope_turn.h"
#include "talus/ending_sets.h"
#include "talus/fractures.h"
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

/// One entry of fracture_set.
struct FractureSetInput {
    FractureSet drawn;  ///< from a file: name, strength and field only
    bool is_file = false;
    std::vector<Fracture> from_file{};
};

/// A joint_set with `ends_at`, until the other joint is known.
struct EndingSetInput {
    EndingSet ending;
    std::string other;  ///< its name
    Place place;        ///< of that
};

/// What the tables say.
struct RockMassInput {
    RockMass description;
    NameList joint_names{"joint set or single joint"};  ///< of those that have a name
    std::vector<std::size_t> joint_of_name;             ///< index into the sets, then the singles
    std::string prefix;                                 ///< of its blocks' names
    std::vector<FixedEntry> fixed;
    std::vector<PointName> names;
    std::vector<FractureSetInput> fracture_sets{};
    std::vector<EndingSetInput> ending_sets{};
    std::int32_t material = 0;
    double density = 0;      ///< of that material [kg/m^3]
    std::int32_t joint = 0;  ///< strength of faces no joint made
    std::optional<std::int32_t>
        bridge{};  ///< of the rock between finite joints; none: their strength goes on
    std::optional<std::size_t> max_blocks{};
    bool has_mesh = false;                         ///< its region is one from a file
    SlopeTurn turn{};                              ///< of a profile
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounds of the region before it is turned [m]
    Place place;
};

/// The blocks, in the order of `cut.blocks`.
struct RockMassBlocks {
    CutRockMass cut;
    std::vector<std::string> names;
    std::vector<bool> fixed;
    std::vector<JointCut> finite_cuts{};
};

/// Nothing when the scenario has no rock mass. \param folder  of the scenario, where mesh files are looked
/// for
std::optional<RockMassInput> readRockMass(Report& report, TableReader& root, const Materials& materials,
                                          const Joints& joints, const std::string& folder);

struct Region {
    TriangleSurface surface;  ///< not turned yet
    bool is_mesh = false;
    SlopeTurn turn{};
};

/// The surface that rock_mass.region means; nothing when that is reported. \param table  rock_mass
std::optional<Region> readRegion(Report& report, TableReader& table, const std::string& folder);

/// [joint.NAME] by the key `joint`, else by the joint's own name, else the default.
std::int32_t readStrength(Report& report, TableReader& table, const std::string& name, const Joints& joints);

void readFractureSets(Report& report, TableReader& root, const Joints& joints, const std::string& folder,
                      RockMassInput& input);

/// Finds the joints at which sets end.
void resolveEndingSets(Report& report, RockMassInput& input);

/// Their joints become single joints. \pre the input has no faults
void appendEndingSets(Report& report, RockMassInput& input);

/// Draws the fracture sets; their discs become single joints. \pre the input has no faults
void appendFractures(Report& report, RockMassInput& input);

/// Cuts it, names its blocks and finds the fixed ones; faults are reported. \pre the input has no faults
std::optional<RockMassBlocks> cutBlocks(Report& report, const RockMassInput& input);

/// A warning of blocks of a rugged ground that are too small to be intended, with advice; nothing where there
/// are none.
std::optional<std::string> dustWarning(const RockMassBlocks& blocks);

FiniteCuts summaryOf(const RockMassInput& input, const std::vector<JointCut>& cuts);

/// A warning that cuts continue beyond their joints, with advice; nothing where they do not, or are bridged.
std::optional<std::string> bridgeNote(const FiniteCuts& cuts);

/// Why steady flow is refused beside these: a joint conducts over the whole of its cut, also through the rock
/// beyond it. Nothing where the cuts end with their joints.
std::optional<std::string> flowBeyondJoints(const FiniteCuts& cuts);

/// Appends the blocks, and the mixed joints between blocks that a finite joint separates in part.
void appendRockMass(const RockMassInput& input, RockMassBlocks blocks, Joints& joints, Model& model);

/// All faces a joint made, or one plane of a joint set; not those wholly in a bridge. \param first  index of
/// the rock mass's first block
std::vector<WetFace> jointWalls(const RockMassInput& input, const RockMassBlocks& blocks, std::size_t joint,
                                std::optional<std::int64_t> plane, std::int32_t first);

/// How far water in a joint reaches: as far as the joint where rock bridges bound it, else as far as its
/// faces (empty).
std::vector<Vec3> wetOutline(const RockMassInput& input, std::size_t joint);

}  // namespace talus::formats::scenario
