#pragma once
// Reads an MCAP file by its index; a file without a sound index (cut, still being written) chunk by chunk
// from the start. Nothing is trusted: every length is checked against the file.

#include <functional>
#include <optional>
#include <string>

#include "mcap/records.h"
#include "mcap/writer.h"
#include "talus/result.h"

namespace talus::mcap {

/// A file, or bytes in memory.
class Source {
 public:
    static Result<Source> open(const std::string& path);
    static Source of(View bytes);  ///< which must outlive the source
    Source(Source&& other) noexcept;
    Source& operator=(Source&&) = delete;
    ~Source();

    std::uint64_t size() const { return size_; }
    /// Exactly these bytes; false when they are not there.
    bool read(std::uint64_t offset, std::uint64_t size, Bytes& out) const;

 private:
    Source() = default;
    int file_ = -1;
    View memory_;
    std::uint64_t size_ = 0;
};

/// A message and where it is.
struct MessagePlace {
    std::uint16_t channel = 0;
    std::uint64_t time = 0;    ///< [ns]
    std::size_t chunk = 0;     ///< index into chunks()
    std::uint64_t offset = 0;  ///< in the uncompressed chunk
};

class Reader {
 public:
    /// Errors: a file that is not MCAP, or of which not even the head is there.
    static Result<Reader> open(Source source, const std::string& path, std::uint64_t most_chunk_bytes);

    const std::vector<Schema>& schemas() const { return schemas_; }
    const std::vector<Channel>& channels() const { return channels_; }
    const std::vector<ChunkIndex>& chunks() const { return chunks_; }
    const std::vector<MessagePlace>& places() const { return places_; }  ///< in the file's order
    const std::map<std::string, Metadata>& metadata() const { return metadata_; }

    bool finished() const { return finished_; }  ///< with a sound end and summary
    std::uint64_t size() const { return source_.size(); }
    /// Faults of the file, in words; empty when it is sound.
    const std::vector<std::string>& faults() const { return faults_; }

    /// The bytes of a message, in a buffer of their own (aligned for FlatBuffers). Keeps the last chunk.
    /// Errors: a chunk whose checksum does not hold.
    Result<Bytes> message(const MessagePlace& place);

    /// Reads every chunk and verifies all checksums, that of the whole data section included; faults as text.
    std::vector<std::string> verify();

    /// What a writer needs to continue after the first `chunks` chunks.
    Result<Written> prefix(std::size_t chunks);

 private:
    Reader(Source source, std::string path, std::uint64_t most)
        : source_(std::move(source)), path_(std::move(path)), most_chunk_bytes_(most) {}
    bool readSummary();
    bool readMessageIndex(std::size_t chunk);
    void scan();
    bool scanRecord(Opcode opcode, View content, std::uint64_t offset);
    void scanChunk(View content, std::uint64_t offset);
    bool unpack(View content, const ChunkIndex& index, std::uint32_t crc, std::size_t head, Bytes& out) const;
    bool loadChunk(std::size_t chunk);
    bool namesRecords(std::size_t chunk) const;
    bool record(std::uint64_t offset, Opcode& opcode, std::uint64_t& length) const;

    Source source_;
    std::string path_;
    std::uint64_t most_chunk_bytes_;
    std::vector<Schema> schemas_;
    std::vector<Channel> channels_;
    std::vector<ChunkIndex> chunks_;
    std::vector<MessagePlace> places_;
    std::map<std::string, Metadata> metadata_;
    std::vector<std::string> faults_;
    bool finished_ = false;
    std::uint64_t whole_size_ = 0;  ///< up to the end of the last whole record
    std::uint64_t unpacked_ = 0;    ///< by the scan so far [bytes]
    std::optional<std::size_t> loaded_;
    Bytes chunk_;
};

}  // namespace talus::mcap
