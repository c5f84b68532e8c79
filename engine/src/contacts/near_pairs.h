#pragma once
// Pairs of convex parts of two blocks that are near each other. Fixed blocks stay where they were built
// (state/fixed_shapes.h): they are not placed again, and only their parts near another part are visited.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "contacts/neighbours.h"
#include "geometry/parts.h"
#include "geometry/world_shape.h"
#include "state/arrays.h"

namespace talus {

/// Pairs of parts, sorted.
using PartPairs = std::vector<BoxPair>;

/// Margin, time and blocks of a search.
struct SearchRange {
    double margin = 0;  ///< pairs of faces nearer than this count [m]
    double ahead = 0;   ///< time until the next look, not negative [s]
    /// By block: pairs of which neither is marked are left out; empty: none is.
    std::vector<char> around{};
    /// By block: 1 for all in a pair that is not left out, and for some others (blocksNear); empty: all are.
    std::vector<char> near{};

    bool has(std::size_t a, std::size_t b) const {
        return around.empty() || around[a] != 0 || around[b] != 0;
    }
    bool isNear(std::size_t block) const { return near.empty() || near[block] != 0; }
};

/// Work of a search: grows with the moving blocks and their neighbours, not with the ground.
struct SearchWork {
    std::size_t placed_faces = 0;  ///< faces of the blocks that were placed
    std::size_t boxes = 0;         ///< boxes of fixed parts that were compared with others
    std::size_t pairs = 0;         ///< pairs of parts whose boxes meet
};

/// Shapes of the blocks of a range where they are now, with their face normals; the faces' outlines are
/// those of the own frame. Refers to the state.
class PlacedShapes {
 public:
    PlacedShapes(const State& state, const SearchRange& range, bool parallel);
    PlacedShapes(const PlacedShapes&) = delete;
    PlacedShapes& operator=(const PlacedShapes&) = delete;

    std::size_t blockOf(std::size_t part) const {
        return static_cast<std::size_t>(geometry_.part_block[part]);
    }
    /// Blocks of the range that do not stand as in Geometry::fixed: placed here.
    bool isPlaced(std::size_t block) const { return placed_[block] != 0; }
    std::size_t placedFaces() const { return normals_.size(); }

    /// \param body  of the part; refers to it. \pre its block is of the range
    WorldShape world(std::size_t part, const std::optional<PartOfBody>& body) const;
    /// Without what tells inner edges from those of the body.
    std::span<const Vec3> vertices(std::size_t part) const;
    /// Whether a sphere is farther than `distance` beyond some face of the part, by more than rounding.
    bool isBeyondFace(std::size_t part, const Vec3& centre, double radius, double distance) const;

 private:
    WorldShape whole(std::size_t block) const;

    const Geometry& geometry_;
    std::vector<char> placed_;                              ///< by block
    std::vector<std::size_t> first_vertex_, first_normal_;  ///< of each block that is placed
    std::vector<Vec3> vertices_, normals_;
};

/// Pairs of parts of the range whose boxes, each wider by half its margin, meet, in order. Pairs of two fixed
/// blocks in place are left out.
PartPairs nearPairs(const State& state, const PlacedShapes& placed, const SearchRange& range, bool parallel,
                    SearchWork& work);

/// Leaves out pairs of a fixed part and a block whose bounding sphere is farther than the margin beyond one
/// of the part's faces. The parts of a terrain are long, so boxes alone give some 40 of them for each rock.
void dropBeyondFaces(const State& state, const PlacedShapes& placed, double margin, PartPairs& pairs);

}  // namespace talus
