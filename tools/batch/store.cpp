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
#include "cli/outputs.h"
#include "talus/formats/locks.h"

namespace talus::tools::batch {

namespace {

constexpr const char* kInfoName = "batch.json";
constexpr const char* kLockName = ".lock";
constexpr std::size_t kChunk = 1 << 20;  // [bytes]
// Shared by every process that has the folder open, taken alone by one that puts other results in their
// place.
constexpr std::uint64_t kPresence = std::uint64_t{1} << 62;

enum State : std::uint8_t { kOpen = 0, kDoneRow = 1, kFailedRow = 2 };

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

/// A device or a pipe, also behind a link: there nothing can be lost.
bool isDevice(const std::string& path) {
    std::error_code absent;
    const auto there = std::filesystem::status(path, absent);
    return std::filesystem::exists(there) && !std::filesystem::is_regular_file(there) &&
           !std::filesystem::is_directory(there);
}

int openFile(const std::string& path, int flags) {
    const int file = ::open(path.c_str(), flags | (isDevice(path) ? 0 : O_NOFOLLOW) | O_CLOEXEC, 0666);
    if (file < 0) throw FileRefused(path, "cannot be opened", errno);
    return file;
}

std::uint64_t sizeOf(int file, const std::string& path) {
    struct stat info {};
    if (::fstat(file, &info) != 0) throw FileRefused(path, "cannot be inspected", errno);
    return static_cast<std::uint64_t>(info.st_size);
}

/// What is in a file is these results, or the beginning of their first line that a killed process left.
bool areResults(const std::string& path, const std::string& header) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none))
        return true;  // nothing there, or nothing that can be lost
    std::ifstream file(path, std::ios::binary);
    std::string start(header.size(), '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    return header.starts_with(start);
}

/// The batch chooses the names of its files, so writing must stay inside the folder. A link may lead to the
/// results of another batch, even to those that are being merged.
void refuseLinks(const std::string& folder, const std::string& results) {
    const std::string in = folder + "/";
    for (const std::string& path : {in + kInfoName, in + kLockName, results, results + "-metadata.json",
                                    in + kSummaryName, in + kReportName, in + kPageName}) {
        std::error_code absent;
        if (!isDevice(path) && std::filesystem::is_symlink(path, absent)) {
            throw BadInput(Error{"--output",
                                 "is a link, and a batch writes only files of its own; remove the link or "
                                 "choose another folder",
                                 path});
        }
    }
}

/// Before anything is written: what is there is this sweep's, or nothing.
void refuseForeign(const std::string& folder, const std::string& results, const BatchInfo& info) {
    refuseLinks(folder, results);
    refuseInput("--output", results);
    refuseInput("--output", folder + "/" + kInfoName);
    const std::string path = folder + "/" + kInfoName;
    if (std::filesystem::exists(path)) {
        const BatchInfo there = readInfo(path);
        if (there.identity != info.identity)
            throw BadInput(Error{"--output",
                                 "holds the results of another sweep (" + there.sweep + ", identity " +
                                     there.identity + " instead of " + info.identity +
                                     "); choose another folder",
                                 folder});
        if (csvHeader(there) != csvHeader(info))
            throw BadInput(Error{"--output",
                                 "holds rows with other columns, of another version; choose another folder",
                                 folder});
    } else {
        for (const char* name : {kSummaryName, kReportName, kPageName}) {
            if (const std::string report = folder + "/" + name; std::filesystem::exists(report))
                throw BadInput(Error{"--output",
                                     "exists and does not belong to a batch; choose another folder", report});
        }
    }
    if (!areResults(results, csvHeader(info)))
        throw BadInput(Error{
            "--output", "exists and is not a table of this sweep's results; choose another folder", results});
}

int openLock(const std::string& folder) {
    const int file = openFile(folder + "/" + kLockName, O_RDWR | O_CREAT);
    const auto reach = formats::lockReach(file);
    if (const std::string warning = formats::lockWarning(reach); !warning.empty())
        std::fprintf(stderr, "warning: %s: %s\n", folder.c_str(), warning.c_str());
    return file;
}

