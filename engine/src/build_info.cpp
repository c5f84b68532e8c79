#include "talus/build_info.h"

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

const char* instructionSet() {
#if defined(__x86_64__)
    const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return TALUS_AVX2_KERNELS && has_avx2 ? "avx2" : "x86-64";
#else
    return "portable";
#endif
}

}  // namespace

const BuildInfo& buildInfo() {
    static const BuildInfo info{TALUS_VERSION, kGitHash, compiler(), instructionSet(), TALUS_BUILD_TYPE};
    return info;
}

}  // namespace talus
