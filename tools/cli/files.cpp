// Files are written whole or not at all.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "cli/failures.h"
#include "cli/files.h"

namespace talus::tools {

namespace {

bool isDeviceOrPipe(const std::string& path) {
    struct stat info {};
    return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/// 0, or the errno of what was refused. Closes the file in any case.
int writeAndClose(int file, std::string_view content) {
    int error = 0;
    while (!content.empty() && error == 0) {
        const ssize_t written = ::write(file, content.data(), content.size());
        if (written >= 0) {
            content.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            error = errno;
        }
    }
    if (::close(file) != 0 && error == 0) error = errno;
    return error;
}

int openFor(const std::string& path, const std::string& named) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) throw FileRefused(named, "cannot be opened for writing", errno);
    return file;
}

}  // namespace

void writeFile(const std::string& path, std::string_view content) {
    const bool in_place = isDeviceOrPipe(path);
    const std::string temporary = in_place ? path : path + ".part" + std::to_string(::getpid());
    int error = writeAndClose(openFor(temporary, path), content);
    if (error == 0 && !in_place && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
    if (error == 0) return;
    if (!in_place) ::unlink(temporary.c_str());
    throw FileRefused(path, "cannot be written", error);
}

void makeFolder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw FileRefused(path, "cannot be made", error.value());
}

}  // namespace talus::tools
