#include "simd/instruction_set.h"

namespace talus::simd {

InstructionSet bestInstructionSet() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") ? InstructionSet::avx2 : InstructionSet::scalar;
#else
    return InstructionSet::scalar;
#endif
}

}  // namespace talus::simd
