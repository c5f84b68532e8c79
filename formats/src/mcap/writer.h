#pragma once
// Writes an MCAP file. Messages are gathered into chunks, which are written whole, each compressed and with
// its checksum and index. The summary follows at the end. A process that dies leaves all chunks it wrote.

#include <optional>

#include "mcap/records.h"

namespace talus::mcap {

/// Content of the file so far; a continued file starts from what a reader found in it.
struct Written {
    std::uint64_t size = 0;      ///< [bytes]
    std::uint32_t data_crc = 0;  ///< of all of them
    std::vector<Schema> schemas;
    std::vector<Channel> channels;
    std::vector<ChunkIndex> chunks;
    std::map<std::uint16_t, std::uint32_t> sequence;  ///< of the next message of each channel
    Statistics statistics;
};

class Writer {
 public:
    /// Takes over an open file whose first `written.size` bytes are those that `written` tells of; the rest
    /// is cut off with the first write.
    Writer(int file, Written written) : file_(file), written_(std::move(written)) {}
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer();  ///< closes the file as it stands

    // Each returns 0, or the error number of the file system's refusal. After a refusal the file is cut back
    // to its last whole record, and nothing more is written.
    int start(const std::string& profile, const std::string& library);
    int addSchema(const Schema& schema);
    int addChannel(const Channel& channel);
    int flush();  ///< ends the chunk
    int addMetadata(const std::string& name, const Metadata& values);
    int finish();  ///< the rest of the file; closes it

    /// Adds a message to the chunk.
    void add(std::uint16_t channel, std::uint64_t time, View data);

    std::size_t chunkSize() const { return chunk_.size(); }
    std::uint64_t fileSize() const { return written_.size; }

 private:
    int append(View bytes);
    void addToSummary(Bytes& out, std::uint64_t start) const;

    int file_ = -1;
    int refused_ = 0;
    bool cut_ = false;  ///< to the size of what was there
    Written written_;
    std::vector<MetadataIndex> metadata_;
    Bytes chunk_;
    ChunkIndex chunk_index_;
    std::map<std::uint16_t, std::vector<IndexEntry>> entries_;
};

}  // namespace talus::mcap
