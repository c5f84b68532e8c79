#pragma once
// Which blocks may touch: pairs of overlapping boxes.

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/box_tree.h"

namespace talus {

using BoxPair = std::pair<std::int32_t, std::int32_t>;

/// All pairs i < j of overlapping boxes, sorted. `parallel` runs in the caller's TBB arena; the result is the
/// same for any number of threads and for the serial path. Close to linear in the number of boxes and pairs,
/// whatever the mix of sizes.
/// \pre finite boxes, min <= max
std::vector<BoxPair> findNeighbours(const std::vector<Box>& boxes, bool parallel);

/// For each box whether it may overlap a marked one: 1 for all that do, for the marked ones, and for some
/// near ones. In time linear in the number of boxes.
/// \pre finite boxes, min <= max; as many marks as boxes
std::vector<char> findNearMarked(const std::vector<Box>& boxes, const std::vector<char>& marked);

}  // namespace talus
