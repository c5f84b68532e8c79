// Whether anything in a scenario can move.

#include <algorithm>

#include "talus/formats/scenario.h"

namespace talus::formats {

namespace {

constexpr std::size_t kTold = 5;  // joints by name; of more, how many

/// "single_joint[0] (A), single_joint[1] (B) and 3 more"
std::string listOf(const std::vector<std::string>& joints) {
    const std::size_t told = std::min(joints.size(), kTold);
    std::string list;
    for (std::size_t k = 0; k < told; ++k)
        list += (k == 0 ? "" : k + 1 == joints.size() ? " and " : ", ") + joints[k];
    return joints.size() > told ? list + " and " + std::to_string(joints.size() - told) + " more" : list;
}

}  // namespace

std::optional<Error> noFreeBlock(const Scenario& scenario) {
    const std::vector<Block>& blocks = scenario.model.blocks;
    const auto with = [&](Motion motion) {
        return std::count_if(blocks.begin(), blocks.end(),
                             [&](const Block& block) { return block.motion == motion; });
    };
    if (blocks.empty() || with(Motion::free) > 0) return std::nullopt;
    const std::string held = with(Motion::driven) > 0 ? "fixed or driven" : "fixed";
    std::string found = "found no block that is free to move: ";
    found += blocks.size() == 1 ? "the only block is " + held
                                : "all " + std::to_string(blocks.size()) + " blocks are " + held;
    const std::vector<std::string>& idle = scenario.idle_joints;
    if (!idle.empty()) found += "; " + listOf(idle) + (idle.size() == 1 ? " cuts" : " cut") + " no block";
    return Error{blocks[0].field, found + ", allowed: at least one free block"};
}

}  // namespace talus::formats
