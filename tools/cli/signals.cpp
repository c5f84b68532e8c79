// SIGINT and SIGTERM ask the computation to end; what it has found so far is then printed.

#include <csignal>
#include <ctime>

#include "cli/signals.h"

namespace talus::tools {

namespace {

std::atomic<bool> stop_flag{false};
std::atomic<std::int64_t> first_signal_seconds{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t secondsNow() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec;
}

/// One request may arrive as two signals (timeout and shells also signal the process group), so only one that comes
/// clearly later means "now".
void onStopSignal(int signal_number) {
    constexpr std::int64_t kPatience = 2;  // [s]
    if (!stop_flag.exchange(true)) {
        first_signal_seconds = secondsNow();
    } else if (secondsNow() - first_signal_seconds > kPatience) {
        std::signal(signal_number, SIG_DFL);
        std::raise(signal_number);
    }
}

}  // namespace

void catchStopSignals() {
    struct sigaction action {};
    action.sa_handler = onStopSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& stopRequested() { return stop_flag; }

void requestStop() { stop_flag = true; }

}  // namespace talus::tools
