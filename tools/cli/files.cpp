// Files are written whole or not at all.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/outputs.h"

namespace talus::tools {

namespace {

bool isDeviceOrPipe(const std::string& path) {
    struct stat info {};
    return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

bool isStopped(const std::atomic<bool>* stop) {
    return stop != nullptr && stop->load(std::memory_order_relaxed);
}

/// Flushes it to the disk, too, so that the last piece need not wait for all before it. 0, or the errno of
/// the refusal; ECANCELED when stopped. Closes the file in any case.
int writeAndClose(int file, std::string_view content, const std::atomic<bool>* stop = nullptr) {
    constexpr std::size_t kPiece = std::size_t{1} << 24;
    const std::size_t size = content.size();
    int error = 0;
    while (!content.empty() && error == 0) {
        const ssize_t written = ::write(file, content.data(), std::min(content.size(), kPiece));
        if (written >= 0) {
            content.remove_prefix(static_cast<std::size_t>(written));
            if (stop != nullptr && content.size() > kPiece) ::fdatasync(file);
        } else if (errno != EINTR) {
            error = errno;
        }
        if (error == 0 && isStopped(stop)) error = ECANCELED;
    }
    if (error == 0 && ::fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP) error = errno;
    if (error == 0 && !formats::isAsLong(file, size)) error = ENOENT;
    if (::close(file) != 0 && error == 0) error = errno;
    return error;
}

/// Path of the temporary file: beside the target, new, and no link.
int openTemporary(const std::string& path, std::string& temporary) {
    for (int attempt = 0;; ++attempt) {
        temporary = path + ".part" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
        const int file =
            ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file >= 0 || errno != EEXIST || attempt == 100) return file;
    }
}

/// A link stays a link: its target is written.
std::string behindLinks(const std::string& path) {
    std::error_code absent;
    const std::filesystem::path there = std::filesystem::canonical(path, absent);
    return absent ? path : there.string();
}

void writeInPlace(const std::string& path, std::string_view content) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) throw FileRefused(path, "cannot be opened for writing", errno);
    if (const int error = writeAndClose(file, content); error != 0)
        throw FileRefused(path + ": " + formats::writeRefusal(error));
}

}  // namespace

bool writeFile(const std::string& path, std::string_view content, const std::atomic<bool>* stop) {
    refuseInput("", path);
    if (isDeviceOrPipe(path)) {
        writeInPlace(path, content);
        return true;
    }
    const std::string target = behindLinks(path);
    std::string temporary;
    const int file = openTemporary(target, temporary);
    if (file < 0) throw FileRefused(path, "cannot be opened for writing", errno);
    int error = writeAndClose(file, content, stop);
    if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error == 0) {
        formats::syncFolderOf(target);
        return true;
    }
    ::unlink(temporary.c_str());
    if (error == ECANCELED) return false;
    throw FileRefused(path + ": " + formats::writeRefusal(error));
}

void refuseUnwritable(const std::string& path) {
    // Opening and closing a pipe would end it for its reader.
    if (isDeviceOrPipe(path)) {
        if (::access(path.c_str(), W_OK) != 0) throw FileRefused(path, "cannot be opened for writing", errno);
        return;
    }
    const std::string target = behindLinks(path);
    if (std::error_code absent; std::filesystem::is_directory(target, absent))
        throw FileRefused(path, "cannot be opened for writing", EISDIR);
    std::string temporary;
    const int file = openTemporary(target, temporary);
    if (file < 0) throw FileRefused(path, "cannot be opened for writing", errno);
    ::close(file);
    ::unlink(temporary.c_str());
}

void refuseOutput(const std::string& option, const std::string& path, std::string_view ending) {
    if (path.empty()) return;
    requireEnding(option, path, {ending});
    refuseInput(option, path);
    refuseUnwritable(path);
}

void makeFolder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw FileRefused(path, "cannot be made", error.value());
}

}  // namespace talus::tools
