#pragma once
// Progress on stderr.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/common.h"
#include "talus/analysis.h"

namespace talus::tools {

/// Meaning of a progress fraction: of time, which gives the time left, or of steps of unknown duration, such
/// as the probes of a search.
enum class Fraction : std::uint8_t { of_time, of_steps };

/// Time left of a stage whose fraction grows with time, by its speed over the later half of the record, so
/// that a change of speed counts. Nothing while the record is too short.
class TimeLeft {
 public:
    /// \param seconds  since anything; must not fall
    std::optional<double> after(double seconds, double fraction);
    void forget() { seen_.clear(); }

 private:
    struct Seen {
        double seconds, fraction;
    };
    std::vector<Seen> seen_;
};

/// "[####......] 12% run 0:14 elapsed, about 1:40 left t = 0.1 s", in the available columns: first the detail
/// is cut, then the bar is dropped, then the stage. `left` is NaN when unknown.
std::string progressLine(const Progress& progress, double elapsed, double left, std::size_t columns);

/// A bar when stderr is a terminal, occasional plain lines when it is not, nothing with --quiet. The clock
/// continues while nothing is reported.
class ProgressPrinter {
 public:
    explicit ProgressPrinter(const Common& common, Fraction fraction = Fraction::of_steps);
    ~ProgressPrinter() { finish(); }
    ProgressPrinter(const ProgressPrinter&) = delete;
    ProgressPrinter& operator=(const ProgressPrinter&) = delete;

    void show(const Progress& progress);
    void finish();  ///< wipes the bar; safe to call twice

    /// For Control::progress; the printer must outlive it.
    std::function<void(const Progress&)> callback();

 private:
    using Clock = std::chrono::steady_clock;
    void tick();
    void print(Clock::time_point now);  ///< \pre mutex_ is held

    Fraction fraction_ = Fraction::of_steps;
    bool quiet_ = false, terminal_ = false, bar_shown_ = false, ended_ = false;
    Progress latest_{};
    double left_ = 0;  ///< [s], NaN when not known
    TimeLeft time_left_;
    Clock::time_point start_, last_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread clock_;
};

/// Progress, stop flag and threads, as the engine takes them.
Control controlOf(const Common& common, ProgressPrinter& progress);

}  // namespace talus::tools
