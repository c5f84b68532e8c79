// Which blocks touch at the start.

#include <algorithm>

#include "build/build.h"
#include "talus/model_check.h"

namespace talus {

Result<std::vector<TouchingPair>> touchingPairs(const Model& model) {
    const auto state = buildState(keptByCaller(model), false);
    if (!state) return state.errors();
    const Interfaces& interfaces = state->interfaces;
    std::vector<TouchingPair> pairs;
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        const auto [a, b] = std::minmax(interfaces.block_a[i], interfaces.block_b[i]);
        pairs.push_back({a, b, interfaces.joint[i]});
    }
    const auto before = [](const TouchingPair& x, const TouchingPair& y) {
        return std::pair(x.block_a, x.block_b) < std::pair(y.block_a, y.block_b);
    };
    std::stable_sort(pairs.begin(), pairs.end(), before);
    pairs.erase(std::unique(pairs.begin(), pairs.end(),
                            [&](const TouchingPair& x, const TouchingPair& y) {
                                return !before(x, y) && !before(y, x);
                            }),
                pairs.end());
    return pairs;
}

}  // namespace talus
