// Progress and notes on stderr.

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/progress.h"
#include "cli/signals.h"

namespace talus::tools {

namespace {

constexpr double kBarInterval = 0.1;   // [s]
constexpr double kLineInterval = 5.0;  // [s]
constexpr int kBarWidth = 24;

std::string clockText(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    const std::string rest = std::to_string(whole % 60);
    return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

/// " 1:05 elapsed, about 2:10 left"; the second part once the fraction says something.
std::string times(double fraction, double elapsed) {
    const std::string spent = clockText(elapsed) + " elapsed";
    if (!(fraction > 0.01) || elapsed < 1) return spent;
    return spent + ", about " + clockText(elapsed * (1 - fraction) / fraction) + " left";
}

std::size_t terminalWidth() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string percentage(double fraction) { return std::to_string(static_cast<int>(100 * fraction)) + "%"; }

}  // namespace

ProgressPrinter::ProgressPrinter(const Common& common)
    : quiet_(common.quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_),
      interval_(terminal_ ? kBarInterval : kLineInterval) {}

void ProgressPrinter::show(const Progress& progress) {
    if (quiet_) return;
    const auto now = Clock::now();
    const bool due = std::chrono::duration<double>(now - last_).count() >= interval_;
    // A terminal shows every new stage at once; lines in a log only appear now and then.
    if (!due && !(terminal_ && progress.stage != stage_)) return;
    stage_ = progress.stage;
    last_ = now;
    Progress shown = progress;
    shown.fraction = std::isfinite(shown.fraction) ? std::clamp(shown.fraction, 0.0, 1.0) : 0.0;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    terminal_ ? showBar(shown, elapsed) : showLine(shown, elapsed);
}

void ProgressPrinter::showBar(const Progress& progress, double elapsed) {
    const int filled = static_cast<int>(std::lround(progress.fraction * kBarWidth));
    std::string line = "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] " +
                       percentage(progress.fraction) + " " + progress.stage + "  " +
                       times(progress.fraction, elapsed) + "  " + progress.detail;
    line.resize(std::min(line.size(), terminalWidth() - 1));
    std::fprintf(stderr, "\r\x1b[2K%s", line.c_str());
    std::fflush(stderr);
    bar_shown_ = true;
}

void ProgressPrinter::showLine(const Progress& progress, double elapsed) {
    std::fprintf(stderr, "%s %s, %s%s%s\n", percentage(progress.fraction).c_str(), progress.stage.c_str(),
                 times(progress.fraction, elapsed).c_str(), progress.detail.empty() ? "" : ": ",
                 progress.detail.c_str());
}

void ProgressPrinter::finish() {
    if (std::exchange(bar_shown_, false)) std::fputs("\r\x1b[2K", stderr);
}

std::function<void(const Progress&)> ProgressPrinter::callback() {
    return [this](const Progress& progress) { show(progress); };
}

Control controlOf(const Common& common, ProgressPrinter& progress) {
    return {progress.callback(), &stopRequested(), common.threads};
}

void note(const Common& common, const std::string& line) {
    if (!common.quiet) std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace talus::tools
