#pragma once
// Gaps at faces by statics of the first order: how far blocks close a joint by turning together does not
// count.
//
// Two columns that overturn side by side turn by the same angle t about toes that lie a width w apart.
// Exactly, that presses the joint between them by w (1 - cos t), and friction there stops them after some
// microns. Columns of equal width would stand jammed at tilts far beyond the one at which each of them
// overturns. No real column is cut so exactly, and by then it has begun to topple. So equilibria are solved
// without that part of the gaps.

#include <vector>

#include "state/arrays.h"

namespace talus::equilibrium {

/// The difference between each interface's exact and first-order gap, taken off by its reference gap. For
/// pairs that had hardly turned or slid when this was made, displacements, arms and normals count from the
/// model as built; else from that moment. Gaps of blocks that turn far after that moment stay exact.
class FirstOrderGaps {
 public:
    /// \pre  reference gaps are exact: nothing is set
    explicit FirstOrderGaps(const State& state);

    /// Makes the gaps those of first order in the displacements to some poses.
    /// \pre  the interfaces are those it was made with. Writes: reference gaps
    void set(State& state, const PositionArray& position, const QuaternionArray& orientation);

    /// Makes the gaps exact again, as a search for contacts needs them. Writes: reference gaps
    void remove(State& state) const;

 private:
    /// A block's displacement and turn, from one of the poses below.
    struct Motion {
        Vec3 shift, turn;
    };
    struct Places {
        PositionArray position;
        QuaternionArray orientation;
        std::vector<Motion> motion{};  ///< by block
    };
    /// An interface as it lies in one of them.
    struct Pair {
        std::size_t interface = 0, block_a = 0, block_b = 0;
        bool is_as_built = false;
        Vec3 reference = Vec3::Zero();  ///< exact
        Vec3 gap = Vec3::Zero();        ///< with that
        Vec3 arm_a = Vec3::Zero();      ///< from a's centroid to the origin
        Vec3 arm_b = Vec3::Zero();      ///< from b's centroid to its material point over the origin
        Vec3 apart = Vec3::Zero();      ///< from the one to the other
        Vec3 along_1 = Vec3::Zero(), along_2 = Vec3::Zero();  ///< b's directions that were e1 and e2
        Vec3 normal = Vec3::Zero();
    };

    Pair pairOf(const State& state, std::size_t interface, bool is_as_built) const;
    /// Exact gap less that of first order: at the interface's origin, and its slopes [m, -, -].
    static Vec3 secondOrder(const Pair& pair, const Vec3& exact, const Motion& a, const Motion& b);

    Places made_, built_;
    std::vector<Pair> pairs_;
};

}  // namespace talus::equilibrium
