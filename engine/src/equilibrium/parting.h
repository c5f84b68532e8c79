#pragma once
// How far neighbouring blocks have parted or slid since a moment.

#include <vector>

#include "equilibrium/balance.h"

namespace talus::equilibrium {

/// The corners of all patches as material points of both their blocks. The record survives when a patch is
/// clipped again or vanishes.
class Parting {
 public:
    Parting() = default;
    /// From the poses as they are in the state and its balance.
    Parting(const State& state, const Balance& balance, Poses poses);

    const Poses& poses() const { return poses_; }
    /// The largest distance between two points that coincided then [m].
    double now(const Poses& poses) const;
    /// The same along the patches alone: how far blocks have slid over each other [m].
    double slidNow(const Poses& poses) const;

 private:
    struct Corner {
        std::size_t block_a = 0, block_b = 0;
        Vec3 in_a = Vec3::Zero(), in_b = Vec3::Zero();  ///< in the blocks' own frames [m]
        Vec3 normal_in_a = Vec3::Zero();
    };
    /// From the point of a to that of b, in the model frame [m].
    static Vec3 apart(const Corner& corner, const Poses& poses);
    Poses poses_{};
    std::vector<Corner> corners_{};
    std::vector<std::size_t> alone_{};  ///< blocks that touch nothing: parting from their own position
};

}  // namespace talus::equilibrium
