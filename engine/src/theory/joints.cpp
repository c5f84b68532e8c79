#include "theory/joints.h"

namespace talus::theory {

const Joint& jointBetween(const Model& model, const JointChoice& choice, const WetFace& a, const WetFace& b) {
    return model.joints[static_cast<std::size_t>(
        choice.between(static_cast<std::size_t>(a.block), static_cast<std::size_t>(a.face),
                       static_cast<std::size_t>(b.block), static_cast<std::size_t>(b.face)))];
}

std::optional<WetFace> faceTowards(const Model& model, std::int32_t block, const Vec3& direction) {
    const Polyhedron& shape = model.blocks[block].shape;
    for (std::size_t face = 0; face < shape.faces.size(); ++face)
        if (shape.faceNormal(face).dot(direction) > 1 - 1e-12)
            return WetFace{block, static_cast<std::int32_t>(face)};
    return std::nullopt;
}

}  // namespace talus::theory
