#include "process.h"

#include <unistd.h>

#include <chrono>
#include <ctime>
#include <fstream>

namespace talus::bench {
namespace {

/// Value of a line "KEY:   123 kB" [bytes]; 0 when there is none.
double kilobytesIn(const std::string& file, const std::string& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.rfind(key + ":", 0) == 0) return 1024.0 * std::stod(line.substr(key.size() + 1));
    return 0;
}

}  // namespace

double wallSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processSeconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double residentBytes() { return kilobytesIn("/proc/self/status", "VmRSS"); }
double peakBytes() { return kilobytesIn("/proc/self/status", "VmHWM"); }
double availableBytes() { return kilobytesIn("/proc/meminfo", "MemAvailable"); }

void resetPeakMemory() { std::ofstream("/proc/self/clear_refs") << "5"; }

std::string processorName() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

Caches caches() {
    // sysconf(_SC_LEVEL3_CACHE_SIZE) tells the whole package's on some processors, of which a core reaches a
    // part.
    const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index";
    Caches found;
    for (int index = 0; index < 8; ++index) {
        std::ifstream level_file(folder + std::to_string(index) + "/level");
        std::ifstream size_file(folder + std::to_string(index) + "/size");
        int level = 0;
        double kilobytes = 0;
        if (!(level_file >> level) || !(size_file >> kilobytes)) continue;
        if (level == 2) found.level2 = 1024 * kilobytes;
        if (level == 3) found.level3 = 1024 * kilobytes;
    }
    return found;
}

}  // namespace talus::bench
