// The MCAP container: written data are read back; a file cut or damaged anywhere gives its whole part, and
// says so.

#include <doctest/doctest.h>
#include <fcntl.h>

#include <optional>
#include <set>

#include "mcap/compression.h"
#include "mcap/reader.h"
#include "mcap/writer.h"
#include "support/containers.h"
#include "support/files.h"

using namespace talus::mcap;
using talus::test::contentOf;
using talus::test::TemporaryFolder;

namespace {

constexpr std::uint64_t kMost = 1 << 20;
constexpr int kMessages = 24;

Bytes payload(int k) { return Bytes(static_cast<std::size_t>(40 + 3 * k), static_cast<std::uint8_t>(k)); }

/// Twenty-four messages on two channels, six to a chunk.
Bytes sampleFile(bool finish = true) {
    const TemporaryFolder folder;
    const std::string path = folder / "sample.mcap";
    {
        Writer writer(::open(path.c_str(), O_WRONLY | O_CREAT, 0600), {});
        REQUIRE(writer.start("test", "library") == 0);
        writer.addSchema({1, "Name", "flatbuffer", {1, 2, 3}});
        writer.addChannel({1, 1, "first", "flatbuffer"});
        writer.addChannel({2, 1, "second", "flatbuffer"});
        for (int k = 0; k < kMessages; ++k) {
            writer.add(k % 3 == 0 ? 2 : 1, static_cast<std::uint64_t>(10 * k), payload(k));
            if (k % 6 == 5) REQUIRE(writer.flush() == 0);
        }
        if (finish) {
            REQUIRE(writer.addMetadata("end", {{"key", "value"}}) == 0);
            REQUIRE(writer.finish() == 0);
        }
    }
    const std::string text = contentOf(path);
    return {text.begin(), text.end()};
}

/// The payloads that a reader finds and that are right; -1 in front when one is wrong.
std::set<int> readable(const Bytes& bytes) {
    auto reader = Reader::open(Source::of(bytes), "sample", kMost);
    std::set<int> found;
    if (!reader) return found;
    for (const MessagePlace& place : reader->places()) {
        const auto message = reader->message(place);
        if (!message) continue;
        const int k = static_cast<int>(place.time / 10);
        const bool right = k < kMessages && *message == payload(k) && place.channel == (k % 3 == 0 ? 2 : 1);
        found.insert(right ? k : -1);
    }
    return found;
}

}  // namespace

TEST_CASE("crc32 of the standard's check value") {
    const std::string text = "123456789";
    CHECK(crc32(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}) == 0xcbf43926);
    CHECK(crc32(0x1234, {}) == 0x1234);
}

TEST_CASE("compression gives back its bytes, and refuses every other size") {
    Bytes bytes(300000);
    for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(k * k >> 7);
    const Bytes packed = compress(bytes);
    Bytes out;
    REQUIRE(decompress("zstd", packed, bytes.size(), out));
    CHECK(out == bytes);
    CHECK_FALSE(decompress("zstd", packed, bytes.size() - 1, out));
    CHECK_FALSE(decompress("zstd", packed, bytes.size() + 1, out));
    CHECK_FALSE(decompress("zstd", packed, std::uint64_t{1} << 40, out));
    CHECK_FALSE(decompress("lz4", packed, bytes.size(), out));
    CHECK_FALSE(decompress("zstd", View(packed.data(), packed.size() / 2), bytes.size(), out));
    CHECK(decompress("zstd", compress({}), 0, out));
    // Little that claims to be much: refused by its head, before any memory is taken.
    const Bytes zeros(std::size_t{200} << 20), bomb = compress(zeros);
    REQUIRE(bomb.size() < 100'000);
    Bytes none;
    CHECK_FALSE(decompress("zstd", bomb, zeros.size(), none));
    CHECK(none.capacity() == 0);
    const Bytes resting(std::size_t{36} << 20);  // a million blocks that have not moved
    CHECK(decompress("zstd", compress(resting), resting.size(), out));
}

TEST_CASE("a finished file is read by its index") {
    const Bytes bytes = sampleFile();
    auto reader = Reader::open(Source::of(bytes), "sample", kMost);
    REQUIRE(reader.ok());
    CHECK(reader->finished());
    CHECK(reader->faults().empty());
    CHECK(reader->verify().empty());
    CHECK(reader->chunks().size() == 4);
    CHECK(reader->channels().size() == 2);
    CHECK(reader->metadata().at("end").at("key") == "value");
    CHECK(readable(bytes).size() == kMessages);
}

TEST_CASE("cut at any byte, all whole chunks are read back and the loss is said") {
    const Bytes whole = sampleFile();
    auto reader = Reader::open(Source::of(whole), "sample", kMost);
    REQUIRE(reader.ok());
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        std::size_t expected = 0;
        for (const ChunkIndex& chunk : reader->chunks())
            if (chunk.offset + chunk.length <= size) expected += 6;
        const std::set<int> found = readable(cut);
        CAPTURE(size);
        CHECK(found.size() == expected);
        CHECK_FALSE(found.contains(-1));
        auto again = Reader::open(Source::of(cut), "sample", kMost);
        if (again) CHECK_FALSE(again->faults().empty());
    }
}

