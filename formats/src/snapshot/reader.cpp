#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <utility>

#include "mcap/reader.h"
#include "snapshot/convert.h"
#include "snapshot/layout.h"
#include "talus/formats/inputs.h"
#include "talus/formats/snapshot.h"

namespace talus::formats {
namespace {

template <class Number>
Number numberOf(const mcap::Metadata& values, const char* key, int base = 10) {
    Number number{};
    const auto found = values.find(key);
    if (found == values.end()) return number;
    const std::string& text = found->second;
    if constexpr (std::is_floating_point_v<Number>) {
        std::from_chars(text.data(), text.data() + text.size(), number);
    } else {
        std::from_chars(text.data(), text.data() + text.size(), number, base);
    }
    return number;
}

std::string textOf(const mcap::Metadata& values, const char* key) {
    const auto found = values.find(key);
    return found == values.end() ? "" : found->second;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

}  // namespace

SnapshotFile inspectSnapshot(const std::string& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return SnapshotFile::absent;
    if (info.st_size == 0) return SnapshotFile::empty;
    auto source = mcap::Source::open(path);
    if (!source) return SnapshotFile::foreign;
    const auto reader = mcap::Reader::open(std::move(*source), path, SnapshotReader::kMostChunkBytes);
    if (!reader) return SnapshotFile::foreign;
    const bool ours = std::any_of(reader->channels().begin(), reader->channels().end(),
                                  [](const mcap::Channel& c) { return c.topic == kChannels[0].topic; });
    if (!ours)
        return reader->finished() || !reader->channels().empty() ? SnapshotFile::foreign
                                                                 : SnapshotFile::unfinished;
    return reader->metadata().contains(std::string(kEndName)) ? SnapshotFile::finished
                                                              : SnapshotFile::unfinished;
}

struct SnapshotReader::File {
    mcap::Reader mcap;
    std::string path;
    SnapshotHeader header{};
    std::vector<FrameEntry> frames{};
    std::vector<mcap::MessagePlace> frame_places{}, full_places{};
    std::vector<std::size_t> frame_of_full{};
    std::vector<std::string> faults{};

