#include "model/joint_choice.h"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

std::pair<std::int32_t, std::int32_t> blocksOf(const PairJoint& pair) {
    return std::minmax(pair.block_a, pair.block_b);
}

/// \param face_a  of `block_a`, one of the pair's blocks
bool isMeant(const PairJoint& pair, std::size_t block_a, std::size_t face_a, std::size_t face_b) {
    if (pair.face_a < 0) return true;
    const auto a = static_cast<std::int32_t>(face_a), b = static_cast<std::int32_t>(face_b);
    return pair.block_a == static_cast<std::int32_t>(block_a) ? pair.face_a == a && pair.face_b == b
                                                              : pair.face_a == b && pair.face_b == a;
}

}  // namespace

JointChoice::JointChoice(const Model& model) : model_(model), pairs_(model.pair_joints) {
    std::stable_sort(pairs_.begin(), pairs_.end(),
                     [](const PairJoint& a, const PairJoint& b) { return blocksOf(a) < blocksOf(b); });
}

std::int32_t JointChoice::between(std::size_t block_a, std::size_t face_a, std::size_t block_b,
                                  std::size_t face_b) const {
    const std::pair<std::int32_t, std::int32_t> key =
        std::minmax({static_cast<std::int32_t>(block_a), static_cast<std::int32_t>(block_b)});
    const auto found =
        std::lower_bound(pairs_.begin(), pairs_.end(), key,
                         [](const PairJoint& pair, const auto& k) { return blocksOf(pair) < k; });
    for (auto pair = found; pair != pairs_.end() && blocksOf(*pair) == key; ++pair)
        if (isMeant(*pair, block_a, face_a, face_b)) return pair->joint;
    const std::int32_t joint_a = model_.blocks[block_a].face_joint[face_a];
    const std::int32_t joint_b = model_.blocks[block_b].face_joint[face_b];
    const double phi_a = frictionAngle(model_.joints[static_cast<std::size_t>(joint_a)]);
    const double phi_b = frictionAngle(model_.joints[static_cast<std::size_t>(joint_b)]);
    if (phi_a == phi_b) return std::min(joint_a, joint_b);
    return phi_a < phi_b ? joint_a : joint_b;
}

}  // namespace talus
