#pragma once
// Bolts: where each ties two blocks, its forces there, and its plastic displacement.
//
// Reads:  the model's bolts; at the start shapes and poses; then poses, load.gravity_share (the pretension
//         comes with the weight)
// Writes: state.bolts and its parts at the build; its memory and forces in `update`

#include <span>
#include <string>
#include <vector>

#include "forces/tie.h"
#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/result.h"
#include "talus/supports.h"

namespace talus::bolts {

/// Errors: a head or an end outside of all blocks, both ends in one, no free block between them.
std::vector<Error> build(State& state, ForceParts& parts);

void update(State& state);

inline std::span<const std::int32_t> blocks(const State&, const ForceParts& parts) { return parts.block; }
Wrench on(const State& state, const ForceParts& parts, std::size_t block);

std::vector<Tie> ties(const State& state);
/// Between two poses, nothing committed.
TieForce between(const State& state, std::size_t segment, const TiedPose& a, const TiedPose& b);
/// The elastic stiffness of the segments on a block, and where they pull: for the stable time step.
std::vector<std::pair<std::int32_t, TieForce>> springsOn(const State& state, const ForceParts& parts,
                                                         std::size_t block);
double storedEnergy(const State& state);
/// How much farther blocks part until the last segment holds all it can [m]; 0 without any.
double reach(const State& state);

/// Error: a bolt with dowel action.
Result<std::vector<TieLimit>> limits(const State& state);

std::vector<ForceArray> memory(const State& state);
void remember(State& state, std::span<const ForceArray> arrays);

/// For each bolt of the model: the state of its most loaded segment, and a line from joint to joint.
std::vector<SupportReport> reports(const State& state);
SupportLines lines(const State& state);

}  // namespace talus::bolts
