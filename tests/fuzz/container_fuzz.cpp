// libFuzzer: any bytes as an MCAP file, as they are and with right checksums, which would keep the fuzzer
// from whatever stands behind them. The reader's memory is bounded by the chunk size it accepts.

#include "mcap/reader.h"
#include "support/containers.h"
#include "talus/formats/snapshot.h"

using namespace talus;

namespace {

constexpr std::uint64_t kMostChunkBytes = std::uint64_t{16} << 20;
constexpr std::size_t kMostMessages = 200;

void readContainer(const mcap::Bytes& bytes) {
    auto reader = mcap::Reader::open(mcap::Source::of(bytes), "fuzz.mcap", kMostChunkBytes);
    if (!reader) return;
    const auto& places = reader->places();
    for (std::size_t k = 0; k < std::min(places.size(), kMostMessages); ++k) reader->message(places[k]);
    reader->verify();
    for (std::size_t chunks = 1; chunks <= reader->chunks().size(); chunks *= 2) reader->prefix(chunks);
}

void readSnapshots(const mcap::Bytes& bytes) {
    auto reader = formats::SnapshotReader::parse(bytes.data(), bytes.size(), "fuzz.mcap", kMostChunkBytes);
    if (!reader) return;
    reader->end();
    reader->verify();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const mcap::Bytes bytes(data, data + size);
    mcap::Bytes sealed = bytes;
    test::seal(sealed);
    readContainer(bytes);
    if (sealed != bytes) readContainer(sealed);
    readSnapshots(sealed);
    return 0;
}
