#include "model/joint_pairs.h"

#include <algorithm>
#include <utility>

#include "model/over_time.h"

namespace talus {
namespace {

std::pair<std::int32_t, std::int32_t> blocksOf(const PairJoint& pair) {
    return std::minmax(pair.block_a, pair.block_b);
}

bool isMeant(const PairJoint& pair, const TwoFaces& faces) {
    if (pair.face_a < 0) return true;
    const auto a = static_cast<std::int32_t>(faces.face_a), b = static_cast<std::int32_t>(faces.face_b);
    return pair.block_a == static_cast<std::int32_t>(faces.block_a) ? pair.face_a == a && pair.face_b == b
                                                                    : pair.face_a == b && pair.face_b == a;
}

}  // namespace

std::vector<PairJoint> sortedByBlocks(std::vector<PairJoint> pairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const PairJoint& a, const PairJoint& b) { return blocksOf(a) < blocksOf(b); });
    return pairs;
}

std::optional<std::int32_t> givenJoint(const std::vector<PairJoint>& sorted, const TwoFaces& faces) {
    const std::pair<std::int32_t, std::int32_t> key =
        std::minmax({static_cast<std::int32_t>(faces.block_a), static_cast<std::int32_t>(faces.block_b)});
    const auto found =
        std::lower_bound(sorted.begin(), sorted.end(), key,
                         [](const PairJoint& pair, const auto& k) { return blocksOf(pair) < k; });
    for (auto pair = found; pair != sorted.end() && blocksOf(*pair) == key; ++pair)
        if (isMeant(*pair, faces)) return pair->joint;
    return std::nullopt;
}

bool isWeaker(const Joint& joint, const Joint& than, double time) {
    return frictionAngleAt(joint, time) < frictionAngleAt(than, time);
}

}  // namespace talus
