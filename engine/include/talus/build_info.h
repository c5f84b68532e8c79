#pragma once
// Which build this is: results are the same bits for the same binary, instruction set and input.

#include <string>

namespace talus {

struct BuildInfo {
    std::string version;   ///< "0.1.0"
    std::string git_hash;  ///< 12 digits, "-dirty" behind them with uncommitted changes; else "unknown"
    std::string compiler;  ///< "g++ 12.2.0"
    std::string instruction_set;  ///< that the kernels use on this processor: "avx512", "avx2" or "x86-64"
    std::string build_type;       ///< "Release"
};

const BuildInfo& buildInfo();

/// Environment variable that names the kernels' instruction set, for tests and to repeat another machine's
/// results. An instruction set that this processor lacks falls back to "x86-64".
inline constexpr const char* kInstructionSetVariable = "TALUS_INSTRUCTION_SET";

}  // namespace talus
