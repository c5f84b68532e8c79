#pragma once
// Whether an assembly under constant load reaches equilibrium or keeps moving, by observation of explicit
// steps.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::history {

inline constexpr int kStepsPerSample =
    10;  ///< neighbours, patches and the out-of-balance force are looked at this often

/// How an assembly has reached equilibrium or failed.
struct Settling {
    Verdict verdict = Verdict::undecided;
    std::int64_t steps = 0;
    double out_of_balance = 0;  ///< largest out-of-balance force of a block over its weight, at the end
    double displacement = 0;    ///< largest of a block [m]
    std::string reason;         ///< why this verdict
};

/// "WHAT 1.23e-05 of the weight after 4010 steps".
std::string describe(const char* what, double out_of_balance, std::int64_t steps);

/// Watches an assembly under constant load until its verdict is clear.
class Watch {
 public:
    /// \param limit in equilibrium below this share of the weight
    /// \param steps_per_period  of the slowest period
    /// \param periods  in a window
    Watch(const State& state, double limit, int steps_per_period, double periods);

    /// Looks once more; true when the verdict in `settling` is final.
    bool look(const State& state, Settling& settling);

 private:
    /// The out-of-balance force over a window of time.
    struct Window {
        double sum = 0, least = kInfinity, most = 0;
        double motion = 0;  ///< of the farthest-moved block [m]
        int samples = 0;

        void add(double ratio);
        double mean() const { return sum / samples; }
    };

    bool closeWindow(const State& state, Settling& settling);
    /// A noisy plateau, seen over a longer time.
    bool closeSpan(Settling& settling, double motion);
    static bool fails(Settling& settling, const Window& seen);

    double limit_;
    int steps_per_period_, samples_per_window_;
    int quiet_steps_ = 0, windows_ = 0, level_windows_ = 0;
    Window window_{}, last_window_{}, span_{}, last_span_{};
    double last_motion_ = 0, last_span_motion_ = 0;
    PositionArray position_;
    QuaternionArray orientation_;
};

/// Tunes the drag to the present motion: Rayleigh's quotient of the displacement since the last look and its
/// resisting force, omega^2 = -(dF . du) / (du . M du) (Underwood 1983). Where columns lean on each other a
/// mode can be many times slower than the estimate, and would creep under a drag meant for a faster one.
class DragTuner {
 public:
    explicit DragTuner(const State& state) { remember(state); }

    /// \param ratio  of the drag over the critical one
    /// \param slow_period of the slowest mode known: slower ones are accepted up to a multiple of it [s]
    void tune(State& state, double ratio, double slow_period);

    /// Drag at a share of what is critical for a mode of this period: c = 2 ratio omega.
    static void setDrag(State& state, double ratio, double period);

 private:
    void remember(const State& state);

    PositionArray position_{};
    std::vector<Vec3> force_{};
};

/// State at the beginning of the observation.
struct SettlingStart {
    PositionArray position;
    QuaternionArray orientation;
    std::vector<Vec3> load;  ///< on each block [N]
    double reach;            ///< of the bolts [m]
};

/// An observed motion under constant load.
struct Watched {
    SettlingStart start;
    Watch watch;
    DragTuner tuner;
    std::int64_t steps_since_tuning = 0;
};

}  // namespace talus::history
