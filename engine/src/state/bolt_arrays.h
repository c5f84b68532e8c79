#pragma once
// Bolts in the state: a segment is where one ties two blocks; its memory is its plastic displacement.

#include <cstdint>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

/// Properties of one segment (forces/bolt_law.h).
struct BoltLaw {
    double stiffness = 0;        ///< axial [N/m]
    double rigidity = 0;         ///< E A [N]
    double pretension = 0;       ///< [N]
    double yield = 0;            ///< of the bar [N]
    double bond = 0;             ///< of the weaker embedded side, beyond the pretension [N]
    double rupture_strain = 0;   ///< may be infinite
    double dowel_stiffness = 0;  ///< across the bolt [N/m]
    double dowel_strength = 0;   ///< [N]
};

/// Memory of a segment.
struct BoltMemory {
    double yielded = 0;         ///< elongation of the bar that stays [m]
    double slipped = 0;         ///< of the bar through its grout [m]
    Vec3 dowel = Vec3::Zero();  ///< displacement across the bolt that stays, in a's own frame [m]
    bool broken = false;
};

/// Where a bolt ties block a to block b. Follows from the model as it is built.
struct BoltSegment {
    std::int32_t bolt = 0;  ///< of the model's
    std::int32_t block_a = 0, block_b = 0;
    Vec3 at_a = Vec3::Zero(), at_b = Vec3::Zero();  ///< its ends, in the blocks' own frames [m]
    /// grouted: along the bolt from a to b, in a's own frame; zero: free between its ends, along which it
    /// pulls
    Vec3 axis = Vec3::Zero();
    double length = 0;  ///< between its ends at the start [m]
    BoltLaw law;
};

struct Bolts {
    std::vector<BoltSegment> segments;
    std::vector<BoltMemory> memory;  ///< of each segment
    std::vector<Vec3> force, place;  ///< on b, and where, as last brought up to date [N, m]

    std::size_t size() const { return segments.size(); }
};

}  // namespace talus
