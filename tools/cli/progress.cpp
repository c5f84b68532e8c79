// Progress and notes on stderr.

#include "cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "cli/signals.h"
#include "cli/terminal.h"

namespace talus::tools {

namespace {

using std::chrono::duration;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kBarInterval = 0.1, kLineInterval = 5.0;  // between two reports that are shown [s]
constexpr double kBarTick = 1.0, kLineTick = 60.0;         // ... and at the latest, without any [s]
constexpr std::size_t kBarWidth = 24, kLeastDetail = 12;
constexpr double kLeastSeconds = 2.0, kLeastFraction = 0.02;  // recorded before a time is shown

std::string clockText(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    const auto two = [](long value) { return (value < 10 ? "0" : "") + std::to_string(value); };
    if (whole < 3600) return std::to_string(whole / 60) + ":" + two(whole % 60);
    return std::to_string(whole / 3600) + ":" + two(whole / 60 % 60) + ":" + two(whole % 60);
}

std::string times(double elapsed, double left) {
    return clockText(elapsed) + " elapsed" +
           (std::isfinite(left) ? ", about " + clockText(left) + " left" : "");
}

std::string percentage(double fraction) { return std::to_string(static_cast<int>(100 * fraction)) + "%"; }

std::string bar(double fraction) {
    const auto filled = static_cast<std::size_t>(std::lround(fraction * static_cast<double>(kBarWidth)));
    return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] ";
}

std::string cut(const std::string& text, std::size_t room) { return text.substr(0, room); }

/// The comma-separated parts of a detail that fit; of the first part, the words that fit.
std::string wholeParts(const std::string& detail, std::size_t room) {
    if (detail.size() <= room) return detail;
    for (const char* end : {", ", " "})
        if (const std::size_t at = detail.rfind(end, room); at != std::string::npos) return cut(detail, at);
    return "";
}

/// Lines of a log have no width.
std::string logLine(const Progress& progress, double elapsed, double left) {
    return percentage(progress.fraction) + " " + progress.stage + ", " + times(elapsed, left) +
           (progress.detail.empty() ? "" : ": ") + progress.detail;
}

}  // namespace

std::optional<double> TimeLeft::after(double seconds, double fraction) {
    constexpr std::size_t kMostSeen = 128;
    if (!seen_.empty() && fraction < seen_.back().fraction) seen_.clear();
    seen_.push_back({seconds, fraction});
    if (seen_.size() > kMostSeen) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < seen_.size(); i += 2) seen_[kept++] = seen_[i];
        seen_.resize(kept);
        seen_.push_back({seconds, fraction});
    }
    const double middle = 0.5 * (seen_.front().seconds + seconds);
    const auto from =
        std::find_if(seen_.rbegin(), seen_.rend(), [&](const Seen& seen) { return seen.seconds <= middle; });
    const double gone = fraction - from->fraction;
    if (seconds - seen_.front().seconds < kLeastSeconds ||
        !(fraction - seen_.front().fraction > kLeastFraction) || !(gone > 0))
        return std::nullopt;
    return (1 - fraction) / gone * (seconds - from->seconds);
}

std::string progressLine(const Progress& progress, double elapsed, double left, std::size_t columns) {
    const std::string numbers = percentage(progress.fraction) + " " + progress.stage;
    const std::string clocks = "  " + times(elapsed, left);
    const std::string plain = numbers + clocks;
    if (plain.size() > columns) return cut(percentage(progress.fraction) + clocks, columns);
    const std::size_t room = columns - plain.size();
    const bool has_bar = room >= kBarWidth + 3;
    const std::size_t for_detail = has_bar ? room - (kBarWidth + 3) : room;
    const std::string detail =
        for_detail < kLeastDetail + 2 ? "" : wholeParts(progress.detail, for_detail - 2);
    return (has_bar ? bar(progress.fraction) : "") + plain + (detail.empty() ? "" : "  ") + detail;
}

ProgressPrinter::ProgressPrinter(const Common& common, Fraction fraction)
    : fraction_(fraction),
      quiet_(common.quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      left_(kUnknown),
      start_(Clock::now()),
      last_(start_) {}

void ProgressPrinter::show(const Progress& progress) {
    if (quiet_) return;
    const auto now = Clock::now();
    const std::lock_guard lock(mutex_);
    const bool new_stage = progress.stage != latest_.stage;
    const bool news = new_stage || progress.detail != latest_.detail;
    latest_ = progress;
    latest_.fraction = std::isfinite(latest_.fraction) ? std::clamp(latest_.fraction, 0.0, 1.0) : 0.0;
    if (new_stage) time_left_.forget();
    const double since = duration<double>(now - last_).count();
    // A terminal shows every new stage at once; lines in a log only appear now and then.
    if (since < (terminal_ ? kBarInterval : kLineInterval) && !(terminal_ && new_stage)) return;
    const double elapsed = duration<double>(now - start_).count();
    left_ = fraction_ == Fraction::of_time ? time_left_.after(elapsed, latest_.fraction).value_or(kUnknown)
                                           : kUnknown;
    if (news || terminal_) print(now);
    if (!clock_.joinable() && !ended_) clock_ = std::thread([this] { tick(); });
}

/// The report is at most a second old, in a log a minute.
void ProgressPrinter::tick() {
    const duration<double> interval(terminal_ ? kBarTick : kLineTick);
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, interval, [this] { return ended_; })) {
        const auto now = Clock::now();
        const duration<double> since = now - last_;
        if (since < interval) continue;
        if (std::isfinite(left_)) left_ = std::max(0.0, left_ - since.count());
        print(now);
    }
}

void ProgressPrinter::print(Clock::time_point now) {
    last_ = now;
    const double elapsed = duration<double>(now - start_).count();
    if (!terminal_) {
        std::fprintf(stderr, "%s\n", logLine(latest_, elapsed, left_).c_str());
        return;
    }
    const std::string line = progressLine(latest_, elapsed, left_, columnsOf(STDERR_FILENO, 80) - 1);
    std::fprintf(stderr, "\r\x1b[2K%s", line.c_str());
    std::fflush(stderr);
    bar_shown_ = true;
}

void ProgressPrinter::finish() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        if (std::exchange(bar_shown_, false)) std::fputs("\r\x1b[2K", stderr);
    }
    wake_.notify_all();
    if (clock_.joinable()) clock_.join();
}

std::function<void(const Progress&)> ProgressPrinter::callback() {
    return [this](const Progress& progress) { show(progress); };
}

Control controlOf(const Common& common, ProgressPrinter& progress) {
    return {progress.callback(), &stopRequested(), common.threads};
}

void note(const Common& common, const std::string& line) {
    if (common.quiet) return;
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::fprintf(stderr, "%s\n", (terminal ? fitted(line, columnsOf(STDERR_FILENO, 80)) : line).c_str());
}

}  // namespace talus::tools
