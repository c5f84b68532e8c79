#pragma once
// Gaps at faces as they are in statics of the first order: what blocks close of a joint by turning together counts not.
//
// Two columns that overturn side by side turn by the same angle t about toes that lie a width w apart. Exactly, that presses the
// joint between them by w (1 - cos t), and friction on what it presses stops them after some microns: columns of one width stand jammed
// at tilts far beyond that at which each of them overturns. No column that is cut is as exact as that, and to get there is to have
// begun to topple. So a rest has to be one without that part of the gaps, too (analysis/probing.cpp).

#include <vector>

#include "state/arrays.h"

namespace talus::equilibrium {

/// By what way blocks close or open the joints between them to first order. Ways, arms and normals are those from the model as it was
/// built, for pairs that had hardly turned or slid when the assembly last stood, else from where it stood then. Of what has turned much since the gaps
/// stay exact.
class FirstOrderGaps {
 public:
    /// \param stood  where the assembly last stood  \param state  the interfaces and their reference gaps
    FirstOrderGaps(const State& stood, const State& state);

    /// Sets the reference gaps so that the gaps are those of first order in the ways to where the blocks are now.
    /// \pre the interfaces are those it was made with. Writes: reference gaps
    void set(State& state) const;

    /// The largest force by which an interface's exact gap differs from that of first order, over the weight of the lighter free
    /// block of the two.
    double share(const State& state) const;

 private:
    /// Exact gap less that of first order: at the interface's origin, and its slopes [m, -, -].
    Vec3 secondOrder(const State& state, std::size_t interface) const;

    struct Places {
        PositionArray position;
        QuaternionArray orientation;
    };
    Places stood_, built_;
    std::vector<bool> turned_since_;  ///< by block, since the assembly stood
    std::vector<bool> is_as_built_;   ///< by interface: where the assembly stood
    std::vector<Vec3> reference_;     ///< gaps, of the interfaces
};

}  // namespace talus::equilibrium
