#pragma once
// What the verifier of FlatBuffers 2.0 leaves open: it holds the length of a vector to four bytes, but not
// the elements behind it to their own size, and compilers take doubles to be where doubles may be.

#include "mcap/bytes.h"

namespace talus::formats {

/// Whether the elements of all vectors lie at multiples of their size. \pre the verifier has passed the
/// message
bool vectorsAreAligned(const mcap::Bytes& message, const char* type_name);

}  // namespace talus::formats
