#pragma once
// Slopes built in code, and the state that the benchmarks run on.

#include <cstdint>
#include <string>

#include "state/arrays.h"
#include "talus/model.h"

namespace talus::bench {

/// What is in the joints of a slope beside friction.
enum class Filling { plain, water, cohesion, mixed, rough };
const char* toString(Filling filling);

struct SlopeKind {
    int blocks = 105;  ///< one of kSizes
    PointRule points;
    Filling filling = Filling::plain;

    std::string name() const;  ///< "vertex/105", "vertex+water/105"
};

inline constexpr int kSizes[] = {105, 1000, 10000, 100000, 1000000};

/// Columns x rows x slices of blocks of 0.2 x 0.1 x 0.1 m on a floor at 15 deg, granite with the paper's
/// joints (its slope itself for 105). \pre kind.blocks is one of kSizes
Model makeSlope(const SlopeKind& kind);

/// What a step or a stage changes in a state, but for what each step makes anew.
struct Moved {
    Blocks blocks;
    ContactPoints points;
};

/// A slope under its weight, with what making it cost.
struct Slope {
    SlopeKind kind;
    State state;
    Moved start;               ///< the state's moving part, from which every benchmark starts
    double time_step = 0;      ///< [s]
    double model_seconds = 0;  ///< wall time for the Model
    double build_seconds = 0;  ///< wall time for the State, all cores
    double build_cpu = 0;      ///< processor time for the State
    double state_bytes = 0;    ///< resident memory that the State holds, the Model given back
    double peak_bytes = 0;     ///< largest resident memory of the process while Model and State were made

    std::size_t points() const { return state.points.size(); }
    std::size_t interfaces() const { return state.interfaces.size(); }
    std::size_t blocks() const { return state.blocks.size(); }
};

Slope buildSlope(const SlopeKind& kind);

/// The last slope asked for, as it was made: benchmarks run in the order of their slopes, and a big one fits
/// only once.
Slope& slopeFor(const SlopeKind& kind);

}  // namespace talus::bench
