#include "cli/scenario.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/json.h"
#include "cli/progress.h"
#include "talus/formats/changes.h"

namespace talus::tools {

namespace {

/// The first equals sign that is not inside a quoted key.
std::size_t equalsSign(const std::string& set) {
    bool quoted = false;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (set[i] == '"') quoted = !quoted;
        if (set[i] == '=' && !quoted) return i;
    }
    return std::string::npos;
}

formats::FieldChange changeOf(const std::string& set) {
    const std::size_t equals = equalsSign(set);
    if (equals == std::string::npos || equals == 0 || equals + 1 == set.size())
        throw BadInput(
            Error{formats::kChangedBy,
                  "found \"" + set + "\", allowed: FIELD=VALUE, such as joint.default.friction_deg=30"});
    return {set.substr(0, equals), set.substr(equals + 1)};
}

}  // namespace

EndsAtOnce whileReading(const std::string& name, const Common& common) {
    return endsWhile(name + " was read", common);
}

EndsAtOnce endsWhile(const std::string& doing, const Common& common) {
    const Error interrupted{"", "interrupted while " + doing};
    return EndsAtOnce(
        common.json ? jsonText(errorsJson({interrupted}), 2) + "\n" : "",
        // over the progress, if there is any
        (isatty(STDERR_FILENO) != 0 ? "\r\x1b[2Kerror: " : "error: ") + interrupted.message + "\n");
}

formats::Scenario loadScenario(const ScenarioInput& input, const Common& common) {
    std::vector<formats::FieldChange> changes;
    for (const std::string& set : input.sets) changes.push_back(changeOf(set));
    const EndsAtOnce reading = whileReading(input.name(), common);
    ProgressPrinter progress(common);
    formats::Scenario scenario =
        valueOf(formats::readScenario(input.path, changes, nullptr, progress.callback()));
    progress.finish();
    return scenario;
}

void requireFreeBlock(const formats::Scenario& scenario) {
    if (auto none = formats::noFreeBlock(scenario))
        throw BadInput(formats::placed(scenario, {std::move(*none)}));
}

std::vector<std::string> warningsOf(const formats::Scenario& scenario,
                                    const std::vector<std::string>& result) {
    std::vector<std::string> all;
    for (const auto* list : {&scenario.warnings, &result})
        for (const std::string& warning : *list)
            if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
    return all;
}

void refuse(const formats::Scenario& scenario, const std::vector<Error>& errors) {
    std::fputs(warningLines(scenario).c_str(), stderr);
    throw BadInput(formats::placed(scenario, errors));
}

std::string warningLines(const formats::Scenario& scenario, const std::vector<std::string>& result) {
    std::string lines;
    for (const std::string& warning : warningsOf(scenario, result)) lines += "warning: " + warning + "\n";
    return lines;
}

Json warningsJson(const formats::Scenario& scenario, const std::vector<std::string>& result) {
    return warningsOf(scenario, result);
}

}  // namespace talus::tools
