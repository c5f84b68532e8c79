// The thread that writes a run's frames, and the bounded queue before it.

#include <fcntl.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "mcap/reader.h"
#include "mcap/writer.h"
#include "snapshot/convert.h"
#include "snapshot/layout.h"
#include "snapshot_schema.h"
#include "talus/formats/snapshot.h"

namespace talus::formats {
namespace {

using Clock = std::chrono::steady_clock;
using Item = std::variant<SnapshotHeader, LightFrame, FullFrame>;

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr std::chrono::seconds kMostDelay{1};  // of a frame on its way to the file
constexpr std::size_t kQueueLength = 8;        // frames
constexpr double kNoticeableWait = 1e-3;       // [s] shorter ones are the scheduler's

std::string shortest(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string hex(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

mcap::Metadata metadataOf(const SnapshotEnd& end) {
    std::string warnings;
    for (const std::string& warning : end.warnings) warnings += warning + "\n";
    return {{"ended", end.ended},
            {"steps", std::to_string(end.steps)},
            {"simulated_seconds", shortest(end.simulated_seconds)},
            {"state_hash", hex(end.state_hash)},
            {"wall_seconds", shortest(end.wall_seconds)},
            {"warnings", warnings}};
}

}  // namespace

struct SnapshotWriter::Work {
    // The container closes its descriptor; the lock stays with the other descriptor of the same open file.
    Work(OutputFile output, mcap::Written written)
        : target(std::move(output)),
          begun(written.size > 0),
          mcap(::fcntl(target.file(), F_DUPFD_CLOEXEC, 0), std::move(written)) {}
    ~Work() { stop(); }

    void push(Item item);
    void stop();
    void run();
    int write(Item& item);
    int begin(SnapshotHeader header);

    OutputFile target;
    bool begun;
    mcap::Writer mcap;  // the thread's alone while it runs

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Item> queue;
    bool ending = false;
    std::atomic<int> refused{0};
    std::atomic<bool> too_large{false};
    double waited = 0;  // the run's alone
    std::thread thread;
};

void SnapshotWriter::Work::push(Item item) {
    if (!thread.joinable()) thread = std::thread([this] { run(); });
    std::unique_lock lock(mutex);
    if (queue.size() >= kQueueLength) {
        const auto start = Clock::now();
        changed.wait(lock, [&] { return queue.size() < kQueueLength; });
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (seconds > kNoticeableWait) waited += seconds;
    }
    queue.push_back(std::move(item));
    changed.notify_all();
}

void SnapshotWriter::Work::stop() {
    {
        const std::lock_guard lock(mutex);
        ending = true;
    }
    changed.notify_all();
    if (thread.joinable()) thread.join();
}

/// Takes frames off the queue until the end. The last chunk is written then, or after a second.
void SnapshotWriter::Work::run() {
    Clock::time_point oldest;
    std::unique_lock lock(mutex);
    while (true) {
        const auto ready = [&] { return ending || !queue.empty(); };
        if (mcap.chunkSize() == 0) {
            changed.wait(lock, ready);
        } else if (!changed.wait_until(lock, oldest + kMostDelay, ready)) {
            lock.unlock();
            if (refused == 0) refused = mcap.flush();
            lock.lock();
            continue;
        }
        if (queue.empty()) break;
        Item item = std::move(queue.front());
        queue.pop_front();
        changed.notify_all();
        lock.unlock();
        if (mcap.chunkSize() == 0) oldest = Clock::now();
        try {
            if (refused == 0) refused = write(item);
        } catch (const std::bad_alloc&) {
            refused = ENOMEM;
        }
        if (refused == 0 && Clock::now() - oldest >= kMostDelay) refused = mcap.flush();
        lock.lock();
    }
    lock.unlock();
    if (refused == 0) refused = mcap.flush();
}

int SnapshotWriter::Work::write(Item& item) {
    if (auto* header = std::get_if<SnapshotHeader>(&item)) return begin(std::move(*header));
    if (auto* light = std::get_if<LightFrame>(&item)) {
        const std::uint64_t time = nanoseconds(light->time);
        mcap.add(kFrameChannel, time, encode(std::move(*light)));
        return mcap.chunkSize() >= kChunkBytes ? mcap.flush() : 0;
    }
    auto& full = std::get<FullFrame>(item);
    const std::uint64_t time = nanoseconds(full.time);
    const mcap::Bytes message = encode(std::move(full));
    if (message.empty()) {
        too_large = true;
        return EFBIG;
    }
    mcap.add(kFullChannel, time, message);
    return mcap.flush();
}

int SnapshotWriter::Work::begin(SnapshotHeader header) {
    begun = true;
    int error = mcap.start(std::string(kProfile), "talus " + header.build.version);
    for (const ChannelLayout& channel : kChannels) {
        const auto* bytes = std::data(kSnapshotSchema);
        if (error == 0)
            error = mcap.addSchema({channel.id, channel.schema, "flatbuffer",
                                    mcap::Bytes(bytes, bytes + std::size(kSnapshotSchema))});
        if (error == 0) error = mcap.addChannel({channel.id, channel.id, channel.topic, "flatbuffer"});
    }
    if (error != 0) return error;
    mcap.add(kHeaderChannel, 0, encode(std::move(header)));
    return mcap.flush();
}

SnapshotWriter SnapshotWriter::begin(OutputFile file) {
    return SnapshotWriter(std::make_unique<Work>(std::move(file), mcap::Written{}));
}

Result<SnapshotWriter> SnapshotWriter::open(const std::string& path) {
    auto file = OutputFile::open(path);
    if (!file) return file.errors();
    return begin(std::move(*file));
}

Result<SnapshotWriter> SnapshotWriter::continueFile(OutputFile file, std::size_t full) {
    const std::string path = file.path();
    auto source = mcap::Source::open(path);
    if (!source) return source.errors();
    auto reader = mcap::Reader::open(std::move(*source), path, SnapshotReader::kMostChunkBytes);
    if (!reader) return reader.errors();
    // Counted as the reader counts them: full states that stand behind the light frame of their instant.
    std::size_t seen = 0;
    std::optional<std::uint64_t> last_light;
    for (const mcap::MessagePlace& place : reader->places()) {
        if (place.channel == kFrameChannel) last_light = place.time;
        if (place.channel != kFullChannel || last_light != place.time || seen++ != full) continue;
        auto written = reader->prefix(place.chunk + 1);
        if (!written) return written.errors();
        return SnapshotWriter(std::make_unique<Work>(std::move(file), std::move(*written)));
    }
    return Error{"", "holds no full state to continue from", path};
}

SnapshotWriter::SnapshotWriter(std::unique_ptr<Work> work) : work_(std::move(work)) {}
SnapshotWriter::SnapshotWriter(SnapshotWriter&&) noexcept = default;
SnapshotWriter::~SnapshotWriter() = default;

void SnapshotWriter::write(SnapshotHeader header) { work_->push(std::move(header)); }
void SnapshotWriter::write(LightFrame frame) { work_->push(std::move(frame)); }
void SnapshotWriter::write(FullFrame frame) { work_->push(std::move(frame)); }

std::vector<Error> SnapshotWriter::finish(const SnapshotEnd& end) {
    work_->stop();
    int refused = work_->refused;
    if (refused == 0 && work_->begun)
        refused = work_->mcap.addMetadata(std::string(kEndName), metadataOf(end));
    if (refused == 0 && work_->begun) refused = work_->mcap.finish();
    const std::string& path = work_->target.path();
    if (work_->too_large)
        return {Error{path, "a full state of this model is beyond the 2 GB that a snapshot can hold"}};
    if (refused == 0 && work_->begun) refused = work_->target.sync(work_->mcap.fileSize());
    work_->refused = refused;
    if (refused != 0) return {Error{path, writeRefusal(refused)}};
    return {};
}

bool SnapshotWriter::failed() const { return work_->refused != 0; }
double SnapshotWriter::secondsWaited() const { return work_->waited; }
std::uint64_t SnapshotWriter::bytesWritten() const { return work_->mcap.fileSize(); }

}  // namespace talus::formats
