#pragma once
// Contacts pressed so deep that their side must be remembered.
//
// Two convex bodies are pushed apart along the axis along which they overlap least. That axis reverses once
// more than half of a thin body is passed: new contacts would then push the other body out of the far side.
// Faces that overlap by more than half of the thinner body cannot be told from the far faces of both, and
// would be dropped. So a contact this deep is kept until it is less deep, and no contact of the same two
// parts may push against its normal. In histories only: quasi-static answers never depend on such depths.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contacts/near_pairs.h"
#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// Of the smaller block's size: contacts deeper than this are deep. Axes reverse at half of the thinner body.
/// Elastic contacts of equidimensional blocks stay below a hundredth of this. With much less, blocks that
/// slide around a corner on soft joints would keep the face they came from.
inline constexpr double kDeep = 0.25;

/// How deep an interface is at its origin, whatever its gap is counted from [m]; negative: open.
double depthOf(const Interfaces& interfaces, std::size_t interface, const RelativePose& pose);

/// Two faces with a deep contact.
struct DeepFaces {
    BoxPair parts;  ///< the lower number first
    std::int32_t block_a = 0;
    std::int32_t face_a = 0, face_b = 0;  ///< as their blocks number them
};

/// Those of the range, sorted by parts. \pre Springs::keep_energy
std::vector<DeepFaces> deepFaces(const State& state, const SearchRange& range);

/// Whether the parts of the places that begin at `begin` are held by deep faces.
bool areHeldByFaces(const State& state, std::size_t begin);

/// Whether one of these places is deep and pushes against an axis from the block a of the places to their b.
bool pushAgainst(const State& state, std::size_t begin, const Vec3& axis);

}  // namespace talus
