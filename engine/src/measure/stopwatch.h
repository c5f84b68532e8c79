#pragma once
// Wall time, for reports alone: no answer depends on it.

#include <chrono>

namespace talus {

class Stopwatch {
 public:
    /// Since it was made [s].
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

 private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace talus
