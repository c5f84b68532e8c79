#pragma once
// Threads, interruption, progress and extras of a computation.

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace talus {

/// How far a long computation has come; called now and then from the computing thread.
struct Progress {
    std::string stage;    ///< "loading", "probe 7", "run", ...
    double fraction = 0;  ///< of the whole, 0..1 (an estimate)
    std::string detail;   ///< one line for people: "tilt 19.53 deg, failing"
};

/// Whether something is computed beside an answer: by the size of the model, never, or always.
enum class Beside : std::uint8_t { by_size, never, always };

/// Threads, interruption and extras of a computation. Threads: 1 is the calling thread alone; 0 is all cores.
struct Control {
    std::function<void(const Progress&)> progress{};
    const std::atomic<bool>* stop = nullptr;  ///< set it to end early; what was found so far is returned
    int threads = 1;
    bool keep_failing_state = false;       ///< a search also returns SearchResult::failing
    int groups = 1;                        ///< most groups of SearchResult::groups
    bool interval = true;                  ///< look for lower answers, too (SearchResult::answer_interval)
    Beside upper_bound = Beside::by_size;  ///< of limit analysis (SearchResult::upper_bound)
};

}  // namespace talus
