#include "mcap/writer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "mcap/compression.h"
#include "talus/formats/output_file.h"

namespace talus::mcap {
namespace {

int writeAll(int file, View bytes) {
    while (bytes.size > 0) {
        const ssize_t done = ::write(file, bytes.data, bytes.size);
        if (done >= 0) {
            bytes = bytes.from(static_cast<std::size_t>(done));
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

}  // namespace

Writer::~Writer() {
    if (file_ >= 0) ::close(file_);
}

int Writer::append(View bytes) {
    if (refused_ != 0) return refused_;
    // Devices and pipes cannot be truncated or sought; that is no error of writing.
    if (!std::exchange(cut_, true)) {
        if (::ftruncate(file_, static_cast<off_t>(written_.size)) == 0) formats::appendFromNowOn(file_);
    } else if (!formats::isAsLong(file_, written_.size)) {
        return refused_ = ENOENT;
    }
    refused_ = writeAll(file_, bytes);
    if (refused_ != 0) {
        [[maybe_unused]] const int ignored = ::ftruncate(file_, static_cast<off_t>(written_.size));
        return refused_;
    }
    written_.size += bytes.size;
    written_.data_crc = crc32(written_.data_crc, bytes);
    return 0;
}

int Writer::start(const std::string& profile, const std::string& library) {
    Bytes out(kMagic.begin(), kMagic.end());
    encodeHeader(out, profile, library);
    return append(out);
}

int Writer::addSchema(const Schema& schema) {
    Bytes out;
    encode(out, schema);
    written_.schemas.push_back(schema);
    return append(out);
}

int Writer::addChannel(const Channel& channel) {
    Bytes out;
    encode(out, channel);
    written_.channels.push_back(channel);
    return append(out);
}

void Writer::add(std::uint16_t channel, std::uint64_t time, View data) {
    if (chunk_.empty()) chunk_index_.start_time = chunk_index_.end_time = time;
    chunk_index_.start_time = std::min(chunk_index_.start_time, time);
    chunk_index_.end_time = std::max(chunk_index_.end_time, time);
    entries_[channel].push_back({time, chunk_.size()});
    encodeMessage(chunk_, channel, written_.sequence[channel]++, time, data);

    Statistics& s = written_.statistics;
    s.start_time = s.messages == 0 ? time : std::min(s.start_time, time);
    s.end_time = std::max(s.end_time, time);
    ++s.messages;
    ++s.channel_messages[channel];
}

int Writer::flush() {
    if (chunk_.empty()) return refused_;
    Bytes records = compress(chunk_);
    ChunkIndex& index = chunk_index_;
    index.compression = records.empty() ? "" : "zstd";
    if (records.empty()) records = chunk_;
    index.offset = written_.size;
    index.compressed_size = records.size();
    index.uncompressed_size = chunk_.size();

    // One write for the chunk and its index, so that a process that is killed leaves both or neither.
    Bytes out;
    encodeChunkHead(out, index, crc32(0, chunk_));
    Encoder(out).raw(records);
    index.length = out.size();
    for (const auto& [channel, entries] : entries_) {
        index.message_index_offsets[channel] = written_.size + out.size();
        encodeMessageIndex(out, channel, entries);
    }
    index.message_index_length = out.size() - index.length;
    written_.chunks.push_back(std::exchange(chunk_index_, {}));
    chunk_.clear();
    entries_.clear();
    return append(out);
}

int Writer::addMetadata(const std::string& name, const Metadata& values) {
    if (const int refused = flush(); refused != 0) return refused;
    Bytes out;
    encodeMetadata(out, name, values);
    metadata_.push_back({written_.size, out.size(), name});
    return append(out);
}

void Writer::addToSummary(Bytes& out, std::uint64_t start) const {
    struct Group {
        Opcode opcode;
        std::size_t begin, end;
    };
    std::vector<Group> groups;
    const auto group = [&](Opcode opcode, const auto& fill) {
        const std::size_t begin = out.size();
        fill();
        if (out.size() > begin) groups.push_back({opcode, begin, out.size()});
    };
    const auto each = [&](const auto& items) {
        return [&] {
            for (const auto& item : items) encode(out, item);
        };
    };
    Statistics statistics = written_.statistics;
    statistics.metadata = static_cast<std::uint32_t>(metadata_.size());
    group(Opcode::schema, each(written_.schemas));
    group(Opcode::channel, each(written_.channels));
    group(Opcode::statistics, [&] {
        encode(out, statistics, written_.schemas.size(), written_.channels.size(), written_.chunks.size());
    });
    group(Opcode::chunk_index, each(written_.chunks));
    group(Opcode::metadata_index, each(metadata_));
    const std::uint64_t offsets = start + out.size();
    for (const Group& g : groups) encodeSummaryOffset(out, g.opcode, start + g.begin, g.end - g.begin);
    encodeFooterHead(out, start, offsets);
}

int Writer::finish() {
    if (const int refused = flush(); refused != 0) return refused;
    Bytes out;
    encodeDataEnd(out, written_.data_crc);
    Bytes summary;
    addToSummary(summary, written_.size + out.size());
    Encoder encoder(summary);
    encoder.integer(crc32(0, summary));
    encoder.raw({kMagic.data(), kMagic.size()});
    Encoder(out).raw(summary);
    const int refused = append(out);
    if (::close(std::exchange(file_, -1)) != 0 && refused == 0) return errno;
    return refused;
}

}  // namespace talus::mcap
