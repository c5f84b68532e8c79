#pragma once
// Scenario files as commands read them.

#include <string>
#include <utility>

#include "cli/common.h"
#include "cli/failures.h"
#include "talus/formats/scenario.h"

namespace talus::tools {

/// The value of a result of the engine, whose errors know fields but not the places in the scenario file; or BadInput.
template <class T>
T valueOf(Result<T> result, const formats::Scenario& scenario) {
    if (!result.ok()) throw BadInput(formats::placed(scenario, result.errors()));
    return std::move(*result);
}

/// Reads a scenario file; throws BadInput. The second tells its warnings on stderr, too.
formats::Scenario loadScenario(const std::string& path);
formats::Scenario loadScenario(const std::string& path, const Common& common);

}  // namespace talus::tools
