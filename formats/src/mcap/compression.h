#pragma once
// Checksums and compression of MCAP chunks.

#include "mcap/bytes.h"

namespace talus::mcap {

/// CRC-32 (IEEE 802.3), going on from `crc`, which starts at 0.
std::uint32_t crc32(std::uint32_t crc, View bytes);

/// zstd frame; empty when there is no memory for it.
Bytes compress(View bytes);

/// Takes "zstd", "" (stored) ... of exactly `size` bytes; false when damaged, of another size or unknown
/// compression, or when it claims an impossible ratio. Never allocates more than the data hold.
bool decompress(const std::string& compression, View bytes, std::uint64_t size, Bytes& out);

}  // namespace talus::mcap
