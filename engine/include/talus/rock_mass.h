#pragma once
// Rock masses: a region cut into blocks by joint sets and single joints.
//
//   region (closed surface)  --cut by the planes of the joints-->  blocks, each face knowing the joint that
//   made it
//
// Axes as everywhere: x east, y north, z up. A plane's dip direction is counted clockwise from +y; its normal
// points upwards, and towards the dip direction where the plane is steep.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/control.h"
#include "talus/model.h"
#include "talus/polyhedron.h"
#include "talus/result.h"
#include "talus/surface.h"

namespace talus {

/// Unit normal of a plane of this dip and dip direction [rad], pointing upwards.
Vec3 upwardNormal(double dip, double dip_direction);

/// How the spacing of a joint set varies from plane to plane.
enum class SpacingLaw : std::uint8_t {
    constant,
    uniform,     ///< mean * (1 + spread * u), u uniform in [-1, 1]
    exponential  ///< negative exponential: planes at random places (S. D. Priest and J. A. Hudson, 1976)
};

/// Parallel planes through the whole region. Plane 0 goes through `origin` (moved by `offset`), plane 1 is
/// the next along the upward normal.
struct JointSet {
    std::string name;
    double dip = 0;            ///< [rad]
    double dip_direction = 0;  ///< [rad]
    double spacing = 0;        ///< mean, normal to the planes [m]
    Vec3 origin = Vec3::Zero();
    double offset = 0;  ///< along the upward normal [m]
    SpacingLaw law = SpacingLaw::constant;
    double spread = 0;  ///< of SpacingLaw::uniform, 0..1
    /// Fisher constant of the scatter of orientation about the mean; none: no scatter
    std::optional<double> fisher;
    std::int32_t joint = 0;  ///< index of the strength
    std::string field{};     ///< "joint_set[0]", for messages
};

/// One joint: a plane through a point, through the whole region or as far as a disc or a convex polygon
/// reaches.
struct SingleJoint {
    std::string name;
    Vec3 point = Vec3::Zero();
    double dip = 0;                ///< [rad]
    double dip_direction = 0;      ///< [rad]
    std::optional<double> radius;  ///< of a disc about `point`; of an ellipse its semi-major axis [m]
    std::vector<Vec3> polygon;     ///< instead: its corners in order; they give point and orientation, too
    std::int32_t joint = 0;
    std::string field{};
    bool of_network = false;  ///< one of many with this field: warnings tell of all together
    double semi_minor = 0;    ///< of an ellipse, whose outline is `polygon` (talus/fractures.h); else 0 [m]
    double rake = 0;          ///< of its major axis [rad]
};

/// Corners of a finite joint in order; a disc is a polygon of as much area. Empty: through the whole region.
std::vector<Vec3> outlineOf(const SingleJoint& joint);

struct RockMass {
    TriangleSurface region;
    std::vector<JointSet> sets;
    std::vector<SingleJoint> singles;
    /// [m]; default: a thousandth of the least mean spacing, without joint sets 1e-4 of the region's longest
    /// side; at least 1e-6 of that
    std::optional<double> min_thickness;
    bool refuse_slivers = false;  ///< a cut that would leave a thinner part is an error, not left out
    std::uint64_t seed = 1;
    std::size_t max_blocks = 2'000'000;
    const std::atomic<bool>* stop = nullptr;          ///< set it to end the cutting early, with an error
    std::function<void(const Progress&)> progress{};  ///< told how far the cutting has come
    std::string field = "rock_mass";
};

/// Which joint made a face: index into the sets, then the singles; -1 the region's surface, or the inside of
/// a block of several convex parts.
struct FaceOrigin {
    std::int32_t joint = -1;
    std::int32_t plane = 0;  ///< number of the plane within its set
};

/// Most blocks are convex; one with a reflex edge of the region is of several convex parts.
struct CutBlock {
    Polyhedron shape;
    std::vector<FaceOrigin> origin;  ///< per face
    double volume = 0;               ///< [m^3]
};

struct CutRockMass {
    std::vector<CutBlock> blocks;  ///< from the bottom up, then by x, then by y
    double volume = 0;             ///< of all blocks [m^3]
    double region_volume = 0;      ///< [m^3]
    double min_thickness = 0;      ///< the one used [m]
    std::vector<std::string> warnings;
    std::vector<std::string> idle_joints;  ///< "joint_set[0] (J1)": those that parted no block
};

/// Cuts the region by the joint sets, then the unbounded single joints, then the finite ones, each in input
/// order.
///
/// A finite joint cuts each block it meets from side to side. A joint within `weld` (1e-11 of the region's
/// extent) of a vertex passes through it; one as near to a face coincides with it. A cut that would leave a
/// part thinner than `min_thickness` is left out for that block and reported.
///
/// Where the region is not convex, its blocks with a reflex edge are of several convex parts.
///
/// Errors: an open, non-manifold, inverted or self-crossing region; spacing not positive; a joint that is no
/// plane or no convex polygon; more than `max_blocks` blocks, estimated before anything is cut or counted
/// then; `stop`; slivers, if refused; volumes that do not add up to 1e-9.
Result<CutRockMass> cutRockMass(const RockMass& description);

/// Two faces made by the plane of a finite joint, and the share of their common area that is intact rock
/// beyond the joint.
struct JointCut {
    std::int32_t block_a = 0, face_a = 0;
    std::int32_t block_b = 0, face_b = 0;
    std::size_t joint = 0;  ///< index into the sets, then the singles
    double area = 0;        ///< that they share [m^2]
    double beyond = 0;      ///< share of it, 0..1
};

/// All of them, joint by joint. \pre `mass` was cut from the description
std::vector<JointCut> finiteCuts(const CutRockMass& mass, const RockMass& description);

/// A plane of the joints.
struct CutPlane {
    Vec3 normal;            ///< upwards
    std::size_t joint = 0;  ///< index into the sets, then the singles
};

/// All planes that pass through the region or touch it, in the order of cutting; others cut nothing. Errors:
/// those of the joints.
Result<std::vector<CutPlane>> cuttingPlanes(const RockMass& description);

/// A selection of blocks.
struct BlockSelection {
    enum class Kind : std::uint8_t {
        box,      ///< centroid within the box
        below,    ///< wholly below a plane (against its upward normal)
        above,    ///< wholly above
        touching  ///< with a face in the plane
    };
    Kind kind = Kind::box;
    Vec3 min = Vec3::Zero(), max = Vec3::Zero();               ///< of the box [m]
    Vec3 point = Vec3::Zero(), upward_normal = Vec3::UnitZ();  ///< of the plane [m]
};

/// For each block, whether the selection takes it. Planes are met within `tolerance` [m].
std::vector<bool> selectBlocks(const CutRockMass& mass, const BlockSelection& selection, double tolerance);

/// The block that holds a point; -1 if none does.
std::int32_t blockAt(const CutRockMass& mass, const Vec3& point);

/// A closed surface as one shape, split into convex parts at its reflex edges. Errors: what checkSurface
/// finds; a surface that crosses itself or encloses several bodies.
Result<Polyhedron> solidOf(const TriangleSurface& surface);

}  // namespace talus
