#include "batch/store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"

namespace talus::tools::batch {

namespace {

constexpr const char* kInfoName = "batch.json";
constexpr const char* kLockName = ".lock";
constexpr std::size_t kChunk = 1 << 20;  // [bytes]

enum State : std::uint8_t { kOpen = 0, kDoneRow = 1, kFailedRow = 2 };

/// 0, or the errno of a refusal. OFD locks: of the open file, so they hold between processes and go with them.
int setLock(int file, short type, std::uint64_t byte, bool wait) {
    struct flock range {};
    range.l_type = type;
    range.l_whence = SEEK_SET;
    range.l_start = static_cast<off_t>(byte);
    range.l_len = 1;
    while (::fcntl(file, wait ? F_OFD_SETLKW : F_OFD_SETLK, &range) != 0)
        if (errno != EINTR) return errno;
    return 0;
}

std::string readAll(const std::string& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileRefused(path, "cannot be opened", errno);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

BatchInfo readInfo(const std::string& path) {
    try {
        return infoFromJson(Json::parse(readAll(path)));
    } catch (const nlohmann::json::exception& error) {
        throw BadInput(Error{"", std::string("is not the description of a batch: ") + error.what(), path});
    }
}

std::optional<std::uint64_t> runNumber(const Row& cells) {
    std::uint64_t run = 0;
    const std::string& text = cells.front();
    const auto read = std::from_chars(text.data(), text.data() + text.size(), run);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return run;
}

int openFile(const std::string& path, int flags) {
    const int file = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (file < 0) throw FileRefused(path, "cannot be opened", errno);
    return file;
}

std::uint64_t sizeOf(int file, const std::string& path) {
    struct stat info {};
    if (::fstat(file, &info) != 0) throw FileRefused(path, "cannot be looked at", errno);
    return static_cast<std::uint64_t>(info.st_size);
}

}  // namespace

/// Byte 0 of the lock file, for as long as it lives.
class Store::FolderLock {
 public:
    explicit FolderLock(Store& store) : store_(store) { store_.lock(0, true); }
    ~FolderLock() { store_.unlock(0); }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    Store& store_;
};

std::string resultsName(const Shard& shard) {
    if (shard.whole()) return "results.csv";
    return "results." + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".csv";
}

Store::Store(std::string folder, BatchInfo info, Shard shard)
    : folder_(std::move(folder)), info_(std::move(info)), shard_(shard), state_(info_.runs, kOpen) {
    makeFolder(folder_);
    lock_file_ = openFile(folder_ + "/" + kLockName, O_RDWR | O_CREAT);
    const FolderLock held(*this);
    prepare();
    openResults();
    cutTornRow();
    readNewRows();
}

Store::~Store() {
    if (results_ >= 0) ::close(results_);
    if (lock_file_ >= 0) ::close(lock_file_);
}

std::string Store::resultsPath() const { return folder_ + "/" + resultsName(shard_); }

/// The folder's description is this sweep's, or is written now.
void Store::prepare() {
    const std::string path = folder_ + "/" + kInfoName;
    if (!std::filesystem::exists(path)) {
        writeFile(path, toJson(info_).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
        return;
    }
    const BatchInfo there = readInfo(path);
    if (there.identity != info_.identity)
        throw BadInput(Error{"--output",
                             "holds the results of another sweep (" + there.sweep + ", identity " +
                                 there.identity + " instead of " + info_.identity +
                                 "); choose another folder",
                             folder_});
    if (csvHeader(there) != csvHeader(info_))
        throw BadInput(Error{
            "--output", "holds rows with other columns, of another version; choose another folder", folder_});
    // More samples, other thresholds to report on: the same runs, so the description follows the sweep.
    if (toJson(there) != toJson(info_) && there.runs <= info_.runs)
        writeFile(path, toJson(info_).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void Store::openResults() {
    const std::string path = resultsPath();
    results_ = openFile(path, O_RDWR | O_APPEND | O_CREAT);
    if (sizeOf(results_, path) > 0) return;
    const std::string header = csvHeader(info_);
    if (::write(results_, header.data(), header.size()) != static_cast<ssize_t>(header.size())) {
        const int error = errno;
        ::unlink(path.c_str());
        throw FileRefused(path, "cannot be written", error);
    }
    writeFile(path + "-metadata.json", csvMetadata(info_, resultsName(shard_)).dump(2) + "\n");
}

/// \pre byte 0 is held, so nobody is in the middle of a row
void Store::cutTornRow() {
    const std::string path = resultsPath();
    std::uint64_t size = sizeOf(results_, path), end = size;
    std::string chunk(4096, '\0');
    while (end > 0) {
        const std::uint64_t begin = end > chunk.size() ? end - chunk.size() : 0;
        const auto count = ::pread(results_, chunk.data(), end - begin, static_cast<off_t>(begin));
        if (count != static_cast<ssize_t>(end - begin)) throw FileRefused(path, "cannot be read", errno);
        const auto feed = std::string_view(chunk.data(), end - begin).rfind('\n');
        end = feed == std::string_view::npos ? begin : begin + feed + 1;
        if (feed != std::string_view::npos) break;
    }
    if (end < size && ::ftruncate(results_, static_cast<off_t>(end)) != 0)
        throw FileRefused(path, "cannot be cut after its last whole row", errno);
}

void Store::readNewRows() {
    const std::string path = resultsPath();
    std::string text;
    const std::uint64_t size = sizeOf(results_, path);
    while (read_up_to_ < size) {
        text.resize(std::min<std::uint64_t>(kChunk, size - read_up_to_));
        const auto count = ::pread(results_, text.data(), text.size(), static_cast<off_t>(read_up_to_));
        if (count <= 0) throw FileRefused(path, "cannot be read", errno);
        std::string_view rest(text.data(), static_cast<std::size_t>(count));
        const auto last = rest.rfind('\n');
        if (last == std::string_view::npos) return;  // a row is just being written
        rest = rest.substr(0, last + 1);
        const bool has_header = read_up_to_ == 0;
        read_up_to_ += rest.size();
        if (has_header) rest.remove_prefix(rest.find('\n') + 1);
        for (; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1))
            noteRow(rest.substr(0, rest.find('\n')));
    }
}

void Store::noteRow(std::string_view line) {
    const Row cells = csvFields(line);
    const auto run = runNumber(cells);
    if (!run || *run >= state_.size() || cells.size() != info_.columns.size()) return;
    const State state = isFailure(cells[*info_.find("status")]) ? kFailedRow : kDoneRow;
    done_ += state_[*run] == kOpen;
    failed_ += state == kFailedRow;
    failed_ -= state_[*run] == kFailedRow;
    state_[*run] = state;
}

bool Store::isDone(std::uint64_t run) const {
    const std::lock_guard held(mutex_);
    return state_[run] != kOpen;
}

bool Store::hasFailed(std::uint64_t run) const {
    const std::lock_guard held(mutex_);
    return state_[run] == kFailedRow;
}

std::uint64_t Store::doneCount() const {
    const std::lock_guard held(mutex_);
    return done_;
}

std::uint64_t Store::failedCount() const {
    const std::lock_guard held(mutex_);
    return failed_;
}

bool Store::lock(std::uint64_t byte, bool wait) {
    const int error = setLock(lock_file_, F_WRLCK, byte, wait);
    if (error == 0) return true;
    if (!wait && (error == EAGAIN || error == EACCES)) return false;
    throw FileRefused(folder_ + "/" + kLockName, "cannot be locked", error);
}

void Store::unlock(std::uint64_t byte) { setLock(lock_file_, F_UNLCK, byte, false); }

bool Store::claim(std::uint64_t run, bool again) {
    const std::lock_guard held(mutex_);
    const auto wanted = [&] { return state_[run] == kOpen || (again && state_[run] == kFailedRow); };
    if (!wanted() || !lock(1 + run, false)) return false;
    const State before = static_cast<State>(state_[run]);
    readNewRows();  // whoever had the run may have finished it since
    if (wanted() && state_[run] == before) return true;
    unlock(1 + run);
    return false;
}

void Store::release(std::uint64_t run) {
    const std::lock_guard held(mutex_);
    unlock(1 + run);
}

void Store::append(std::uint64_t run, const Row& row) {
    const std::string line = csvLine(row);
    const std::lock_guard held(mutex_);
    {
        const FolderLock folder(*this);
        cutTornRow();
        const std::uint64_t size = sizeOf(results_, resultsPath());
        const ssize_t written = ::write(results_, line.data(), line.size());
        if (written != static_cast<ssize_t>(line.size())) {
            const int error = written < 0 ? errno : ENOSPC;
            if (written > 0 && ::ftruncate(results_, static_cast<off_t>(size)) != 0) {
                // The next one to append cuts the torn row off.
            }
            unlock(1 + run);
            throw FileRefused(resultsPath(), "cannot be written", error);
        }
        readNewRows();
    }
    unlock(1 + run);
}

void Store::refresh() {
    const std::lock_guard held(mutex_);
    readNewRows();
}

void keepBetter(StoredBatch& stored, std::uint64_t run, std::string line) {
    const std::size_t status = *stored.info.find("status");
    const auto [there, is_new] = stored.lines.try_emplace(run, std::move(line));
    if (is_new) return;
    // try_emplace leaves a line it has no use for as it was.
    const bool worse = isFailure(csvFields(line)[status]) && !isFailure(csvFields(there->second)[status]);
    if (!worse) there->second = std::move(line);
}

StoredBatch readStored(const std::string& folder) {
    const std::string info_path = folder + "/" + kInfoName;
    if (!std::filesystem::exists(info_path))
        throw BadInput(Error{"", "holds no batch (there is no " + std::string(kInfoName) + ")", folder});
    StoredBatch stored{readInfo(info_path), {}};
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("results.") && name.ends_with(".csv")) files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    for (const std::string& file : files) {
        const std::string text = readAll(file);
        const std::string header = csvHeader(stored.info);
        if (!text.starts_with(header))
            throw BadInput(Error{"", "has other columns than its batch.json says", file, 1, 1});
        std::string_view rest = std::string_view(text).substr(header.size());
        for (auto end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
            const Row cells = csvFields(rest.substr(0, end));
            const auto run = runNumber(cells);
            if (run && cells.size() == stored.info.columns.size())
                keepBetter(stored, *run, std::string(rest.substr(0, end)));
            rest.remove_prefix(end + 1);
        }
    }
    return stored;
}

}  // namespace talus::tools::batch
