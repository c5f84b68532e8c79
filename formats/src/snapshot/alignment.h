#pragma once
// A check missing in the verifier of FlatBuffers 2.0. It aligns a vector's length to four bytes, but not the
// elements to their own size, and compilers assume aligned doubles.

#include "mcap/bytes.h"

namespace talus::formats {

/// Whether the elements of all vectors lie at multiples of their size. \pre the verifier has passed the
/// message
bool vectorsAreAligned(const mcap::Bytes& message, const char* type_name);

}  // namespace talus::formats
