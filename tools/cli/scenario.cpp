#include "cli/scenario.h"

#include "cli/signals.h"

namespace talus::tools {

formats::Scenario loadScenario(const std::string& path) {
    auto scenario = formats::readScenario(path, &stopRequested());
    if (!scenario && stopRequested()) throw Interrupted("interrupted while " + path + " was read");
    return valueOf(std::move(scenario));
}

formats::Scenario loadScenario(const std::string& path, const Common& common) {
    formats::Scenario scenario = loadScenario(path);
    for (const std::string& warning : scenario.warnings) note(common, "warning: " + path + ": " + warning);
    return scenario;
}

}  // namespace talus::tools
