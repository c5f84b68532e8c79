#pragma once
// Progress on stderr.

#include <chrono>
#include <functional>
#include <string>

#include "cli/common.h"
#include "talus/analysis.h"

namespace talus::tools {

/// A bar when stderr is a terminal, plain lines now and then when it is not, nothing with --quiet.
class ProgressPrinter {
 public:
    explicit ProgressPrinter(const Common& common);
    ~ProgressPrinter() { finish(); }
    ProgressPrinter(const ProgressPrinter&) = delete;
    ProgressPrinter& operator=(const ProgressPrinter&) = delete;

    void show(const Progress& progress);
    void finish();  ///< wipes the bar; safe to call twice

    /// For Control::progress; the printer must outlive it.
    std::function<void(const Progress&)> callback();

 private:
    using Clock = std::chrono::steady_clock;
    void showBar(const Progress& progress, double elapsed);
    void showLine(const Progress& progress, double elapsed);

    bool quiet_ = false, terminal_ = false, bar_shown_ = false;
    std::string stage_;
    Clock::time_point start_, last_;
    double interval_ = 0;  ///< between two outputs [s]
};

/// Progress, stop flag and threads, as the engine takes them.
Control controlOf(const Common& common, ProgressPrinter& progress);

}  // namespace talus::tools
