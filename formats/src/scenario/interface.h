#pragma once
// [[interface]]: a joint given for one pair of blocks, and properties in which the pair differs from it.

#include "scenario/directory.h"
#include "scenario/properties.h"
#include "scenario/reading.h"

namespace talus::formats::scenario {

/// Two different blocks named under "between"; nothing when that is reported.
std::optional<std::pair<std::int32_t, std::int32_t>> readBetween(Report& report, TableReader& table,
                                                                 const BlockDirectory& blocks);

std::vector<PairJoint> readInterfaces(Report& report, TableReader& root, const BlockDirectory& blocks,
                                      Joints& joints);

/// Adds interfaces given by hand to the model's pairs; they replace what a stack derived for the same two
/// blocks.
void addInterfaces(const std::vector<PairJoint>& interfaces, Model& model);

}  // namespace talus::formats::scenario
