#include "model/water_level.h"

namespace talus {

double levelAt(const Water& water, double time) {
    const auto& level = water.level;
    if (level.empty()) return 0.0;
    if (time <= level.front().time) return level.front().value;
    for (std::size_t k = 1; k < level.size(); ++k)
        if (time <= level[k].time) {
            const double share = (time - level[k - 1].time) / (level[k].time - level[k - 1].time);
            return level[k - 1].value + share * (level[k].value - level[k - 1].value);
        }
    return level.back().value;
}

}  // namespace talus
