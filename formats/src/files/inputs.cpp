#include "talus/formats/inputs.h"

#include <sys/stat.h>

#include <mutex>
#include <set>
#include <utility>

namespace talus::formats {

namespace {

/// Device and number on it: what a file is, under all of its names.
using Identity = std::pair<dev_t, ino_t>;

struct Inputs {
    std::mutex mutex;
    std::set<Identity> files;
};

Inputs& inputs() {
    static Inputs all;
    return all;
}

bool identify(const std::string& path, Identity& identity) {
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return false;
    identity = {info.st_dev, info.st_ino};
    return true;
}

}  // namespace

void rememberInput(const std::string& path) {
    Identity identity;
    if (!identify(path, identity)) return;
    const std::lock_guard lock(inputs().mutex);
    inputs().files.insert(identity);
}

bool isInput(const std::string& path) {
    Identity identity;
    if (!identify(path, identity)) return false;
    const std::lock_guard lock(inputs().mutex);
    return inputs().files.contains(identity);
}

}  // namespace talus::formats
