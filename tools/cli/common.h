#pragma once
// Options of every subcommand, and messages on stderr.

#include <string>

namespace talus::tools {

inline constexpr int kMostThreads = 1024;  ///< a larger number is a typing error

/// Options every computing subcommand takes.
struct Common {
    bool json = false;   ///< one JSON object on stdout
    bool quiet = false;  ///< no progress and no notes on stderr
    int threads = 0;     ///< 0: all cores
};

int threadsUsed(const Common& common);

/// A line on stderr ("warning: ..."); nothing with --quiet.
void note(const Common& common, const std::string& line);

}  // namespace talus::tools
