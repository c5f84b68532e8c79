#pragma once
// Which joint lies between two faces.

#include <cstdint>
#include <vector>

#include "talus/model.h"

namespace talus {

/// The joint of a pair of blocks or of two of their faces, else of the two faces' joints the one with less
/// friction at time 0, the one declared first on ties. Borrows the model.
class JointChoice {
 public:
    explicit JointChoice(const Model& model);

    /// Index into the model's joints. The order of the two sides does not matter.
    std::int32_t between(std::size_t block_a, std::size_t face_a, std::size_t block_b,
                         std::size_t face_b) const;

 private:
    const Model& model_;
    std::vector<PairJoint> pairs_;  ///< sorted by pair of blocks; of several that fit the first counts
};

}  // namespace talus
