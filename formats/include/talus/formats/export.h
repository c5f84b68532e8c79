#pragma once
// Frames in formats of other programs, as the bytes of a file: VTK's XML poly data (ParaView 5.11 and VTK 9
// read it), STL, PLY and glTF. Lengths in m, forces in N, everything in the model frame.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "talus/analysis.h"
#include "talus/flow.h"
#include "talus/formats/snapshot.h"

namespace talus::formats {

/// How each block moves: as the search found in a run that it kept; else up to this frame, by the same rule
/// (talus/motion_roles.h).
std::vector<FailureMode> failureRoles(const SnapshotHeader& header, const LightFrame& frame);

/// Vertices of all blocks where they are in a frame, in the header's order [m].
std::vector<Vec3> placedVertices(const SnapshotHeader& header, const LightFrame& frame);

/// Blocks as polygons (.vtp). Cell data: block_id, motion, failure_role (0 none, 1 sliding, 2 toppling),
/// displacement, velocity, rotation (axis times angle, rad).
std::string vtpBlocks(const SnapshotHeader& header, const LightFrame& frame);

/// Contact points as vertices (.vtp). Point data: force (on block b), normal_force, shear_force, water_force,
/// area, state (0 open, 1 sticking, 2 slipping), mobilised_friction, interface, block_a, block_b.
std::string vtpContacts(const FullFrame& full);

/// Joints with their water as triangles (.vtp). Point data: head (nan where no head reaches), pressure,
/// inflow. Cell data: discharge (per width of the joint), wet_share, aperture, joint, block_a, block_b.
std::string vtpFlow(const SteadyFlow& flow);

/// Times and files of a series (.pvd).
std::string pvdSeries(const std::vector<std::pair<double, std::string>>& files);

/// Binary STL of all blocks, faces as fans of triangles.
std::string stlBlocks(const SnapshotHeader& header, const LightFrame& frame);

/// Binary PLY of all blocks: their faces as polygons, each with `block`, `failure_role` and a colour.
std::string plyBlocks(const SnapshotHeader& header, const LightFrame& frame);

/// Polygons with numbers and a colour each: a map.
struct PolygonMap {
    std::vector<Vec3> vertices;                                         ///< [m]
    std::vector<std::vector<std::int32_t>> polygons;                    ///< their corners
    std::vector<std::pair<std::string, std::vector<double>>> values{};  ///< names, and one a polygon
    std::vector<std::array<std::uint8_t, 3>> colours{};                 ///< sRGB, one a polygon
};

/// A map as VTK's poly data (.vtp), its values as cell data.
std::string vtpMap(const PolygonMap& map);

/// A map as binary PLY, its values as properties of the faces. \pre polygons of at most 255 corners
std::string plyMap(const PolygonMap& map);

/// glTF 2.0 in its binary form (.glb): a node and a mesh per block, coloured by its motion up to the last
/// frame. Several frames give an animation in the run's time. \pre at least one frame
std::string gltfBlocks(const SnapshotHeader& header, const std::vector<LightFrame>& frames);

}  // namespace talus::formats
