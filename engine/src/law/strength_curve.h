#pragma once
// The shear strength of a law over the normal stress as a table of quadratic pieces. Kernels then need no
// logarithm, tangent or power, all laws cost the same, and a law is a formula in plain C++.
//
// There are 64 pieces to a power of two. The parabola through the ends and the middle of a piece is off by
// less than h^3 |f'''| / 125 with h = sigma / 64: 2e-8 for a power law, 2e-7 for Barton and Bandis' steepest,
// nothing for a tabulated envelope. Kinks are ends of pieces. Below 1 Pa the strength is linear down to its
// value without normal stress. The alternative is logarithm and tangent for lanes: some 40 dependent
// operations, against 5 and a look-up, and another set for each law.

#include <memory>
#include <vector>

#include "simd/table.h"

namespace talus {
struct Joint;
}

namespace talus::contact {

/// Shear strength at a normal stress that is not negative [Pa].
template <class V>
TALUS_KERNEL V strengthOnCurve(const simd::TablesOf<V>& curve, V stress) {
    const simd::FourOf<V> piece = pieceAt(curve, stress);
    return piece.number[0] + stress * (piece.number[1] + stress * piece.number[2]);
}

/// Its exact derivative: of the pieces, not of the formula.
template <class V>
TALUS_KERNEL V slopeOfCurve(const simd::TablesOf<V>& curve, V stress) {
    const simd::FourOf<V> piece = pieceAt(curve, stress);
    return piece.number[1] + (stress + stress) * piece.number[2];
}

/// The strength of a joint's law times `factor`; null for Coulomb's law, which is no curve.
std::shared_ptr<const std::vector<double>> strengthCurve(const Joint& joint, double factor);

}  // namespace talus::contact
