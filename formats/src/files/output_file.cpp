#include "talus/formats/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace talus::formats {

namespace {

constexpr mode_t kMode = 0666;  // the user's umask decides
// One byte where no file reaches: readers of the bytes themselves meet no lock.
constexpr LockRange kWriter{std::uint64_t{1} << 62, 1};

bool isRegular(int file) {
    struct stat info {};
    return ::fstat(file, &info) == 0 && S_ISREG(info.st_mode);
}

Error refusal(const std::string& path, int error) {
    return {path, std::string("cannot be opened for writing: ") + std::strerror(error)};
}

/// An existing file is opened as it is; a new one is created exclusively, so that no link can take its place.
int openOrMake(const std::string& path, bool may_create, bool& created) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (file >= 0 || errno != ENOENT || !may_create) return file;
        file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode);
        created = file >= 0;
        if (created || errno != EEXIST) return file;
        struct stat info {};
        if (::lstat(path.c_str(), &info) == 0 && S_ISLNK(info.st_mode)) {  // it leads to nothing
            errno = ELOOP;
            return -1;
        }
    }
    return -1;
}

}  // namespace

Result<OutputFile> OutputFile::open(const std::string& path) { return open(path, true); }
Result<OutputFile> OutputFile::openExisting(const std::string& path) { return open(path, false); }

Result<OutputFile> OutputFile::open(const std::string& path, bool may_create) {
    while (true) {
        bool created = false;
        const int file = openOrMake(path, may_create, created);
        if (file < 0) return refusal(path, errno);
        OutputFile output(file, path);
        if (!isRegular(file)) return output;
        const int refused = setLock(file, LockMode::exclusive, kWriter, false);
        if (lockIsHeld(refused))
            return Error{path,
                         "is being written by another process; wait for its end, or choose another file"};
        if (refused != 0 && !noLocksHere(refused)) return refusal(path, refused);
        output.reach_ = refused != 0 ? LockReach::none : formats::lockReach(file);
        // Only now: between creation and locking another process may have opened the file and written.
        output.created_ = created;
        // Between opening and locking, its previous owner may have removed the file.
        if (output.isAtItsPath()) return output;
    }
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      created_(other.created_),
      reach_(other.reach_),
      path_(std::move(other.path_)) {}

OutputFile::~OutputFile() {
    if (file_ < 0) return;
    struct stat info {};
    if (created_ && ::fstat(file_, &info) == 0 && info.st_size == 0 && isAtItsPath()) ::unlink(path_.c_str());
    ::close(file_);
}

bool OutputFile::isAtItsPath() const {
    struct stat here {
    }, there{};
    if (::fstat(file_, &here) != 0) return false;
    if (!S_ISREG(here.st_mode)) return true;
    return ::stat(path_.c_str(), &there) == 0 && here.st_ino == there.st_ino && here.st_dev == there.st_dev;
}

int OutputFile::sync(std::uint64_t written) const {
    if (!isRegular(file_)) return 0;
    if (::fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP) return errno;
    if (!isAtItsPath() || !isAsLong(file_, written)) return ENOENT;
    syncFolderOf(path_);
    return 0;
}

bool isAsLong(int file, std::uint64_t written) {
    struct stat info {};
    return ::fstat(file, &info) != 0 || !S_ISREG(info.st_mode) ||
           static_cast<std::uint64_t>(info.st_size) == written;
}

void appendFromNowOn(int file) {
    const int flags = ::fcntl(file, F_GETFL);
    if (flags >= 0) ::fcntl(file, F_SETFL, flags | O_APPEND);
}

void syncFolderOf(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
    const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    [[maybe_unused]] const int ignored = ::fsync(file);
    ::close(file);
}

std::string writeRefusal(int error) {
    if (error == ENOENT)
        return "was removed, replaced or truncated while it was being written; what was computed is lost";
    return std::string("cannot be written: ") + std::strerror(error);
}

}  // namespace talus::formats
