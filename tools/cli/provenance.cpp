// Provenance of a result: version, build, threads, scenario and command line.

#include <thread>

#include "cli/json.h"
#include "cli/provenance.h"
#include "talus/build_info.h"

namespace talus::tools {

namespace {

std::string remembered_command_line;

/// Quoted as a shell would need it, so that the line can be run again.
std::string shellWord(const std::string& word) {
    const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

void rememberCommandLine(int argc, const char* const* argv) {
    remembered_command_line = "talus";
    for (int i = 1; i < argc; ++i) remembered_command_line += " " + shellWord(argv[i]);
}

void rememberCaller(const std::string& what) { remembered_command_line = what; }

const std::string& commandLine() { return remembered_command_line; }

int threadsUsed(const Common& common) {
    return common.threads > 0 ? common.threads
                              : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Json provenance(const Common& common, const std::string& scenario_path) {
    const BuildInfo& build = buildInfo();
    return {{"version", build.version},
            {"git_hash", build.git_hash},
            {"compiler", build.compiler},
            {"instruction_set", build.instruction_set},
            {"build_type", build.build_type},
            {"threads", threadsUsed(common)},
            {"scenario", scenario_path.empty() ? Json(nullptr) : Json(scenario_path)},
            {"command_line", commandLine()}};
}

std::string provenanceComments(const Common& common, const std::string& scenario_path) {
    const Json facts = provenance(common, scenario_path);
    std::string lines;
    for (const auto& [key, value] : facts.items()) {
        if (value.is_null()) continue;
        std::string line = value.is_string() ? value.get<std::string>() : jsonText(value);
        for (char& c : line)
            if (c == '\n' || c == '\r') c = ' ';  // a line break in an argument must not end the comment
        lines += "# " + key + ": " + line + "\n";
    }
    return lines;
}

}  // namespace talus::tools
