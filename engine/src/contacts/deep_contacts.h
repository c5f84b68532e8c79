#pragma once
// Contacts pressed so deep that the side they came from has to be remembered.
//
// Two convex bodies are pushed apart along the axis along which they overlap least. That axis turns
// round once more than half of a thin body is passed: contacts made anew would then push the other body
// on, out of the far side. A pair of faces that overlaps by more than half of the thinner body is not
// told from faces that look at each other through it, and would be dropped. So a contact this deep
// stays what it is until it is less deep, and parts of two bodies that have one are not pushed against
// its normal. In histories only: in quasi-static work nothing that is pressed this deep gives a
// verdict.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contacts/near_pairs.h"
#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// Of the smaller block's size: contacts deeper than this are deep. Half of the thinner body is where
/// axes turn round. Elastic contacts of blocks as thick as they are long stay below a hundredth of
/// this; with much less, corners that are being passed round on soft joints would keep the face they
/// came from.
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
