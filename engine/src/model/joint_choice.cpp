#include "model/joint_choice.h"

#include <utility>

#include "model/joint_pairs.h"

namespace talus {

JointChoice::JointChoice(const Model& model) : model_(model), pairs_(sortedByBlocks(model.pair_joints)) {}

std::int32_t JointChoice::between(std::size_t block_a, std::size_t face_a, std::size_t block_b,
                                  std::size_t face_b) const {
    if (const auto given = givenJoint(pairs_, {block_a, face_a, block_b, face_b})) return *given;
    std::int32_t first = model_.blocks[block_a].face_joint[face_a];
    std::int32_t second = model_.blocks[block_b].face_joint[face_b];
    if (first == second) return first;
    if (second < first) std::swap(first, second);
    const auto joint = [&](std::int32_t j) -> const Joint& {
        return model_.joints[static_cast<std::size_t>(j)];
    };
    return isWeaker(joint(second), joint(first)) ? second : first;
}

}  // namespace talus
