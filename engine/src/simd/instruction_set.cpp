#include "simd/instruction_set.h"

#include <array>
#include <cstdlib>
#include <string_view>

#include "talus/build_info.h"

namespace talus::simd {

bool isAvailable(InstructionSet set) {
#if defined(__x86_64__)
    switch (set) {
        case InstructionSet::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl");
        case InstructionSet::avx2:
            return __builtin_cpu_supports("avx2");
        case InstructionSet::scalar:
            break;
    }
#endif
    return set == InstructionSet::scalar;
}

InstructionSet bestInstructionSet() {
    const char* wanted = std::getenv(kInstructionSetVariable);
    for (const auto set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::scalar})
        if (isAvailable(set) && (wanted == nullptr || std::string_view(wanted) == toString(set))) return set;
    return InstructionSet::scalar;
}

const char* toString(InstructionSet set) {
    constexpr std::array<const char*, 3> kNames{"x86-64", "avx2", "avx512"};
    return kNames[static_cast<std::size_t>(set)];
}

}  // namespace talus::simd
