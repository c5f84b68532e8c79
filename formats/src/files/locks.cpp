#include "talus/formats/locks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cerrno>
#include <fstream>
#include <sstream>

namespace talus::formats {

namespace {

short typeOf(LockMode mode) {
    return mode == LockMode::none ? F_UNLCK : mode == LockMode::shared ? F_RDLCK : F_WRLCK;
}

/// Whether one of the options, which stand between commas, is this one.
bool has(std::string_view options, std::string_view option) {
    while (!options.empty()) {
        const std::size_t end = std::min(options.find(','), options.size());
        if (options.substr(0, end) == option) return true;
        options.remove_prefix(std::min(end + 1, options.size()));
    }
    return false;
}

}  // namespace

int setLock(int file, LockMode mode, LockRange range, bool wait) {
    struct flock lock {};
    lock.l_type = typeOf(mode);
    lock.l_whence = SEEK_SET;
    lock.l_start = static_cast<off_t>(range.first);
    lock.l_len = static_cast<off_t>(range.count);
    while (::fcntl(file, wait ? F_OFD_SETLKW : F_OFD_SETLK, &lock) != 0)
        if (errno != EINTR) return errno;
    return 0;
}

bool lockIsHeld(int error) { return error == EAGAIN || error == EACCES; }

bool noLocksHere(int error) {
    return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP || error == EINVAL;
}

// nfs(5): nolock, local_lock=posix and =all keep fcntl locks on the client. mount.cifs(8): nobrl sends none
// to the server. mount.lustre(8): localflock keeps them on the client, noflock has none. The server of sshfs
// has no locks.
LockReach lockReach(std::string_view kind, std::string_view options) {
    if (kind == "lustre" && has(options, "noflock")) return LockReach::none;
    const bool nfs = kind == "nfs" || kind == "nfs4";
    const bool local = (nfs && (has(options, "nolock") || has(options, "local_lock=posix") ||
                                has(options, "local_lock=all"))) ||
                       (kind == "lustre" && has(options, "localflock")) ||
                       ((kind == "cifs" || kind == "smb3") && has(options, "nobrl")) || kind == "fuse.sshfs";
    return local ? LockReach::this_machine : LockReach::every_machine;
}

LockReach lockReach(int file) {
    struct stat info {};
    if (::fstat(file, &info) != 0) return LockReach::every_machine;
    const std::string device = std::to_string(major(info.st_dev)) + ":" + std::to_string(minor(info.st_dev));
    std::ifstream mounts("/proc/self/mountinfo");
    for (std::string line; std::getline(mounts, line);) {
        std::istringstream words(line);
        std::string id, parent, number, word, kind, source, options;
        words >> id >> parent >> number;
        if (number != device) continue;
        while (words >> word && word != "-") {
        }
        words >> kind >> source >> options;
        return lockReach(kind, options);
    }
    return LockReach::every_machine;
}

std::string lockWarning(LockReach reach) {
    const std::string advice = "make sure that no other process writes there at the same time";
    if (reach == LockReach::none) return "its file system has no locks: " + advice;
    if (reach == LockReach::this_machine)
        return "locks of its network file system do not reach other machines: " + advice;
    return "";
}

}  // namespace talus::formats
