// libFuzzer: any bytes as a snapshot file, and any bytes as one message of it. Checksums and compression would keep the
// fuzzer away from the messages, so what does not start like an MCAP file (0x89) is a message by itself: its first byte
// says which, the rest is its content. The reader's memory is bounded by the chunk size it accepts.

#include <cstddef>
#include <cstdint>

#include "snapshot/convert.h"
#include "talus/formats/export.h"
#include "talus/formats/snapshot.h"

using namespace talus;
using namespace talus::formats;

namespace {

constexpr std::uint8_t kFileStart = 0x89;

void readFile(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMostChunkBytes = std::uint64_t{16} << 20;
    auto reader = SnapshotReader::parse(data, size, "fuzz.mcap", kMostChunkBytes);
    if (!reader) return;
    reader->end();
    reader->verify();
}

/// As many blocks as a frame speaks of, and enough of the rest, so that it has a header to fit.
SnapshotHeader headerFor(std::size_t blocks) {
    constexpr std::size_t kJoints = 8, kWaters = 4;
    SnapshotHeader header;
    header.joints.resize(kJoints);
    header.waters.resize(kWaters);
    header.names.resize(blocks);
    header.motions.resize(blocks);
    return header;
}

void readMessage(std::uint8_t kind, const mcap::Bytes& content) {
    SnapshotHeader header;
    LightFrame light;
    FullFrame full;
    std::string why;
    if (kind == 'h' && decode(content, header, why)) fits(header);
    if (kind == 'l' && decode(content, light)) fits(light, headerFor(light.displacement.x.size()));
    if (kind == 'f' && decode(content, full) && fits(full, headerFor(full.blocks.position.x.size()))) {
        hashOf(full);
        vtpContacts(full);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    if (data[0] == kFileStart)
        readFile(data, size);
    else
        readMessage(data[0], {data + 1, data + size});
    return 0;
}
