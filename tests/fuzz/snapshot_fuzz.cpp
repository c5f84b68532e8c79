// libFuzzer: any bytes as a message of a snapshot file. The first byte says which (header, light frame, full
// frame), the rest is its content. The container around them has a fuzzer of its own.

#include <cstddef>
#include <cstdint>

#include "snapshot/convert.h"
#include "talus/formats/export.h"
#include "talus/formats/snapshot.h"

using namespace talus;
using namespace talus::formats;

namespace {

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
    readMessage(data[0], {data + 1, data + size});
    return 0;
}
