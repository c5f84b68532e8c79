#pragma once
// The paper's dry slope as every peer gets it, and the search for its critical angle.
//
// A probe starts from rest on a level floor, settles, is tilted by turning gravity, and is watched. It fails
// when it speeds up: impulse engines creep on slopes that stand, so that a plain limit of the displacement
// would say more about the limit than about the slope. Bisection narrows the bracket.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace peers {

inline constexpr int kColumns = 7, kRows = 5, kSlices = 3, kBlocks = kColumns * kRows * kSlices;
inline constexpr double kSize[3] = {0.2, 0.1, 0.1};  // [m] x (uphill), y, z
inline constexpr double kDensity = 2700, kGravity = 9.81, kFriction = 19.5 * M_PI / 180;
inline constexpr double kSettle = 0.2, kTilt = 0.5, kWatch = 1.0;  // [s]
// Farthest block in the second half of the watch: more than kFaster times the first half's way (steady creep
// makes 1, a fall from rest 3) and kLeast beyond it (0.05 deg too steep make 2 mm), or kGone anyway. [m]
inline constexpr double kFaster = 1.5, kLeast = 5e-4, kGone = 0.02;
inline constexpr double kLow = 10, kHigh = 30;  // [deg]

/// Centre of a block; blocks are numbered slice by slice, row by row, column by column.
inline void centreOf(int block, double centre[3]) {
    const int place[3] = {block / (kRows * kSlices), block % kSlices, block / kSlices % kRows};
    for (int k = 0; k < 3; ++k) centre[k] = (place[k] + 0.5) * kSize[k];
}

inline double processorSeconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Settings {
    double time_step = 1e-3;  // [s]
    int iterations = 50;      // of the solver
    double bracket = 0.1;     // [deg]
};

/// World: World(Settings), setGravity(x, z) [m/s^2], step(), position(block, double[3]) [m].
template <class World>
bool fails(const Settings& settings, double tilt_deg, long& steps) {
    World world(settings);
    const auto run = [&](double seconds, double from_deg, double to_deg) {
        const long n = std::lround(seconds / settings.time_step);
        for (long k = 1; k <= n; ++k) {
            const double tilt =
                (from_deg + (to_deg - from_deg) * static_cast<double>(k) / static_cast<double>(n)) * M_PI /
                180;
            world.setGravity(-kGravity * std::sin(tilt), -kGravity * std::cos(tilt));
            world.step();
        }
        steps += n;
    };
    run(kSettle, 0, 0);
    run(kTilt, 0, tilt_deg);
    const auto watched = [&] {
        double before[kBlocks][3], now[3], farthest = 0;
        for (int b = 0; b < kBlocks; ++b) world.position(b, before[b]);
        run(0.5 * kWatch, tilt_deg, tilt_deg);
        for (int b = 0; b < kBlocks; ++b) {
            world.position(b, now);
            farthest = std::fmax(
                farthest, std::hypot(now[0] - before[b][0], now[1] - before[b][1], now[2] - before[b][2]));
        }
        return farthest;
    };
    const double first = watched(), second = watched();
    return !(second < kGone && second < kFaster * first + kLeast);
}

/// Prints one JSON object.
template <class World>
int search(const char* engine, int argc, char** argv) {
    Settings settings;
    for (int k = 1; k + 1 < argc; k += 2) {
        const double value = std::atof(argv[k + 1]);
        if (!std::strcmp(argv[k], "--time-step")) settings.time_step = value;
        if (!std::strcmp(argv[k], "--iterations")) settings.iterations = static_cast<int>(value);
        if (!std::strcmp(argv[k], "--bracket")) settings.bracket = value;
    }
    if (!(settings.time_step > 0) || settings.iterations < 1 || !(settings.bracket > 0)) {
        std::fprintf(stderr, "usage: %s [--time-step S] [--iterations N] [--bracket DEG]\n", argv[0]);
        return 2;
    }
    const double start = processorSeconds();
    double low = kLow, high = kHigh;
    long steps = 0;
    int probes = 0;
    while (high - low > settings.bracket) {
        const double middle = 0.5 * (low + high);
        (fails<World>(settings, middle, steps) ? high : low) = middle;
        ++probes;
    }
    const double seconds = processorSeconds() - start;
    std::printf(
        "{\"engine\": \"%s\", \"time_step_s\": %g, \"iterations\": %d, \"low_deg\": %.4f, \"high_deg\": "
        "%.4f, "
        "\"probes\": %d, \"steps\": %ld, \"cpu_seconds\": %.4f}\n",
        engine, settings.time_step, settings.iterations, low, high, probes, steps, seconds);
    return 0;
}

}  // namespace peers
