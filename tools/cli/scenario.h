#pragma once
// Scenario files as commands read them.

#include <string>
#include <utility>
#include <vector>

#include "cli/common.h"
#include "cli/failures.h"
#include "cli/json_fwd.h"
#include "cli/signals.h"
#include "talus/formats/scenario.h"

namespace talus::tools {

/// The scenario of a command line (addScenario in cli/command.h).
struct ScenarioInput {
    std::string path;                 ///< "-": the standard input
    std::vector<std::string> sets{};  ///< of --set: "FIELD=VALUE"

    std::string name() const { return path == "-" ? "stdin" : path; }  ///< in messages and results
};

/// Throws BadInput. Warnings of the scenario, which often name the cause, go to stderr before.
[[noreturn]] void refuse(const formats::Scenario& scenario, const std::vector<Error>& errors);

/// The value of a result of the engine, whose errors know fields but not the places in the scenario file; or
/// BadInput.
template <class T>
T valueOf(Result<T> result, const formats::Scenario& scenario) {
    if (!result.ok()) refuse(scenario, result.errors());
    return std::move(*result);
}

/// Reads a command's input; an interruption leaves nothing. \param name of the file, in messages
EndsAtOnce whileReading(const std::string& name, const Common& common);

/// The same of something else that leaves nothing: "interrupted while " `doing`.
EndsAtOnce endsWhile(const std::string& doing, const Common& common);

/// Reads a scenario; throws BadInput. Its warnings belong to the answer (warningsOf).
formats::Scenario loadScenario(const ScenarioInput& input, const Common& common);

/// Throws BadInput where no block is free to move: a search has no answer then.
void requireFreeBlock(const formats::Scenario& scenario);

/// Warnings of an answer, each once: those of the scenario, then those of the result.
std::vector<std::string> warningsOf(const formats::Scenario& scenario,
                                    const std::vector<std::string>& result = {});
/// The same as lines: "warning: ...".
std::string warningLines(const formats::Scenario& scenario, const std::vector<std::string>& result = {});
Json warningsJson(const formats::Scenario& scenario, const std::vector<std::string>& result = {});

}  // namespace talus::tools
