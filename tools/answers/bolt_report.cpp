#include "answers/bolt_report.h"

#include <cmath>
#include <cstdio>

#include "cli/json.h"

namespace talus::tools {

Json boltsJson(const std::vector<BoltReport>& bolts) {
    Json list = Json::array();
    for (const BoltReport& bolt : bolts)
        list.push_back({{"name", bolt.name},
                        {"force_n", number(bolt.force)},
                        {"utilisation", number(bolt.utilisation)},
                        {"yielded", bolt.yielded},
                        {"slipped", bolt.slipped},
                        {"broken", bolt.broken}});
    return list;
}

std::vector<std::string> boltLines(const std::vector<BoltReport>& bolts) {
    std::vector<std::string> lines;
    for (const BoltReport& bolt : bolts) {
        char text[96];
        std::snprintf(text, sizeof text, ": %.4g kN, %.0f %% of what it can carry", bolt.force / 1000,
                      std::round(100 * bolt.utilisation));
        lines.push_back(bolt.name + text + (bolt.yielded ? ", yielded" : "") +
                        (bolt.slipped ? ", slipped in its grout" : "") + (bolt.broken ? ", broken" : ""));
    }
    return lines;
}

}  // namespace talus::tools
