#pragma once
// Records of the MCAP container as its published specification (version 0 of the format) lays them out:
// opcode (1 byte), length (8 bytes), content; all integers little-endian.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mcap/bytes.h"

namespace talus::mcap {

inline constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kRecordHead = 9;  ///< opcode and length
inline constexpr std::size_t kFooterSize = kRecordHead + 8 + 8 + 4;

enum class Opcode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    statistics = 0x0B,
    metadata = 0x0C,
    metadata_index = 0x0D,
    summary_offset = 0x0E,
    data_end = 0x0F
};

struct Schema {
    std::uint16_t id = 0;  ///< not 0
    std::string name, encoding;
    Bytes data;
};

struct Channel {
    std::uint16_t id = 0, schema = 0;
    std::string topic, message_encoding;
};

/// Where a message lies in its chunk.
struct IndexEntry {
    std::uint64_t time = 0;    ///< [ns]
    std::uint64_t offset = 0;  ///< of the message record in the uncompressed chunk
};

struct ChunkIndex {
    std::uint64_t start_time = 0, end_time = 0;  ///< of its messages [ns]
    std::uint64_t offset = 0, length = 0;        ///< of the chunk record in the file
    std::map<std::uint16_t, std::uint64_t> message_index_offsets;
    std::uint64_t message_index_length = 0;
    std::string compression;
    std::uint64_t compressed_size = 0, uncompressed_size = 0;
};

struct MetadataIndex {
    std::uint64_t offset = 0, length = 0;
    std::string name;
};

struct Statistics {
    std::uint64_t messages = 0;
    std::uint32_t metadata = 0;
    std::uint64_t start_time = 0, end_time = 0;
    std::map<std::uint16_t, std::uint64_t> channel_messages;
};

using Metadata = std::map<std::string, std::string>;

// Each appends a whole record.
void encodeHeader(Bytes& out, const std::string& profile, const std::string& library);
void encode(Bytes& out, const Schema& schema);
void encode(Bytes& out, const Channel& channel);
void encodeMessage(Bytes& out, std::uint16_t channel, std::uint32_t sequence, std::uint64_t time, View data);
void encodeChunkHead(Bytes& out, const ChunkIndex& chunk, std::uint32_t uncompressed_crc);
void encodeMessageIndex(Bytes& out, std::uint16_t channel, const std::vector<IndexEntry>& entries);
void encode(Bytes& out, const ChunkIndex& index);
void encode(Bytes& out, const Statistics& statistics, std::size_t schemas, std::size_t channels,
            std::size_t chunks);
void encodeMetadata(Bytes& out, const std::string& name, const Metadata& values);
void encode(Bytes& out, const MetadataIndex& index);
void encodeSummaryOffset(Bytes& out, Opcode group, std::uint64_t start, std::uint64_t length);
void encodeDataEnd(Bytes& out, std::uint32_t data_crc);
/// The footer without its last field, the checksum of the summary up to there.
void encodeFooterHead(Bytes& out, std::uint64_t summary_start, std::uint64_t summary_offset_start);

// Each takes a record's content; false when it is cut or wrong.
bool decode(View content, Schema& schema);
bool decode(View content, Channel& channel);
bool decode(View content, ChunkIndex& index);
bool decode(View content, MetadataIndex& index);
bool decodeMetadata(View content, std::string& name, Metadata& values);
bool decodeMessageIndex(View content, std::uint16_t& channel, std::vector<IndexEntry>& entries);

/// A chunk's fields before its records; `head_size` is their length and `index` is filled but for its place
/// in the file.
bool decodeChunkHead(View content, ChunkIndex& index, std::uint32_t& crc, std::size_t& head_size);

struct Message {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t time = 0;
    View data;
};
bool decode(View content, Message& message);

}  // namespace talus::mcap
