#pragma once
// Choice of the kernels' build, once per simulation, so that one binary runs on any x86-64.

#include <cstdint>

namespace talus::simd {

enum class InstructionSet : std::uint8_t {
    scalar,  ///< one interface at a time, for any processor
    avx2,    ///< four at a time
    avx512   ///< eight at a time
};

/// The fastest one this processor has, or the one that kInstructionSetVariable (talus/build_info.h) names.
InstructionSet bestInstructionSet();

/// Whether this processor has it.
bool isAvailable(InstructionSet set);

/// Of three builds, the one for this instruction set.
template <class Build>
const Build& buildFor(InstructionSet set, const Build& scalar, const Build& avx2, const Build& avx512) {
    switch (set) {
        case InstructionSet::avx512:
            return avx512;
        case InstructionSet::avx2:
            return avx2;
        case InstructionSet::scalar:
            break;
    }
    return scalar;
}

/// "x86-64", "avx2", "avx512".
const char* toString(InstructionSet set);

}  // namespace talus::simd
