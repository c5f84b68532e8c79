#pragma once
// SIGINT and SIGTERM, and SIGXFSZ, which is ignored.

#include <atomic>
#include <string>
#include <utility>

namespace talus::tools {

/// A file that may grow no further (ulimit -f) is then refused like one on a full disk, and does not end the
/// process.
void ignoreFileSizeSignal();

/// Lets SIGINT and SIGTERM set the flag below instead of ending the process; a second one ends it at once.
void catchStopSignals();

/// True once the user asked to stop. Pass its address as Control::stop.
const std::atomic<bool>& stopRequested();

/// Ends a computation from within one of its callbacks (an output file can no longer be written).
void requestStop();

/// During its life a signal ends the process at once, with 130 and this message; so does an earlier signal.
/// For work without useful partial results that cannot check the flag, such as parsing a large file. The last
/// one made counts.
class EndsAtOnce {
 public:
    EndsAtOnce(std::string on_stdout, std::string on_stderr);
    EndsAtOnce(const EndsAtOnce&) = delete;
    EndsAtOnce& operator=(const EndsAtOnce&) = delete;
    ~EndsAtOnce();

 private:
    std::pair<std::string, std::string> words_;
    const std::pair<std::string, std::string>* before_;
};

}  // namespace talus::tools
