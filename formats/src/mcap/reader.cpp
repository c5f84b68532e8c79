#include "mcap/reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "mcap/compression.h"

namespace talus::mcap {
namespace {

constexpr std::uint64_t kStretch = 1 << 20;  // [bytes] read at a time for a checksum
// A record outside chunks (schema, metadata, index) that claims more than this is invalid.
constexpr std::uint64_t kMostRecordBytes = std::uint64_t{1} << 28;
constexpr std::size_t kMostFaults = 20;

void addFault(std::vector<std::string>& faults, std::string fault) {
    if (faults.size() < kMostFaults) faults.push_back(std::move(fault));
}

/// Every chunk is unpacked once by a scan, and once by readers of all messages: limit of the total for a file
/// of this size.
std::uint64_t mostUnpacked(std::uint64_t file_size) { return (std::uint64_t{1} << 30) + 256 * file_size; }

/// Each message costs its file at least an index entry, so a false index cannot name more of them than this.
std::size_t mostPlaces(std::uint64_t file_size) { return static_cast<std::size_t>(file_size / 16 + 16); }

/// Whether an index names every chunk once, one behind the other, and no more than such a file unpacks to.
bool arePlausible(const std::vector<ChunkIndex>& chunks, std::uint64_t file_size) {
    std::uint64_t end = 0, unpacked = 0;
    for (const ChunkIndex& chunk : chunks) {
        const std::uint64_t room = mostUnpacked(file_size) - unpacked;
        if (chunk.offset < end || chunk.offset > file_size || chunk.length > file_size - chunk.offset ||
            chunk.uncompressed_size > room)
            return false;
        end = chunk.offset + chunk.length;
        unpacked += chunk.uncompressed_size;
    }
    return true;
}

bool known(const std::vector<Channel>& channels, std::uint16_t id) {
    return std::any_of(channels.begin(), channels.end(), [&](const Channel& c) { return c.id == id; });
}

}  // namespace

Result<Source> Source::open(const std::string& path) {
    Source source;
    source.file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat info {};
    if (source.file_ < 0 || ::fstat(source.file_, &info) != 0)
        return Error{"", std::string("cannot be opened: ") + std::strerror(errno), path};
    if (!S_ISREG(info.st_mode)) return Error{"", "is not a regular file; allowed: a .mcap file", path};
    source.size_ = static_cast<std::uint64_t>(info.st_size);
    return source;
}

Source Source::of(View bytes) {
    Source source;
    source.memory_ = bytes;
    source.size_ = bytes.size;
    return source;
}

Source::Source(Source&& other) noexcept
    : file_(std::exchange(other.file_, -1)), memory_(other.memory_), size_(other.size_) {}

Source::~Source() {
    if (file_ >= 0) ::close(file_);
}

bool Source::read(std::uint64_t offset, std::uint64_t size, Bytes& out) const {
    out.clear();
    if (offset > size_ || size > size_ - offset) return false;
    if (file_ < 0) {
        const std::uint8_t* begin = memory_.data + offset;
        out.assign(begin, begin + size);
        return true;
    }
    out.resize(static_cast<std::size_t>(size));
    for (std::size_t done = 0; done < out.size();) {
        const ssize_t got =
            ::pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
        if (got == 0 || (got < 0 && errno != EINTR)) return false;
        if (got > 0) done += static_cast<std::size_t>(got);
    }
    return true;
}

Result<Reader> Reader::open(Source source, const std::string& path, std::uint64_t most_chunk_bytes) {
    Bytes magic;
    if (!source.read(0, kMagic.size(), magic) || !std::equal(magic.begin(), magic.end(), kMagic.begin()))
        return Error{"", "is not an MCAP file (its first bytes are others)", path};
    Reader reader(std::move(source), path, most_chunk_bytes);
    if (!reader.readSummary()) reader.scan();
    return reader;
}

/// Opcode and content length of the record at `offset`; false when it is not whole.
bool Reader::record(std::uint64_t offset, Opcode& opcode, std::uint64_t& length) const {
    Bytes head;
    if (!source_.read(offset, kRecordHead, head)) return false;
    Decoder d(head);
    opcode = static_cast<Opcode>(d.integer<std::uint8_t>());
    length = d.integer<std::uint64_t>();
    return length <= source_.size() - offset - kRecordHead;
}

bool Reader::readSummary() {
    const std::uint64_t tail = kFooterSize + kMagic.size();
    Bytes bytes;
    if (source_.size() < tail || !source_.read(source_.size() - tail, tail, bytes)) return false;
    if (!std::equal(kMagic.begin(), kMagic.end(), bytes.end() - static_cast<std::ptrdiff_t>(kMagic.size())))
        return false;
    Decoder footer(bytes);
    if (static_cast<Opcode>(footer.integer<std::uint8_t>()) != Opcode::footer) return false;
    footer.integer<std::uint64_t>();
    const auto start = footer.integer<std::uint64_t>();
    footer.integer<std::uint64_t>();
    const auto crc = footer.integer<std::uint32_t>();
    const std::uint64_t end = source_.size() - kMagic.size() - sizeof(std::uint32_t);
    if (start == 0 || start >= end || end - start > kMostRecordBytes ||
        !source_.read(start, end - start, bytes) || (crc != 0 && crc32(0, bytes) != crc))
        return false;

    std::vector<MetadataIndex> metadata;
    Decoder d(bytes);
    while (d.ok() && d.left() > kFooterSize - sizeof(std::uint32_t)) {
        const auto opcode = static_cast<Opcode>(d.integer<std::uint8_t>());
        const View content = d.raw(d.integer<std::uint64_t>());
        bool sound = d.ok();
        if (opcode == Opcode::schema) sound = sound && decode(content, schemas_.emplace_back());
        if (opcode == Opcode::channel) sound = sound && decode(content, channels_.emplace_back());
        if (opcode == Opcode::chunk_index) sound = sound && decode(content, chunks_.emplace_back());
        if (opcode == Opcode::metadata_index) sound = sound && decode(content, metadata.emplace_back());
        if (!sound) break;
    }
    bool sound = d.ok() && arePlausible(chunks_, source_.size());
    for (std::size_t chunk = 0; chunk < chunks_.size() && sound; ++chunk) sound = readMessageIndex(chunk);
    for (const MetadataIndex& index : metadata) {
        if (!sound || index.length < kRecordHead || index.length > kMostRecordBytes) break;
        std::string name;
        Metadata values;
        sound = source_.read(index.offset, index.length, bytes) &&
                decodeMetadata(View(bytes).from(kRecordHead), name, values);
        if (sound) metadata_[name] = std::move(values);
    }
    finished_ = sound;
    whole_size_ = start;
    if (sound) return true;
    schemas_.clear(), channels_.clear(), chunks_.clear(), places_.clear(), metadata_.clear();
    return false;
}

bool Reader::readMessageIndex(std::size_t chunk) {
    const ChunkIndex& index = chunks_[chunk];
    if (index.message_index_length > kMostRecordBytes || index.offset > source_.size() ||
        index.length > source_.size() - index.offset)
        return false;
    Bytes bytes;
    if (!source_.read(index.offset + index.length, index.message_index_length, bytes)) return false;
    std::vector<MessagePlace> places;
    Decoder d(bytes);
    while (d.ok() && !d.empty()) {
        const auto opcode = static_cast<Opcode>(d.integer<std::uint8_t>());
        const View content = d.raw(d.integer<std::uint64_t>());
        std::uint16_t channel = 0;
        std::vector<IndexEntry> entries;
        if (!d.ok() || opcode != Opcode::message_index || !decodeMessageIndex(content, channel, entries) ||
            !known(channels_, channel) ||
            places_.size() + places.size() + entries.size() > mostPlaces(source_.size()))
            return false;
        for (const IndexEntry& entry : entries) places.push_back({channel, entry.time, chunk, entry.offset});
    }
    std::sort(places.begin(), places.end(),
              [](const MessagePlace& a, const MessagePlace& b) { return a.offset < b.offset; });
    const auto same = [](const MessagePlace& a, const MessagePlace& b) { return a.offset == b.offset; };
    if (std::adjacent_find(places.begin(), places.end(), same) != places.end()) return false;
    places_.insert(places_.end(), places.begin(), places.end());
    return d.ok();
}

void Reader::scan() {
    std::uint64_t offset = kMagic.size();
    bool data_ended = false;
    Bytes content;
    while (offset < source_.size() && !data_ended) {
        Opcode opcode{};
        std::uint64_t length = 0;
        if (!record(offset, opcode, length)) break;
        const bool chunk = opcode == Opcode::chunk;
        if (length > (chunk ? most_chunk_bytes_ : kMostRecordBytes)) {
            addFault(faults_, "the record at byte " + std::to_string(offset) + " is " +
                                  std::to_string(length) + " bytes long, more than this reader accepts");
            break;
        }
        if (!source_.read(offset + kRecordHead, length, content) || !scanRecord(opcode, content, offset))
            break;
        offset += kRecordHead + length;
        data_ended = opcode == Opcode::data_end;
    }
    whole_size_ = offset;
    if (data_ended) {
        addFault(faults_, "the index at the end is damaged or cut; the data before it are whole");
    } else if (offset == source_.size()) {
        addFault(faults_, "the file has no end: its run is still going on or was killed");
    } else {
        addFault(faults_, "the file is cut or damaged: the last " + std::to_string(source_.size() - offset) +
                              " of its " + std::to_string(source_.size()) + " bytes are not a whole record");
    }
}

/// False where the file stops making sense.
bool Reader::scanRecord(Opcode opcode, View content, std::uint64_t offset) {
    switch (opcode) {
        case Opcode::schema: {
            Schema schema;
            if (!decode(content, schema)) return false;
            schemas_.push_back(std::move(schema));
            return true;
        }
        case Opcode::channel: {
            Channel channel;
            if (!decode(content, channel)) return false;
            if (!known(channels_, channel.id)) channels_.push_back(std::move(channel));
            return true;
        }
        case Opcode::chunk:
            scanChunk(content, offset);
            return true;
        case Opcode::metadata: {
            std::string name;
            Metadata values;
            if (!decodeMetadata(content, name, values)) return false;
            metadata_[name] = std::move(values);
            return true;
        }
        case Opcode::message_index:
            // What they say was found in the chunk itself; their place belongs to the chunk.
            if (!chunks_.empty() && content.size >= sizeof(std::uint16_t)) {
                ChunkIndex& chunk = chunks_.back();
                if (offset != chunk.offset + chunk.length + chunk.message_index_length) return true;
                chunk.message_index_offsets[Decoder(content).integer<std::uint16_t>()] = offset;
                chunk.message_index_length += kRecordHead + content.size;
            }
            return true;
        default:
            return static_cast<std::uint8_t>(opcode) != 0;
    }
}

void Reader::scanChunk(View content, std::uint64_t offset) {
    ChunkIndex index;
    std::uint32_t crc = 0;
    std::size_t head = 0;
    Bytes records;
    index.offset = offset;
    index.length = kRecordHead + content.size;
    const bool has_head = decodeChunkHead(content, index, crc, head);
    const std::uint64_t room = mostUnpacked(source_.size()) - unpacked_;
    if (has_head && index.uncompressed_size > room) {
        addFault(faults_, "the chunk at byte " + std::to_string(offset) +
                              " is not read: it unpacks to more bytes than a file of this size can hold");
        return;
    }
    unpacked_ += has_head ? index.uncompressed_size : 0;
    if (!has_head || !unpack(content, index, crc, head, records)) {
        addFault(faults_,
                 "the chunk at byte " + std::to_string(offset) + " is damaged; its frames are missing");
        return;
    }
    Decoder d(records);
    while (d.ok() && !d.empty()) {
        const std::uint64_t at = d.at();
        const auto opcode = static_cast<Opcode>(d.integer<std::uint8_t>());
        const View record = d.raw(d.integer<std::uint64_t>());
        Message message;
        Channel channel;
        if (!d.ok() || places_.size() >= mostPlaces(source_.size())) break;
        if (opcode == Opcode::channel && decode(record, channel) && !known(channels_, channel.id))
            channels_.push_back(std::move(channel));
        if (opcode == Opcode::message && decode(record, message) && known(channels_, message.channel))
            places_.push_back({message.channel, message.time, chunks_.size(), at});
    }
    chunks_.push_back(std::move(index));
}

bool Reader::unpack(View content, const ChunkIndex& index, std::uint32_t crc, std::size_t head,
                    Bytes& out) const {
    return index.uncompressed_size <= most_chunk_bytes_ && head <= content.size &&
           index.compressed_size == content.size - head &&
           decompress(index.compression, content.from(head), index.uncompressed_size, out) &&
           (crc == 0 || crc32(0, out) == crc);
}

bool Reader::loadChunk(std::size_t chunk) {
    if (loaded_ == chunk) return true;
    loaded_.reset();
    const ChunkIndex& known_index = chunks_[chunk];
    if (known_index.length < kRecordHead || known_index.length > most_chunk_bytes_ + kRecordHead)
        return false;
    Bytes bytes;
    ChunkIndex index;
    std::uint32_t crc = 0;
    std::size_t head = 0;
    if (!source_.read(known_index.offset, known_index.length, bytes) ||
        static_cast<Opcode>(bytes[0]) != Opcode::chunk)
        return false;
    const View content = View(bytes).from(kRecordHead);
    if (!decodeChunkHead(content, index, crc, head) ||
        index.uncompressed_size != known_index.uncompressed_size ||
        !unpack(content, index, crc, head, chunk_) || !namesRecords(chunk))
        return false;
    loaded_ = chunk;
    return true;
}

/// Whether every place named in the loaded chunk has a record of its own. Otherwise the bytes of one record
/// could be read as many.
bool Reader::namesRecords(std::size_t chunk) const {
    const auto before = [](const MessagePlace& place, std::size_t wanted) { return place.chunk < wanted; };
    auto place = std::lower_bound(places_.begin(), places_.end(), chunk, before);
    Decoder d(chunk_);
    while (d.ok() && !d.empty() && place != places_.end() && place->chunk == chunk) {
        const std::uint64_t at = d.at();
        d.integer<std::uint8_t>();
        d.raw(d.integer<std::uint64_t>());
        if (place->offset == at) ++place;
    }
    return place == places_.end() || place->chunk != chunk;
}

Result<Bytes> Reader::message(const MessagePlace& place) {
    const Error damaged{
        "", "the chunk at byte " + std::to_string(chunks_[place.chunk].offset) + " is damaged", path_};
    if (!loadChunk(place.chunk) || place.offset >= chunk_.size()) return damaged;
    Decoder d(View(chunk_).from(static_cast<std::size_t>(place.offset)));
    const auto opcode = static_cast<Opcode>(d.integer<std::uint8_t>());
    const View content = d.raw(d.integer<std::uint64_t>());
    Message found;
    if (!d.ok() || opcode != Opcode::message || !decode(content, found) || found.channel != place.channel ||
        found.time != place.time)
        return damaged;
    return Bytes(found.data.data, found.data.data + found.data.size);
}

std::vector<std::string> Reader::verify() {
    std::vector<std::string> faults = faults_;
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk)
        if (!loadChunk(chunk))
            addFault(faults, "the chunk at byte " + std::to_string(chunks_[chunk].offset) + " is damaged");
    if (!finished_) return faults;
    // The data section ends where the last record before the summary, data end, begins.
    const std::uint64_t end = whole_size_ - kRecordHead - sizeof(std::uint32_t);
    Bytes bytes;
    std::uint32_t crc = 0;
    for (std::uint64_t offset = 0; offset < end; offset += kStretch) {
        if (!source_.read(offset, std::min(kStretch, end - offset), bytes)) return faults;
        crc = crc32(crc, bytes);
    }
    if (!source_.read(end, kRecordHead + sizeof(std::uint32_t), bytes)) return faults;
    Decoder d(bytes);
    const bool is_end = static_cast<Opcode>(d.integer<std::uint8_t>()) == Opcode::data_end &&
                        d.integer<std::uint64_t>() == sizeof(std::uint32_t);
    const auto expected = d.integer<std::uint32_t>();
    if (!is_end || (expected != 0 && expected != crc))
        addFault(faults, "the checksum of the whole data section does not hold");
    return faults;
}

Result<Written> Reader::prefix(std::size_t chunks) {
    Written written;
    written.schemas = schemas_;
    written.channels = channels_;
    written.chunks.assign(chunks_.begin(), chunks_.begin() + static_cast<std::ptrdiff_t>(chunks));
    written.size =
        chunks_[chunks - 1].offset + chunks_[chunks - 1].length + chunks_[chunks - 1].message_index_length;
    Statistics& s = written.statistics;
    for (const MessagePlace& place : places_) {
        if (place.chunk >= chunks) continue;
        s.start_time = s.messages == 0 ? place.time : std::min(s.start_time, place.time);
        s.end_time = std::max(s.end_time, place.time);
        ++s.messages;
        ++s.channel_messages[place.channel];
        ++written.sequence[place.channel];
    }
    Bytes bytes;
    for (std::uint64_t offset = 0; offset < written.size; offset += kStretch) {
        if (!source_.read(offset, std::min(kStretch, written.size - offset), bytes))
            return Error{"", "cannot be read to its end", path_};
        written.data_crc = crc32(written.data_crc, bytes);
    }
    return written;
}

}  // namespace talus::mcap
