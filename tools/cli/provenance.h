#pragma once
// Provenance of a result: version, build, threads, scenario and command line.

#include <string>

#include "cli/common.h"
#include "cli/json_fwd.h"

namespace talus::tools {

void rememberCommandLine(int argc, const char* const* argv);
void rememberCaller(const std::string& what);  ///< in place of a command line
const std::string& commandLine();

/// {version, git_hash, compiler, instruction_set, build_type, threads, scenario, command_line}; put it under
/// the key `provenance`. `scenario_path` may be empty (null then).
Json provenance(const Common& common, const std::string& scenario_path);

/// The same as comment lines "# key: value", for the head of CSV files.
std::string provenanceComments(const Common& common, const std::string& scenario_path);

}  // namespace talus::tools
