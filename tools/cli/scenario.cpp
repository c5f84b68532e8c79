#include "cli/scenario.h"

namespace talus::tools {

formats::Scenario loadScenario(const std::string& path) { return valueOf(formats::readScenario(path)); }

formats::Scenario loadScenario(const std::string& path, const Common& common) {
    formats::Scenario scenario = loadScenario(path);
    for (const std::string& warning : scenario.warnings) note(common, "warning: " + path + ": " + warning);
    return scenario;
}

}  // namespace talus::tools
