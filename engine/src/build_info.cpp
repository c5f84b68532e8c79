#include "talus/build_info.h"

#include "simd/instruction_set.h"

namespace talus {

extern const char kGitHash[];  // generated in every build, see engine/CMakeLists.txt

namespace {

const char* compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

const char* instructionSet() { return simd::toString(simd::bestInstructionSet()); }

}  // namespace

const BuildInfo& buildInfo() {
    static const BuildInfo info{TALUS_VERSION, kGitHash, compiler(), instructionSet(), TALUS_BUILD_TYPE};
    return info;
}

}  // namespace talus
