#include "joints.h"

#include <algorithm>

namespace talus::theory {

JointTable::JointTable(const Model& model) : model_(model) {
    for (const PairJoint& pair : model.pair_joints)
        of_pair_[std::minmax(pair.block_a, pair.block_b)] = pair.joint;
}

const Joint& JointTable::between(const WetFace& a, const WetFace& b) const {
    const auto pair = of_pair_.find(std::minmax(a.block, b.block));
    if (pair != of_pair_.end()) return model_.joints[pair->second];
    const std::int32_t joint_a = model_.blocks[a.block].face_joint[a.face];
    const std::int32_t joint_b = model_.blocks[b.block].face_joint[b.face];
    const Joint& first = model_.joints[std::min(joint_a, joint_b)];
    const Joint& second = model_.joints[std::max(joint_a, joint_b)];
    return second.friction < first.friction ? second : first;
}

std::optional<WetFace> faceTowards(const Model& model, std::int32_t block, const Vec3& direction) {
    const Polyhedron& shape = model.blocks[block].shape;
    for (std::size_t face = 0; face < shape.faces.size(); ++face)
        if (shape.faceNormal(face).dot(direction) > 1 - 1e-12)
            return WetFace{block, static_cast<std::int32_t>(face)};
    return std::nullopt;
}

bool isPlainCoulomb(const Joint& joint) {
    return joint.tensile_strength == 0 && joint.dilation == 0 && joint.residual_cohesion >= joint.cohesion &&
           joint.residual_friction >= joint.friction;
}

bool partsFreely(const Joint& joint) {
    return joint.tensile_strength == 0 && joint.cohesion == 0 && joint.dilation == 0;
}

}  // namespace talus::theory
