#include "scenario/mending.h"

namespace talus::formats::scenario {

void readMending(TableReader& table, MeshOptions& options) {
    options.mend = table.boolean("repair").value_or(false);
    options.largest_hole = table.number("largest_hole", kLength);
    if (table.has("largest_hole") && !options.mend) {
        table.error("largest_hole",
                    "found largest_hole without repair, allowed: only together with repair = true");
    }
}

}  // namespace talus::formats::scenario
