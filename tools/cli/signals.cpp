// SIGINT and SIGTERM stop the computation; its results so far are then printed.

#include "cli/signals.h"

#include <unistd.h>

#include <csignal>
#include <ctime>
#include <utility>

#include "cli/failures.h"

namespace talus::tools {

namespace {

std::atomic<bool> stop_flag{false};
std::atomic<std::int64_t> first_signal_seconds{0};
std::atomic<const std::pair<std::string, std::string>*> last_words{nullptr};  // stdout, stderr
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t secondsNow() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec;
}

void say(int file, const std::string& text) {
    if (::write(file, text.data(), text.size()) < 0) return;  // nothing is left to report to
}

[[noreturn]] void endWith(const std::pair<std::string, std::string>& words) {
    say(STDOUT_FILENO, words.first);
    say(STDERR_FILENO, words.second);
    ::_exit(kInterrupted);
}

/// One request may arrive as two signals (timeout and shells also signal the process group), so only one that
/// comes clearly later means "now".
void onStopSignal(int signal_number) {
    constexpr std::int64_t kPatience = 2;  // [s]
    if (const auto* words = last_words.load()) endWith(*words);
    if (!stop_flag.exchange(true)) {
        first_signal_seconds = secondsNow();
    } else if (secondsNow() - first_signal_seconds > kPatience) {
        std::signal(signal_number, SIG_DFL);
        std::raise(signal_number);
    }
}

}  // namespace

void ignoreFileSizeSignal() { std::signal(SIGXFSZ, SIG_IGN); }

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

EndsAtOnce::EndsAtOnce(std::string on_stdout, std::string on_stderr)
    : words_(std::move(on_stdout), std::move(on_stderr)), before_(last_words.exchange(&words_)) {
    if (first_signal_seconds != 0) endWith(words_);
}

EndsAtOnce::~EndsAtOnce() { last_words = before_; }

}  // namespace talus::tools