[[noreturn]] void refuseLock(const std::string& folder, int error) {
    if (formats::noLocksHere(error))
        throw FileRefused(folder +
                          ": its file system has no locks, without which two processes could write the "
                          "same rows; choose a folder on another one");
    throw FileRefused(folder + "/" + kLockName, "cannot be locked", error);
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
    refuseForeign(folder_, resultsPath(), info_);
    lock_file_ = openLock(folder_);
    const FolderLock held(*this);
    if (const int error = formats::setLock(lock_file_, formats::LockMode::shared, {kPresence}, false))
        refuseLock(folder_, error);
    refuseForeign(folder_, resultsPath(), info_);  // another process may have begun meanwhile
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

/// The folder's description is this sweep's, or is written now. \pre nothing in it is another's
void Store::prepare() {
    const std::string path = folder_ + "/" + kInfoName;
    if (!std::filesystem::exists(path)) {
        writeFile(path, jsonText(toJson(info_), 2) + "\n");
        return;
    }
    const BatchInfo there = readInfo(path);
    // More samples, other thresholds to report on: the same runs, so the description follows the sweep.
    if (toJson(there) != toJson(info_) && there.runs <= info_.runs)
        writeFile(path, jsonText(toJson(info_), 2) + "\n");
}

void Store::openResults() {
    const std::string path = resultsPath();
    results_ = openFile(path, O_RDWR | O_APPEND | O_CREAT);
    const std::uint64_t size = sizeOf(results_, path);
    if (size >= csvHeader(info_).size()) return;
    if (size > 0 && ::ftruncate(results_, 0) != 0) throw FileRefused(path, "cannot be emptied", errno);
    const std::string header = csvHeader(info_);
    if (::write(results_, header.data(), header.size()) != static_cast<ssize_t>(header.size())) {
        const int error = errno;
        ::unlink(path.c_str());
        throw FileRefused(path, "cannot be written", error);
    }
    writeFile(path + "-metadata.json", jsonText(csvMetadata(info_, resultsName(shard_)), 2) + "\n");
}

/// \pre byte 0 is held, so no process is in the middle of a row
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
    const int error = formats::setLock(lock_file_, formats::LockMode::exclusive, {byte}, wait);
    if (error == 0) return true;
    if (!wait && formats::lockIsHeld(error)) return false;
    refuseLock(folder_, error);
}

void Store::unlock(std::uint64_t byte) {
    formats::setLock(lock_file_, formats::LockMode::none, {byte}, false);
}

void Store::requireFolder() const {
    struct stat here {
    }, there{};
    if (::fstat(results_, &here) == 0 && ::stat(resultsPath().c_str(), &there) == 0 &&
        here.st_ino == there.st_ino && here.st_dev == there.st_dev &&
        static_cast<std::uint64_t>(here.st_size) >= read_up_to_)
        return;
    throw FileRefused(resultsPath() + ": was removed, replaced or truncated while the batch went on");
}

int Store::sync() {
    const std::lock_guard held(mutex_);
    requireFolder();
    formats::syncFolderOf(resultsPath());
    return ::fsync(results_) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

bool Store::claim(std::uint64_t run, bool again) {
    const std::lock_guard held(mutex_);
    const auto wanted = [&] { return state_[run] == kOpen || (again && state_[run] == kFailedRow); };
    if (!wanted() || !lock(1 + run, false)) return false;
    const State before = static_cast<State>(state_[run]);
    readNewRows();  // the process that had the run may have finished it since
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
        requireFolder();
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

AloneIn::AloneIn(const std::string& folder) : file_(openLock(folder)) {
    const int error = formats::setLock(file_, formats::LockMode::exclusive, {kPresence}, false);
    if (error == 0) return;
    ::close(file_);
    if (formats::lockIsHeld(error))
        throw FileRefused(folder + ": a batch is running in this folder; wait for its end");
    refuseLock(folder, error);
}

AloneIn::~AloneIn() { ::close(file_); }

void refuseToReplaceOther(const std::string& folder, const BatchInfo& info) {
    refuseForeign(folder, folder + "/" + resultsName({}), info);
}

void keepBetter(StoredBatch& stored, std::uint64_t run, std::string line) {
    const std::size_t status = *stored.info.find("status");
    const auto [there, is_new] = stored.lines.try_emplace(run, std::move(line));
    if (is_new) return;
    // try_emplace leaves a line it has no use for as it was.
    const bool worse = isFailure(csvFields(line)[status]) && !isFailure(csvFields(there->second)[status]);
    if (!worse) there->second = std::move(line);
}

StoredBatch onlyRunsOf(const BatchInfo& info, StoredBatch stored) {
    stored.info = info;
    stored.beyond = std::erase_if(stored.lines, [&](const auto& line) { return line.first >= info.runs; });
    return stored;
}

namespace {

StoredBatch emptyBatch(const std::string& folder) {
    const std::string info_path = folder + "/" + kInfoName;
    if (!std::filesystem::exists(info_path))
        throw BadInput(Error{"", "holds no batch (there is no " + std::string(kInfoName) + ")", folder});
    return {.info = readInfo(info_path), .lines = {}};
}

void addRows(const std::string& file, StoredBatch& stored) {
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

}  // namespace

StoredBatch readStored(const std::string& folder) {
    StoredBatch stored = emptyBatch(folder);
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("results.") && name.ends_with(".csv")) files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    for (const std::string& file : files) addRows(file, stored);
    return stored;
}

StoredBatch readStored(const std::string& folder, const Shard& shard) {
    StoredBatch stored = emptyBatch(folder);
    addRows(folder + "/" + resultsName(shard), stored);
    return stored;
}

}  // namespace talus::tools::batch