TEST_CASE("a changed byte anywhere is noticed, and never gives a wrong message") {
    const Bytes whole = sampleFile();
    for (std::size_t at = 0; at < whole.size(); ++at) {
        Bytes damaged = whole;
        damaged[at] ^= 0x55;
        CAPTURE(at);
        CHECK_FALSE(readable(damaged).contains(-1));
        auto reader = Reader::open(Source::of(damaged), "sample", kMost);
        if (reader) CHECK_FALSE(reader->verify().empty());
    }
}

TEST_CASE(
    "an index that names a message or a chunk twice is not believed: one's bytes would be read as many "
    "times") {
    const Bytes whole = sampleFile();
    const auto put = [](Bytes& file, std::size_t at, const Bytes& bytes) {
        std::copy(bytes.begin(), bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(at));
    };
    const auto part = [](const Bytes& file, std::size_t at, std::size_t size) {
        const auto begin = file.begin() + static_cast<std::ptrdiff_t>(at);
        return Bytes(begin, begin + static_cast<std::ptrdiff_t>(size));
    };
    Bytes messages_twice = whole, chunk_twice = whole, within = whole;
    std::optional<Bytes> first_chunk;
    talus::test::eachRecord(whole, [&](std::size_t at, Opcode opcode, View content) {
        const std::size_t begin = at + kRecordHead, entries = begin + 6, entry = 16, place = begin + 16;
        if (opcode == Opcode::message_index && content.size >= 6 + 2 * entry) {
            put(messages_twice, entries + entry, part(whole, entries, entry));
            ++within[entries + entry + 8];  // the offset, by one
        }
        if (opcode != Opcode::chunk_index) return;
        if (first_chunk) put(chunk_twice, place, *first_chunk);
        if (!first_chunk) first_chunk = part(whole, place, 16);
    });
    for (Bytes* file : {&messages_twice, &chunk_twice, &within}) talus::test::seal(*file);
    for (const Bytes& file : {messages_twice, chunk_twice}) {
        REQUIRE(file != whole);
        auto reader = Reader::open(Source::of(file), "sample", kMost);
        REQUIRE(reader.ok());
        CHECK(reader->places().size() == kMessages);
        CHECK(readable(file).size() == kMessages);
        CHECK_FALSE(readable(file).contains(-1));
    }
    CHECK(readable(within).empty());
    CHECK_FALSE(Reader::open(Source::of(within), "sample", kMost)->verify().empty());
}

TEST_CASE("a file without its end is read to its last chunk") {
    const Bytes bytes = sampleFile(false);
    CHECK(readable(bytes).size() == kMessages);
    auto reader = Reader::open(Source::of(bytes), "sample", kMost);
    CHECK_FALSE(reader->finished());
    REQUIRE(reader->faults().size() == 1);
    CHECK(reader->faults()[0].find("no end") != std::string::npos);
}

TEST_CASE("a continued file is byte for byte the one written at once") {
    const Bytes whole = sampleFile();
    const TemporaryFolder folder;
    for (const bool finished : {true, false}) {
        const Bytes before = finished ? whole : sampleFile(false);
        const std::string path = folder.write("part.mcap", std::string(before.begin(), before.end()));
        auto reader = Reader::open(Source::of(before), "part", kMost);
        {
            Writer writer(::open(path.c_str(), O_WRONLY), *reader->prefix(2));
            for (int k = 12; k < kMessages; ++k) {
                writer.add(k % 3 == 0 ? 2 : 1, static_cast<std::uint64_t>(10 * k), payload(k));
                if (k % 6 == 5) REQUIRE(writer.flush() == 0);
            }
            REQUIRE(writer.addMetadata("end", {{"key", "value"}}) == 0);
            REQUIRE(writer.finish() == 0);
        }
        CHECK(contentOf(path) == std::string(whole.begin(), whole.end()));
    }
}
