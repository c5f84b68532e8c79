#pragma once
// The walls that water wets: polygons fixed to their blocks, out of the model's waters.

#include <vector>

#include "geometry/polygon.h"
#include "state/arrays.h"
#include "talus/result.h"

namespace talus {

/// Which walls tell where a water's joint ends (Water::ends_at_free_blocks): those on blocks that are not
/// fixed, if there are any; else all.
class EndWalls {
 public:
    EndWalls(const Geometry& geometry, const Water& water);
    bool counts(std::int32_t block) const { return !only_moving_ || moves(block); }
    /// Whether some wall does not count.
    bool leavesOut() const { return only_moving_; }

 private:
    bool moves(std::int32_t block) const;

    const Geometry& geometry_;
    bool only_moving_ = false;
};

/// Makes the walls of all waters. Reads the model and the interfaces; writes wet, pressure, water_load and
/// what finishWalls does.
void makeWalls(State& state);

/// What follows from the walls: their moments, and which of them push on which block. Reads wet, writes that
/// and its part of incidence.
void finishWalls(State& state);

/// Waters that no wall bounds.
std::vector<Error> dryErrors(const State& state);

/// A wall in its own plane.
Polygon wetPolygon(const WetPatches& wet, std::size_t wall);

}  // namespace talus
