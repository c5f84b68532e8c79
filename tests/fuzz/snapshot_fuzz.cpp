// libFuzzer: any bytes as a snapshot file. The reader's memory is bounded by the chunk size it accepts.

#include <cstddef>
#include <cstdint>

#include "talus/formats/snapshot.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMostChunkBytes = std::uint64_t{16} << 20;
    auto reader = talus::formats::SnapshotReader::parse(data, size, "fuzz.mcap", kMostChunkBytes);
    if (!reader) return 0;
    reader->end();
    reader->verify();
    return 0;
}