    std::vector<Error> readHeader();
    void listFrames();
    std::uint16_t channelOf(const char* topic) const;
    template <class Frame>
    Result<Frame> read(const mcap::MessagePlace& place, const char* what);
};

/// By topic: another program may have numbered the channels anew.
std::uint16_t SnapshotReader::File::channelOf(const char* topic) const {
    for (const mcap::Channel& channel : mcap.channels())
        if (channel.topic == topic && channel.message_encoding == "flatbuffer") return channel.id;
    return 0;
}

std::vector<Error> SnapshotReader::File::readHeader() {
    const std::uint16_t channel = channelOf(kChannels[0].topic);
    const auto& places = mcap.places();
    const auto place = std::find_if(places.begin(), places.end(),
                                    [&](const mcap::MessagePlace& p) { return p.channel == channel; });
    if (channel == 0) return {{"", "is an MCAP file without Talus snapshots", path}};
    if (place == places.end()) return {{"", "is cut before its header: there is nothing to read", path}};
    const auto message = mcap.message(*place);
    if (!message) return message.errors();
    std::string why;
    if (!decode(*message, header, why)) return {{"", "cannot be read: " + why, path}};
    if (!fits(header)) return {{"", "cannot be read: its header is damaged", path}};
    return {};
}

void SnapshotReader::File::listFrames() {
    const std::uint16_t light = channelOf(kChannels[1].topic), full = channelOf(kChannels[2].topic);
    for (const mcap::MessagePlace& place : mcap.places()) {
        if (place.channel == light) {
            frame_places.push_back(place);
            frames.push_back({seconds(place.time)});
        } else if (place.channel == full && !frames.empty() && frame_places.back().time == place.time) {
            frames.back().full = full_places.size();
            frame_of_full.push_back(frames.size() - 1);
            full_places.push_back(place);
        }
    }
    faults = mcap.faults();
    if (faults.empty() || frames.empty()) return;
    char time[32];
    const auto end = std::to_chars(time, time + sizeof time, frames.back().time).ptr;
    faults.push_back("whole are " + std::to_string(frames.size()) +
                     " frames up to t = " + std::string(time, end) + " s");
}

template <class Frame>
Result<Frame> SnapshotReader::File::read(const mcap::MessagePlace& place, const char* what) {
    const auto message = mcap.message(place);
    if (!message) return message.errors();
    Frame frame;
    if (!decode(*message, frame) || !fits(frame, header))
        return Error{
            "", std::string(what) + " at t = " + std::to_string(seconds(place.time)) + " s is damaged", path};
    return frame;
}

namespace {

template <class File, class Make>
Result<SnapshotReader> openWith(Result<mcap::Source> source, const std::string& path, std::uint64_t most,
                                const Make& make) {
    if (!source) return source.errors();
    auto mcap = mcap::Reader::open(std::move(*source), path, most);
    if (!mcap) return mcap.errors();
    auto file = std::make_unique<File>(File{std::move(*mcap), path});
    if (auto errors = file->readHeader(); !errors.empty()) return errors;
    file->listFrames();
    return make(std::move(file));
}

}  // namespace

Result<SnapshotReader> SnapshotReader::open(const std::string& path, std::uint64_t most) {
    rememberInput(path);
    auto reader = openWith<File>(mcap::Source::open(path), path, most,
                                 [](auto file) { return SnapshotReader(std::move(file)); });
    if (reader) rememberInput(reader->header().scenario_path);
    return reader;
}

Result<SnapshotReader> SnapshotReader::parse(const std::uint8_t* data, std::size_t size,
                                             const std::string& path, std::uint64_t most) {
    return openWith<File>(mcap::Source::of({data, size}), path, most,
                          [](auto file) { return SnapshotReader(std::move(file)); });
}

SnapshotReader::SnapshotReader(std::unique_ptr<File> file) : file_(std::move(file)) {}
SnapshotReader::SnapshotReader(SnapshotReader&&) noexcept = default;
SnapshotReader::~SnapshotReader() = default;

const SnapshotHeader& SnapshotReader::header() const { return file_->header; }
const std::vector<FrameEntry>& SnapshotReader::frames() const { return file_->frames; }
std::size_t SnapshotReader::fulls() const { return file_->full_places.size(); }
std::uint64_t SnapshotReader::fileSize() const { return file_->mcap.size(); }
const std::vector<std::string>& SnapshotReader::faults() const { return file_->faults; }

std::optional<std::size_t> SnapshotReader::frameOf(std::size_t full) const {
    return full < file_->frame_of_full.size() ? std::optional(file_->frame_of_full[full]) : std::nullopt;
}

std::optional<SnapshotEnd> SnapshotReader::end() const {
    const auto found = file_->mcap.metadata().find(std::string(kEndName));
    if (found == file_->mcap.metadata().end()) return std::nullopt;
    const mcap::Metadata& values = found->second;
    SnapshotEnd end;
    end.ended = textOf(values, "ended");
    end.steps = numberOf<std::int64_t>(values, "steps");
    end.simulated_seconds = numberOf<double>(values, "simulated_seconds");
    end.state_hash = numberOf<std::uint64_t>(values, "state_hash", 16);
    end.wall_seconds = numberOf<double>(values, "wall_seconds");
    end.warnings = linesOf(textOf(values, "warnings"));
    return end;
}

Result<LightFrame> SnapshotReader::frame(std::size_t index) {
    if (index >= file_->frame_places.size())
        return Error{"frame",
                     "is " + std::to_string(index) + ", but there are " +
                         std::to_string(file_->frame_places.size()) + " frames (from 0)",
                     file_->path};
    return file_->read<LightFrame>(file_->frame_places[index], "the frame");
}

Result<FullFrame> SnapshotReader::full(std::size_t index) {
    if (index >= file_->full_places.size())
        return Error{"full",
                     "is " + std::to_string(index) + ", but there are " +
                         std::to_string(file_->full_places.size()) + " full states (from 0)",
                     file_->path};
    return file_->read<FullFrame>(file_->full_places[index], "the full state");
}

std::vector<std::string> SnapshotReader::verify() {
    std::vector<std::string> faults = file_->mcap.verify();
    constexpr std::size_t kMostFaults = 20;
    const auto add = [&](const std::vector<Error>& errors) {
        if (errors.empty() || faults.size() >= kMostFaults) return;
        // All frames of a damaged chunk say the same.
        const std::string& fault = errors.front().message;
        if (std::find(faults.begin(), faults.end(), fault) == faults.end()) faults.push_back(fault);
    };
    for (std::size_t k = 0; k < frames().size(); ++k) {
        const auto light = frame(k);
        add(light.errors());
        if (!light || !frames()[k].full) continue;
        const auto state = full(*frames()[k].full);
        add(state.errors());
        if (state && hashOf(*state) != state->state_hash)
            add({Error{"", "the state hash of the full state at frame " + std::to_string(k) +
                               " is not that of its values"}});
        if (state && state->state_hash != light->state_hash)
            add({Error{"",
                       "frame " + std::to_string(k) + " and its full state have different state hashes"}});
    }
    return faults;
}

}  // namespace talus::formats
