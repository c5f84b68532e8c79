#pragma once
// Time that tests may ask about: a busy machine does not change it.

#include <ctime>

namespace talus::test {

/// Computed so far by this process [s].
inline double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace talus::test
