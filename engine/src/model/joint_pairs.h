#pragma once
// Joints that a model gives to pairs of blocks, or to two of their faces, and the weaker of two faces' joints.

#include <cstdint>
#include <optional>
#include <vector>

#include "talus/model.h"

namespace talus {

/// Two faces of two blocks.
struct TwoFaces {
    std::size_t block_a, face_a, block_b, face_b;
};

/// By their blocks; of several that fit the first still counts.
std::vector<PairJoint> sortedByBlocks(std::vector<PairJoint> pairs);

/// The joint that the model gives to two faces, in whatever order. \pre `sorted` is sortedByBlocks
std::optional<std::int32_t> givenJoint(const std::vector<PairJoint>& sorted, const TwoFaces& faces);

/// Whether a joint has less friction than another at a time [s], of its strength over time.
bool isWeaker(const Joint& joint, const Joint& than, double time = 0);

}  // namespace talus
