#pragma once
// Hostile snapshot files: bytes are changed and every checksum is right.

#include <algorithm>

#include "mcap/compression.h"
#include "mcap/records.h"

namespace talus::test {

/// Calls `visit(offset, opcode, content)` for each whole record of an MCAP file.
template <class Visit>
void eachRecord(mcap::View file, const Visit& visit) {
    std::size_t at = mcap::kMagic.size();
    while (file.size >= at + mcap::kRecordHead) {
        mcap::Decoder head(file.from(at));
        const auto opcode = static_cast<mcap::Opcode>(head.integer<std::uint8_t>());
        const mcap::View content = head.raw(head.integer<std::uint64_t>());
        if (!head.ok()) return;
        visit(at, opcode, content);
        at += mcap::kRecordHead + content.size;
    }
}

/// What a chunk holds; false when that cannot be known.
inline bool unpack(mcap::View content, mcap::ChunkIndex& index, mcap::Bytes& records) {
    constexpr std::uint64_t kMost = std::uint64_t{16} << 20;
    std::uint32_t crc = 0;
    std::size_t head = 0;
    return mcap::decodeChunkHead(content, index, crc, head) && index.uncompressed_size <= kMost &&
           mcap::decompress(index.compression, content.from(head), index.uncompressed_size, records);
}

/// Makes the checksums right of all chunks, of the data section and of the summary.
inline void seal(mcap::Bytes& file) {
    using mcap::Opcode;
    const auto put = [&](std::size_t at, std::uint32_t crc) {
        for (std::size_t k = 0; k < 4; ++k) file[at + k] = static_cast<std::uint8_t>(crc >> (8 * k));
    };
    eachRecord(file, [&](std::size_t at, Opcode opcode, mcap::View content) {
        const std::size_t begin = at + mcap::kRecordHead;
        constexpr std::size_t kTimesAndSize = 24, kStarts = 16;  // what stands before the checksums
        mcap::ChunkIndex index;
        mcap::Bytes records;
        if (opcode == Opcode::chunk && unpack(content, index, records))
            put(begin + kTimesAndSize, mcap::crc32(0, records));
        if (opcode == Opcode::data_end && content.size == 4) put(begin, mcap::crc32(0, {file.data(), at}));
        if (opcode != Opcode::footer || content.size != kStarts + 4) return;
        const auto start = mcap::Decoder(content).integer<std::uint64_t>();
        if (start > 0 && start < begin)
            put(begin + kStarts, mcap::crc32(0, {file.data() + start, begin + kStarts - start}));
    });
}

/// The same data with each chunk stored as it unpacks, and without index and end, as after a kill: any byte
/// can be changed.
inline mcap::Bytes unpacked(const mcap::Bytes& file) {
    using mcap::Opcode;
    mcap::Bytes out(mcap::kMagic.begin(), mcap::kMagic.end());
    eachRecord(file, [&](std::size_t at, Opcode opcode, mcap::View content) {
        mcap::ChunkIndex index;
        mcap::Bytes records;
        if (opcode == Opcode::header || opcode == Opcode::schema || opcode == Opcode::channel)
            mcap::Encoder(out).raw({file.data() + at, mcap::kRecordHead + content.size});
        if (opcode != Opcode::chunk || !unpack(content, index, records)) return;
        index.compression.clear();
        index.compressed_size = index.uncompressed_size;
        mcap::encodeChunkHead(out, index, mcap::crc32(0, records));
        mcap::Encoder(out).raw(records);
    });
    return out;
}

}  // namespace talus::test
