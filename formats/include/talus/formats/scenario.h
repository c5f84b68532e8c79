#pragma once
// Scenario files: TOML in, a Model out, every fault with its line and column.
//
// The order of the model's blocks: stack by stack as in the file (its floor first, then column by column from
// the toe, row by row from the floor, slice by slice), then the blocks placed by hand, then those of the rock
// mass (b1, b2, ... from the bottom up, by x, by y). Joints stand in the
// order of the file, behind them those derived for bed levels with a friction angle of their own
// ("default@18.5deg").
//
// Optional keys beyond the plain ones: joint.NAME.residual_friction_deg, joint.NAME.dilation_deg,
// analysis.factor_tolerance, and water[].stack, the name of the stack meant where there are several.
// Limits: 64 MiB of text, two million blocks, 1000 vertices of a block placed by hand.

#include <atomic>
#include <bitset>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/model.h"
#include "talus/result.h"

namespace talus::formats {

/// Properties of a joint, by their place in kJointProperties.
using JointProperties = std::bitset<kJointPropertyCount>;

/// Origin of a joint of the model. Properties that are not given are those of its base joint, or follow
/// another property.
struct JointOrigin {
    enum class Kind : std::uint8_t {
        file,       ///< [joint.NAME]
        interface,  ///< an [[interface]] with properties of its own
        bed_level,  ///< a level of a stack's bed_friction_deg
        bridge      ///< between two faces that a finite joint parts in part
    };
    Kind kind = Kind::file;
    std::int32_t base = 0;  ///< the file's joint it is made from; itself for one of the file
    JointProperties given{};
    bool has_bed_levels = false;  ///< some stack compares bed levels with its friction
    bool is_mixed = false;        ///< some joint of a bridge is made of it and another one
};

/// Extent of the cuts of finite joints beyond the joints.
struct FiniteCuts {
    std::size_t interfaces = 0, bridged = 0;  ///< of faces they made; of these with intact rock between
    double area = 0, beyond = 0;              ///< of all; of that beyond the joints [m^2]
    bool are_bridges = false;                 ///< that part has the strength of rock_mass.bridge
};

/// A read scenario: the model, the text it came from, and where each field stands in it.
struct Scenario {
    Model model;
    std::string path;  ///< as given, for messages
    std::string text;
    std::map<std::string, std::pair<int, int>> places;  ///< "stack[0].columns" -> (line, column); 0: --set
    std::vector<JointOrigin> joint_origins{};           ///< per joint of the model
    std::vector<std::string> materials{};               ///< their names; blocks hold indices
    FiniteCuts finite_cuts{};
    std::vector<std::string>
        idle_joints{};  ///< of the rock mass: "joint_set[0] (J1)", those that parted no block
    /// Numbers that look like typing errors; cuts of a rock mass left out; joints that cut nothing
    std::vector<std::string> warnings{};
};

/// Reads and checks a scenario file. All faults found are reported, not just the first. \param stop  set it
/// to end the cutting of a rock mass early, with an error
Result<Scenario> readScenario(const std::string& path, const std::atomic<bool>* stop = nullptr);

/// Blocks of a model. Two million take about 1.6 GB before the engine adds its arrays.
inline constexpr std::int64_t kMostBlocks = 2'000'000;

/// The same for text already in memory; `path` is used in messages, and its folder is where mesh files are
/// looked for. More than `most_blocks` blocks are an error, found before anything of that size is made; for a
/// rock mass the limit is `rock_mass.max_blocks`.
Result<Scenario> parseScenario(const std::string& text, const std::string& path,
                               std::int64_t most_blocks = kMostBlocks,
                               const std::atomic<bool>* stop = nullptr);

/// An error if no block is free to move, with the joints that cut no block; else nothing.
std::optional<Error> noFreeBlock(const Scenario& scenario);

/// Adds file, line and column to errors of the engine (overlaps, water on no face, ...) by their field. A
/// field without a place gets that of the nearest enclosing table ("water[1].walls" falls back to
/// "water[1]").
std::vector<Error> placed(const Scenario& scenario, std::vector<Error> errors);

/// "FILE:LINE:COLUMN: error: FIELD: what was found, what is allowed" (line and column left out when unknown).
std::string format(const Error& error);

}  // namespace talus::formats
