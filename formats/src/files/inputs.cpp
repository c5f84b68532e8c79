#include "talus/formats/inputs.h"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace talus::formats {

namespace {

/// Device and inode: they identify a file under all its names, as long as it exists. A new file may get the
/// inode of a removed one. Its time of birth differs or, in the same tick of the clock, its generation.
using Identity = std::pair<std::uint64_t, std::uint64_t>;

struct Found {
    Identity identity;
    std::optional<std::pair<std::int64_t, std::uint32_t>> born;  ///< [s, ns]; not every file system knows
};

/// An input as it was read.
struct Input {
    Found file;
    std::optional<int> generation;
    std::vector<std::string> paths;  ///< absolute
};

struct Inputs {
    std::mutex mutex;
    std::map<Identity, Input> files;
};

Inputs& inputs() {
    static Inputs all;
    return all;
}

std::optional<Found> find(const std::string& path) {
    struct statx info {};
    if (::statx(AT_FDCWD, path.c_str(), 0, STATX_TYPE | STATX_INO | STATX_BTIME, &info) != 0 ||
        !S_ISREG(info.stx_mode))
        return std::nullopt;
    Found found{{std::uint64_t{info.stx_dev_major} << 32 | info.stx_dev_minor, info.stx_ino}, {}};
    if ((info.stx_mask & STATX_BTIME) != 0) found.born = {info.stx_btime.tv_sec, info.stx_btime.tv_nsec};
    return found;
}

/// Distinguishes successive files with the same inode; not every file system has it.
std::optional<int> generationOf(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return std::nullopt;
    int generation = 0;
    const bool told = ::ioctl(file, FS_IOC_GETVERSION, &generation) == 0;
    ::close(file);
    if (!told) return std::nullopt;
    return generation;
}

/// Whether a file with the inode of an input is still that file. Without a time of birth, it is as long as
/// one of its names leads there.
bool isStill(const Input& input, const Found& now, const std::string& path) {
    if (input.file.born && now.born) {
        if (*input.file.born != *now.born) return false;
        const std::optional<int> generation = generationOf(path);
        return !input.generation || !generation || *input.generation == *generation;
    }
    return std::any_of(input.paths.begin(), input.paths.end(), [&](const std::string& path) {
        const std::optional<Found> there = find(path);
        return there && there->identity == now.identity;
    });
}

}  // namespace

void rememberInput(const std::string& path) {
    const std::optional<Found> found = find(path);
    if (!found) return;
    std::error_code unknown;
    std::string absolute = std::filesystem::absolute(path, unknown).string();
    const std::lock_guard lock(inputs().mutex);
    Input& input = inputs().files[found->identity];
    if (!isStill(input, *found, path)) input = {*found, generationOf(path), {}};
    if (std::find(input.paths.begin(), input.paths.end(), absolute) == input.paths.end())
        input.paths.push_back(std::move(absolute));
}

bool isInput(const std::string& path) {
    const std::optional<Found> found = find(path);
    if (!found) return false;
    const std::lock_guard lock(inputs().mutex);
    const auto input = inputs().files.find(found->identity);
    return input != inputs().files.end() && isStill(input->second, *found, path);
}

}  // namespace talus::formats
