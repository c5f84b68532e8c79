#pragma once
// Shapes of blocks, and of their convex parts, where they are now.

#include <optional>
#include <utility>
#include <vector>

#include "geometry/parts.h"
#include "geometry/world_shape.h"
#include "state/arrays.h"

namespace talus {

/// A block's shape in the model frame, where it is now.
Polyhedron placedShape(const State& state, std::size_t block);

/// The same into an existing shape, so that blocks in turn need no new memory.
void placeShape(const State& state, std::size_t block, Polyhedron& shape);

/// Places the fixed blocks.
/// \pre the geometry's shapes and parts are those of these blocks, where the model has them
FixedShapes placeFixed(const Blocks& blocks, const Geometry& geometry);

/// Whether a block stands where Geometry::fixed has it. (A frame from a file may have it elsewhere.)
bool standsAsBuilt(const State& state, std::size_t block);

/// A point of the model frame in a block's own.
Vec3 toOwn(const Blocks& blocks, std::int32_t block, const Vec3& x);

/// The convex part that a block's face belongs to, by its number among all (Geometry::first_part).
std::int32_t partOf(const Geometry& geometry, std::int32_t block, std::int32_t face);

/// The number of a part's first face in its block.
std::int32_t firstFace(const Geometry& geometry, std::int32_t part);

/// The two parts that an interface is between, the lower number first.
std::pair<std::int32_t, std::int32_t> partsOf(const Geometry& geometry, const Interfaces& interfaces,
                                              std::size_t interface);

/// Nothing for the only part of a block, unless it is fixed and touches other fixed blocks, which form one
/// body (FixedShapes::together).
std::optional<PartOfBody> partOfBody(const State& state, std::int32_t part);

/// A convex part where it is now, with its face normals.
class PlacedPart {
 public:
    PlacedPart(const State& state, std::int32_t part);

    /// Refers to this object.
    WorldShape world() const;
    std::int32_t firstFace() const { return first_face_; }

 private:
    const FaceList* faces_;
    std::span<const Cover> covers_;
    std::span<const PartEdge> edges_;
    std::optional<PartOfBody> body_;
    std::int32_t first_face_;
    std::vector<Vec3> vertices_, normals_;
};

}  // namespace talus
