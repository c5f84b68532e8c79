#include "mcap/records.h"

namespace talus::mcap {
namespace {

/// Writes opcode and length around what `fill` appends.
template <class Fill>
void record(Bytes& out, Opcode opcode, const Fill& fill, std::uint64_t more = 0) {
    Encoder encoder(out);
    encoder.integer(static_cast<std::uint8_t>(opcode));
    const std::size_t length_at = out.size();
    encoder.integer(std::uint64_t{0});
    fill(encoder);
    const std::uint64_t length = out.size() - length_at - 8 + more;
    for (std::size_t k = 0; k < 8; ++k) out[length_at + k] = static_cast<std::uint8_t>(length >> (8 * k));
}

void counts(Encoder& e, const std::map<std::uint16_t, std::uint64_t>& values) {
    e.integer(static_cast<std::uint32_t>(10 * values.size()));
    for (const auto& [key, value] : values) e.integer(key), e.integer(value);
}

bool takeCounts(Decoder& d, std::map<std::uint16_t, std::uint64_t>& values) {
    Decoder list(d.raw(d.integer<std::uint32_t>()));
    while (list.ok() && !list.empty()) {
        const auto key = list.integer<std::uint16_t>();
        values[key] = list.integer<std::uint64_t>();
    }
    return d.ok() && list.ok();
}

}  // namespace

void encodeHeader(Bytes& out, const std::string& profile, const std::string& library) {
    record(out, Opcode::header, [&](Encoder& e) { e.text(profile), e.text(library); });
}

void encode(Bytes& out, const Schema& schema) {
    record(out, Opcode::schema, [&](Encoder& e) {
        e.integer(schema.id), e.text(schema.name), e.text(schema.encoding);
        e.integer(static_cast<std::uint32_t>(schema.data.size()));
        e.raw(schema.data);
    });
}

void encode(Bytes& out, const Channel& channel) {
    record(out, Opcode::channel, [&](Encoder& e) {
        e.integer(channel.id), e.integer(channel.schema), e.text(channel.topic),
            e.text(channel.message_encoding);
        e.integer(std::uint32_t{0});  // no metadata
    });
}

void encodeMessage(Bytes& out, std::uint16_t channel, std::uint32_t sequence, std::uint64_t time, View data) {
    record(out, Opcode::message, [&](Encoder& e) {
        e.integer(channel), e.integer(sequence), e.integer(time), e.integer(time), e.raw(data);
    });
}

void encodeChunkHead(Bytes& out, const ChunkIndex& chunk, std::uint32_t uncompressed_crc) {
    record(
        out, Opcode::chunk,
        [&](Encoder& e) {
            e.integer(chunk.start_time), e.integer(chunk.end_time), e.integer(chunk.uncompressed_size);
            e.integer(uncompressed_crc), e.text(chunk.compression), e.integer(chunk.compressed_size);
        },
        chunk.compressed_size);
}

void encodeMessageIndex(Bytes& out, std::uint16_t channel, const std::vector<IndexEntry>& entries) {
    record(out, Opcode::message_index, [&](Encoder& e) {
        e.integer(channel), e.integer(static_cast<std::uint32_t>(16 * entries.size()));
        for (const IndexEntry& entry : entries) e.integer(entry.time), e.integer(entry.offset);
    });
}

void encode(Bytes& out, const ChunkIndex& index) {
    record(out, Opcode::chunk_index, [&](Encoder& e) {
        e.integer(index.start_time), e.integer(index.end_time), e.integer(index.offset),
            e.integer(index.length);
        counts(e, index.message_index_offsets);
        e.integer(index.message_index_length), e.text(index.compression);
        e.integer(index.compressed_size), e.integer(index.uncompressed_size);
    });
}

void encode(Bytes& out, const Statistics& s, std::size_t schemas, std::size_t channels, std::size_t chunks) {
    record(out, Opcode::statistics, [&](Encoder& e) {
        e.integer(s.messages), e.integer(static_cast<std::uint16_t>(schemas));
        e.integer(static_cast<std::uint32_t>(channels)), e.integer(std::uint32_t{0});  // no attachments
        e.integer(s.metadata), e.integer(static_cast<std::uint32_t>(chunks));
        e.integer(s.start_time), e.integer(s.end_time);
        counts(e, s.channel_messages);
    });
}

void encodeMetadata(Bytes& out, const std::string& name, const Metadata& values) {
    record(out, Opcode::metadata, [&](Encoder& e) {
        Bytes list;
        Encoder pairs(list);
        for (const auto& [key, value] : values) pairs.text(key), pairs.text(value);
        e.text(name), e.integer(static_cast<std::uint32_t>(list.size())), e.raw(list);
    });
}

void encode(Bytes& out, const MetadataIndex& index) {
    record(out, Opcode::metadata_index,
           [&](Encoder& e) { e.integer(index.offset), e.integer(index.length), e.text(index.name); });
}

void encodeSummaryOffset(Bytes& out, Opcode group, std::uint64_t start, std::uint64_t length) {
    record(out, Opcode::summary_offset, [&](Encoder& e) {
        e.integer(static_cast<std::uint8_t>(group)), e.integer(start), e.integer(length);
    });
}

void encodeDataEnd(Bytes& out, std::uint32_t data_crc) {
    record(out, Opcode::data_end, [&](Encoder& e) { e.integer(data_crc); });
}

void encodeFooterHead(Bytes& out, std::uint64_t summary_start, std::uint64_t summary_offset_start) {
    record(
        out, Opcode::footer, [&](Encoder& e) { e.integer(summary_start), e.integer(summary_offset_start); },
        sizeof(std::uint32_t));
}

bool decode(View content, Schema& schema) {
    Decoder d(content);
    schema.id = d.integer<std::uint16_t>();
    schema.name = d.text(), schema.encoding = d.text();
    const View data = d.raw(d.integer<std::uint32_t>());
    schema.data.assign(data.data, data.data + data.size);
    return d.ok();
}

bool decode(View content, Channel& channel) {
    Decoder d(content);
    channel.id = d.integer<std::uint16_t>();
    channel.schema = d.integer<std::uint16_t>();
    channel.topic = d.text(), channel.message_encoding = d.text();
    return d.ok();
}

bool decode(View content, ChunkIndex& index) {
    Decoder d(content);
    index.start_time = d.integer<std::uint64_t>();
    index.end_time = d.integer<std::uint64_t>();
    index.offset = d.integer<std::uint64_t>();
    index.length = d.integer<std::uint64_t>();
    const bool listed = takeCounts(d, index.message_index_offsets);
    index.message_index_length = d.integer<std::uint64_t>();
    index.compression = d.text();
    index.compressed_size = d.integer<std::uint64_t>();
    index.uncompressed_size = d.integer<std::uint64_t>();
    return listed && d.ok();
}

bool decode(View content, MetadataIndex& index) {
    Decoder d(content);
    index.offset = d.integer<std::uint64_t>();
    index.length = d.integer<std::uint64_t>();
    index.name = d.text();
    return d.ok();
}

bool decodeMetadata(View content, std::string& name, Metadata& values) {
    Decoder d(content);
    name = d.text();
    Decoder list(d.raw(d.integer<std::uint32_t>()));
    while (list.ok() && !list.empty()) {
        std::string key = list.text();
        values[std::move(key)] = list.text();
    }
    return d.ok() && list.ok();
}

bool decodeMessageIndex(View content, std::uint16_t& channel, std::vector<IndexEntry>& entries) {
    Decoder d(content);
    channel = d.integer<std::uint16_t>();
    Decoder list(d.raw(d.integer<std::uint32_t>()));
    while (list.ok() && !list.empty()) {
        const auto time = list.integer<std::uint64_t>();
        entries.push_back({time, list.integer<std::uint64_t>()});
    }
    return d.ok() && list.ok();
}

bool decodeChunkHead(View content, ChunkIndex& index, std::uint32_t& crc, std::size_t& head_size) {
    Decoder d(content);
    index.start_time = d.integer<std::uint64_t>();
    index.end_time = d.integer<std::uint64_t>();
    index.uncompressed_size = d.integer<std::uint64_t>();
    crc = d.integer<std::uint32_t>();
    index.compression = d.text();
    index.compressed_size = d.integer<std::uint64_t>();
    head_size = d.at();
    return d.ok();
}

bool decode(View content, Message& message) {
    Decoder d(content);
    message.channel = d.integer<std::uint16_t>();
    message.sequence = d.integer<std::uint32_t>();
    message.time = d.integer<std::uint64_t>();
    d.integer<std::uint64_t>();  // time of publishing
    message.data = d.raw(d.left());
    return d.ok();
}

}  // namespace talus::mcap
