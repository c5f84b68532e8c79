#pragma once
// Stage "level of closed volumes", at the beginning of "update water": in a time history the level of a water
// that is a closed volume (Water::closed) follows from what its walls enclose, V(L) = V
// (forces/enclosed_volume.h). One volume spans all walls of its fissure. V is that of the level it was filled
// to when the history begins, and changes by
//
//   dV/dt = w (q(t) + C i(t) - q_leak),     q: Water::inflow, w: horizontal width of the fissure
//
// with rain of the intensity i on a catchment C per metre of width, and the leak through the foot
// (forces/leak.h). Its hydraulic aperture is that of the walls as built and what they have parted there
// since. What exceeds V(overflow), or V at the top of the lower of its two sides, runs over and is lost.
// Water in the fissure has no inertia and no viscosity: its table is level at every moment.
//
// Everything else (searches, the way to a history's start) holds the level as filled. Sums run over a
// water's walls in stored order, in one thread: the bits do not depend on threads. Frames keep volume, level
// and time as memory of the force "water", so that a restart goes on in the same bits.

#include <array>
#include <span>
#include <vector>

#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/water_report.h"

namespace talus {

/// Finds the width of closed volumes, which do not count yet. Reads wet, load, geometry; writes closed.
void buildClosedWater(State& state);

/// From now on volumes count: those of the levels filled to, at the present poses.
/// Reads: poses, load; writes: closed
void beginClosedWater(State& state);

/// Brings volumes and levels up to date. Reads: poses, load; writes: closed
void updateClosedWater(State& state);

/// Depth or elevation of a water, as the scenario gives it: of a closed volume that counts the present one,
/// otherwise that of its table over time [m].
double levelNow(const State& state, std::size_t water, double time);

/// Volume below a level at the present poses, opening included [m^3]. \pre a closed volume
double volumeBelow(const State& state, std::size_t water, double level);

/// Of closed volumes that count.
std::vector<WaterReport> closedWaterReports(const State& state);

std::vector<ForceArray> closedWaterMemory(const State& state);
void rememberClosedWater(State& state, std::span<const ForceArray> arrays);

/// What a fissure has to have for a level table to enclose a volume in it, as built.
struct Enclosure {
    double dip = 0;                 ///< of its first wall [rad]
    std::array<double, 2> below{};  ///< walls of either side below a level [m^2]
    double runs_over = 0;           ///< level above which it runs over, as the scenario gives levels [m]
};
Enclosure enclosureOf(const State& state, std::size_t water, double level);

}  // namespace talus
