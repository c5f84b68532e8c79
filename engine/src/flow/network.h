#pragma once
// The mesh of the joint network: linear triangles on the patches where blocks touch. Patches share the nodes
// along their common edges, so that water passes from one joint into another there. flow/meshing.h makes it.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "state/arrays.h"

namespace talus::flow {

/// One polygon of a joint between two blocks.
struct Patch {
    std::int32_t interface = 0, block_a = 0, block_b = 0, joint = 0;
    Vec3 normal = Vec3::UnitZ();  ///< from a to b
};

/// Along one direction.
struct Extent {
    double low = kInfinity, high = -kInfinity;  ///< [m]
    void add(double x) { low = std::min(low, x), high = std::max(high, x); }
    double length() const { return std::max(0.0, high - low); }
};

/// A face of a block, in the state's coordinates: normal . x = offset.
struct RockFace {
    Vec3 normal = Vec3::UnitZ();  ///< out of the rock
    double offset = 0;            ///< [m]
};

using Side = std::pair<std::int32_t, std::int32_t>;  ///< nodes of a side of a triangle, the lower one first

struct Network {
    std::vector<Vec3> nodes;  ///< in the state's coordinates [m]
    std::vector<Patch> patches;
    std::vector<std::vector<RockFace>>
        beside;                ///< of each patch: faces of its blocks that are not in its plane
    std::vector<double> same;  ///< of each patch: distance at which points are the same [m]
    std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise about their patch's normal
    std::vector<std::int32_t> patch_of;                  ///< of each triangle
    /// Of each refinement, the coarsest first: the sides whose middles are its nodes, which follow all earlier
    /// ones. Triangle t of the mesh before it became triangles 4 t to 4 t + 3 (flow/nested.h).
    std::vector<std::vector<Side>> halved;
    double size = 0;  ///< median longest side of a patch [m]
    /// mean extent of a patch along gravity, weighted with itself; of level patches alone their size [m]
    double height = 0;

    const Vec3& corner(std::size_t triangle, std::size_t k) const {
        return nodes[static_cast<std::size_t>(triangles[triangle][k])];
    }
    /// From corner k to the next.
    Side side(std::size_t triangle, std::size_t k) const {
        return std::minmax({triangles[triangle][k], triangles[triangle][(k + 1) % 3]});
    }
    const Patch& patch(std::size_t triangle) const {
        return patches[static_cast<std::size_t>(patch_of[triangle])];
    }
};

/// An edge at which a joint ends without meeting another one.
struct OpenEdge {
    std::size_t triangle = 0;
    std::array<std::int32_t, 2> nodes{};
    Vec3 outward =
        Vec3::Zero();  ///< unit, normal of the rock face that it lies on; else in the joint's plane
};
std::vector<OpenEdge> openEdges(const Network& network);

/// Which connected part of the network each node belongs to, numbered from 0.
std::vector<std::int32_t> connectedParts(const Network& network);

}  // namespace talus::flow
