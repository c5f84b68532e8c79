#pragma once
// The state of a simulation as structures of arrays. Each array is one quantity with its unit; an index means
// the same thing in every array of a structure. Plain data: copying a State copies the simulation, which is
// how a search goes back to the last equilibrium.

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/parts.h"
#include "geometry/pressure.h"
#include "geometry/world_shape.h"
#include "law/law.h"
#include "model/joint_choice.h"
#include "simd/instruction_set.h"
#include "simd/pointers.h"
#include "simd/scalar.h"
#include "state/bolt_arrays.h"
#include "state/fixed_shapes.h"
#include "state/interface_frame.h"
#include "state/interface_group.h"
#include "state/lane_array.h"
#include "state/phreatic_arrays.h"
#include "state/pose_arrays.h"
#include "talus/model.h"

namespace talus {

/// Three arrays for a vector quantity.
struct VectorArray {
    std::vector<double> x, y, z;

    void resize(std::size_t n) {
        x.resize(n, 0.0);
        y.resize(n, 0.0);
        z.resize(n, 0.0);
    }
    std::size_t size() const { return x.size(); }
    Vec3 get(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const Vec3& v) {
        x[i] = v.x();
        y[i] = v.y();
        z[i] = v.z();
    }
    void add(const Vec3& v) {
        x.push_back(v.x());
        y.push_back(v.y());
        z.push_back(v.z());
    }
};

inline simd::Vectors pointers(VectorArray& v) { return {v.x.data(), v.y.data(), v.z.data()}; }
inline simd::ConstVectors constPointers(const VectorArray& v) { return {v.x.data(), v.y.data(), v.z.data()}; }

/// Blocks. A block's own frame sits at its centroid along its principal axes.
struct Blocks {
    PositionArray position;  ///< of the centroid [m]
    QuaternionArray orientation;
    VectorArray velocity;  ///< of the centroid [m/s]
    /// about the centroid, in the model frame, with the scaled inertia [kg m^2/s]
    VectorArray angular_momentum;
    VectorArray force;             ///< sum at the end of the last step, local damping included [N]
    VectorArray torque;            ///< about the centroid, likewise [N m]
    VectorArray angular_velocity;  ///< in the model frame, of the poses and momenta of the last drift [rad/s]
    std::vector<double> mass;      ///< true mass, for the weight [kg]
    VectorArray inertia;           ///< true principal moments [kg m^2]
    std::vector<double> inverse_mass;  ///< of the inertia used in the motion; 0: fixed or driven [1/kg]
    VectorArray inverse_inertia;       ///< likewise [1/(kg m^2)]
    std::vector<Motion> motion;
    std::vector<std::uint8_t> free;  ///< 1 where motion is free, for the kernels
    /// 1: removed (takeOut), fixed and touching nothing; empty: none is.
    std::vector<std::uint8_t> removed{};

    std::size_t size() const { return mass.size(); }
    bool isRemoved(std::size_t b) const { return !removed.empty() && removed[b] != 0; }
};

/// Kind of an interface.
enum class InterfaceKind : std::uint8_t {
    faces,       ///< two faces that lie against each other
    vertex_edge  ///< a place for a vertex on a face, or for two edges that cross (contacts/vertex_edge.h)
};

/// Interfaces: two faces that lie against each other, or a place for a vertex or an edge;
/// state/interface_frame.h says how. What the kernel reads lies in groups (state/interface_group.h): `slot`
/// tells where.
struct Interfaces {
    std::vector<std::int32_t> block_a, block_b;
    std::vector<std::int32_t> face_a, face_b;
    std::vector<std::int32_t> joint;
    std::vector<double> area;  ///< of the patch [m^2]
    std::vector<InterfaceKind> kind;
    std::vector<std::uint8_t> idle;  ///< 1: a place for a vertex or an edge that touches nothing now
    // Of two blocks that may meet by vertices and edges, at the first of their places; elsewhere zero.
    /// what they may go towards each other before they are looked at again [m]
    std::vector<double> travel_left;
    /// 1: the faces that meet have no interface, so vertices carry
    std::vector<std::uint8_t> faces_are_apart;
    std::vector<InterfaceGroup> groups;  ///< in the order of the interfaces
    std::vector<std::int32_t> slot;      ///< of each interface: its group times kLanes, plus its place there
    LaneArray frames{kFrameQuantities};
    LaneArray corners{kCornerQuantities};   ///< of patches, counter-clockwise, as cornerSlot says
    std::vector<InterfaceWrench> wrenches;  ///< by slot: blocks read them one by one

    std::size_t size() const { return block_a.size(); }

    const InterfaceGroup& groupOf(std::size_t i) const {
        return groups[static_cast<std::size_t>(slot[i] / simd::kLanes)];
    }
    std::size_t cornerCount(std::size_t i) const { return static_cast<std::size_t>(groupOf(i).corners); }
    std::size_t pointCount(std::size_t i) const { return static_cast<std::size_t>(groupOf(i).points); }
    /// Slot of the k-th corner, and of the k-th contact point.
    std::size_t cornerSlot(std::size_t i, std::size_t k) const {
        return slotOf(i, k, groupOf(i).first_corner);
    }
    std::size_t pointSlot(std::size_t i, std::size_t k) const { return slotOf(i, k, groupOf(i).first_point); }

    InterfaceFrame frame(std::size_t i) const { return frameAt(frames, slotOf(i)); }
    void setFrame(std::size_t i, const InterfaceFrame& frame) { setFrameAt(frames, slotOf(i), frame); }
    /// The reference gap [m] (0) and its slopes (1, 2).
    double& referenceGap(std::size_t i, std::size_t part) {
        return frames.at(slotOf(i), kReferenceGap + part);
    }
    double referenceGap(std::size_t i, std::size_t part) const {
        return frames.get(slotOf(i), kReferenceGap + part);
    }
    void setReferenceGap(std::size_t i, const Vec3& gap) {
        for (std::size_t part = 0; part < 3; ++part)
            referenceGap(i, part) = gap[static_cast<Eigen::Index>(part)];
    }
    const InterfaceWrench& wrench(std::size_t i) const { return wrenches[slotOf(i)]; }
    void setWrench(std::size_t i, const InterfaceWrench& wrench) { wrenches[slotOf(i)] = wrench; }

 private:
    std::size_t slotOf(std::size_t i) const { return static_cast<std::size_t>(slot[i]); }
    std::size_t slotOf(std::size_t i, std::size_t k, std::int64_t first) const {
        constexpr auto width = static_cast<std::size_t>(simd::kLanes);
        return static_cast<std::size_t>(first) + slotOf(i) % width + k * width;
    }
};

/// Memory of contact points. Their places follow from the patch (law/points.h), and their forces from the
/// poses (contactPoints).
struct ContactPoints {
    LaneArray memory{
        kSlideQuantities};  ///< as Interfaces::pointSlot says; with bond and dilation where a joint has those
    LaneArray places{kPlaceQuantities};  ///< `quarter` and `grid`; empty where the kernel derives them itself
    std::size_t count = 0;               ///< without the unused slots

    std::size_t size() const { return count; }
    /// Whether bond and dilation are remembered.
    bool remembers() const { return memory.quantities() == kMemoryQuantities; }

    contact::PointMemory memoryAt(std::size_t slot) const;
    void setMemory(std::size_t slot, const contact::PointMemory& memory);
    void setOffset(std::size_t slot, double along_1, double along_2) {
        memory.set(slot, 0, along_1);
        memory.set(slot, 1, along_2);
    }
    /// \pre remembers()
    void setBond(std::size_t slot, double bond) {
        assert(remembers());
        memory.set(slot, 2, bond);
    }
};

/// Walls that water pushes on: polygons fixed to a block.
struct WetPatches {
    std::vector<std::int32_t> block;
    std::vector<std::int32_t> water;         ///< index into the model's waters, ascending
    std::vector<std::size_t> water_begin;    ///< first patch of each water; one more at the end
    std::vector<std::int32_t> interface;     ///< the interface it is a wall of, for `pair` water; else -1
    VectorArray origin, e1, e2;              ///< plane of the polygon in the block's own frame; e3 outward
    std::vector<std::int64_t> vertex_begin;  ///< one more at the end
    std::vector<double> vertex_x, vertex_y;  ///< [m]
    std::vector<PolygonMoments> moments;     ///< of the polygons
    VectorArray head;                 ///< [m]: at the origin and its gradient; for water given by two heads
    VectorArray force, moment;        ///< on the block about its centroid, in its own frame, as last computed
    PositionArray computed_position;  ///< pose of the block when they were computed
    QuaternionArray computed_orientation;

    std::size_t size() const { return block.size(); }
};

/// The pressure of one water: p(x) = max(0, p0 + gradient . x) [Pa], x in the model frame; for two heads only
/// `p0` counts, times the head along the patch.
struct PressureField {
    double p0 = 0;
    Vec3 gradient = Vec3::Zero();
    /// No more than this, likewise linear, where its joint daylights; follows from the rest.
    struct Bound {
        double p0 = 0;
        Vec3 gradient = Vec3::Zero();
        friend bool operator==(const Bound&, const Bound&) = default;
    };
    std::optional<Bound> most{};
    friend bool operator==(const PressureField&, const PressureField&) = default;
};

/// What the pressure of a water depends on; nan before it is first computed.
struct WaterLoad {
    double tilt = std::numeric_limits<double>::quiet_NaN();  ///< [rad]
    double share = 0;                                        ///< of the full pressure
    double level = 0;                                        ///< [m]
    bool drained = false;
    friend bool operator==(const WaterLoad&, const WaterLoad&) = default;
};

/// Waters whose level follows from a volume (forces/closed_water.h), one entry per water of the model; empty
/// where none does.
struct ClosedWaters {
    std::vector<std::uint8_t> begun;  ///< 1: the volume counts; until then the level is as filled
    std::vector<double> volume;       ///< in the fissure [m^3]
    std::vector<double> level;        ///< depth or elevation, as the scenario gives it [m]
    std::vector<double> time;         ///< up to which the inflow is in the volume [s]
    std::vector<double> run_over;     ///< since the volume began [m^3]
    std::vector<double> leaked;       ///< likewise, through its foot [m^3]
    std::vector<double> width;        ///< horizontal, of the walls as built; follows from the model [m]

    std::size_t size() const { return begun.size(); }
};

/// Pressure of flow whose apertures follow the joints (forces/coupled_flow.h); empty where none does.
struct CoupledPressure {
    std::vector<double> stated_opening;  ///< as of flow::openings, where apertures are as stated [m]
    std::vector<double> pressure_head;   ///< at each node of the mesh, as it acts [m]
    std::vector<double> push;            ///< six for each block, as in flow_water::ownPushes
    double change = 0;                   ///< of the pressure, as last computed, over the largest
};

/// Which interfaces and wet patches push on each block, in a fixed order (compressed rows).
struct Incidence {
    std::vector<std::int64_t> interface_begin;
    std::vector<std::int32_t> interface;  ///< interface index
    std::vector<std::int32_t> wrench;     ///< twice the interface's slot, plus one where the block is its b

    bool isB(std::int64_t k) const { return wrench[static_cast<std::size_t>(k)] % 2 != 0; }
    std::size_t slotOf(std::int64_t k) const {
        return static_cast<std::size_t>(wrench[static_cast<std::size_t>(k)] / 2);
    }
    std::vector<std::int64_t> wet_begin;
    std::vector<std::int32_t> wet;
    std::vector<std::int32_t> wet_blocks;  ///< those with any, ascending
};

/// Where one of the forces on blocks acts (forces/sum.h), block by block (compressed rows); the force's
/// header says what the numbers of a part are.
struct ForceParts {
    std::vector<std::int32_t> block;   ///< those it acts on, ascending
    std::vector<std::size_t> begin;    ///< first part on each; one more at the end
    std::vector<std::int32_t> source;  ///< of each part: which of the model's entries it comes from
    std::vector<double> numbers;
};

/// Constant data: shapes, names, the model itself.
struct Geometry {
    explicit Geometry(std::shared_ptr<const Model> of)
        : description(std::move(of)), model(*description), joints(model) {}

    std::shared_ptr<const Model> description;  ///< or the caller's own, see `keptByCaller`
    const Model& model;
    JointChoice joints;
    std::vector<Polyhedron> shape;  ///< in each block's own frame
    /// Convex parts of the blocks, numbered block by block; most blocks are one.
    std::vector<std::int32_t> first_part{0};  ///< of each block; one more at the end
    std::vector<std::int32_t> part_block;     ///< which block each is of
    std::vector<PartEdge> part_edges;         ///< of all parts, vertices and faces as the part numbers them
    std::vector<std::size_t> first_edge{0};   ///< of each part; one more at the end
    std::vector<FacePlane> face_planes;       ///< of the faces of all blocks, own frame
    std::vector<std::size_t> first_plane{0};  ///< of each block; one more at the end
    std::vector<double> size;                 ///< smallest extent of each block [m]
    std::vector<double> radius;               ///< farthest vertex from the centroid [m]
    std::vector<double> face_area;            ///< mean of the faces of each block's surface [m^2]
    PositionArray initial_position;
    QuaternionArray initial_orientation;
    FixedShapes fixed{};         ///< of blocks that are fixed in the model, at their initial poses
    double length_scale = 0;     ///< median block size [m]
    Vec3 origin = Vec3::Zero();  ///< of the state's positions, in the model frame [m]
};

/// Loads that an analysis changes.
struct Load {
    double tilt = 0;           ///< [rad]
    double horizontal = 0;     ///< k_h of the pseudo-static earthquake
    double gravity_share = 1;  ///< 0..1, for loading: of weight, earthquake and loads
    double water_share = 1;    ///< 0..1, for loading
    double time = 0;           ///< for water levels, loads over time and ground motion [s]
    bool shaken = false;       ///< whether the ground moves: in time histories only
};

/// Energy of pressed springs in a search for contacts.
enum class Springs : std::uint8_t {
    /// A search makes their force a function of the gap and the new area, whatever their energy: quasi-static
    /// work, whose equilibrium must not depend on the search.
    follow_gaps,
    /// They hold no more energy after a search than before (contacts/energy_balance.h), and return it: motion
    /// with true inertia.
    keep_energy
};

struct State {
    std::shared_ptr<const Geometry> geometry;
    std::vector<contact::JointLaw> laws;  ///< of the model's joints; a search may add more behind them
    Blocks blocks;
    Interfaces interfaces;
    ContactPoints points;
    WetPatches wet;
    Incidence incidence;
    Load load;
    Damping damping;
    double release = 1.0;  ///< see contactLaw
    Springs springs = Springs::follow_gaps;
    simd::InstructionSet instructions = simd::bestInstructionSet();  ///< the kernels', same bits with each
    double time = 0;                                                 ///< [s]
    std::int64_t step = 0;
    std::vector<ForceParts> force_parts{};  ///< one for each of blockForces
    Bolts bolts{};
    PhreaticWalls phreatic{};
    std::vector<std::uint8_t> drained;    ///< per water: 1 once it has run out through an open joint
    std::vector<PressureField> pressure;  ///< per water, for `water_load`
    std::vector<WaterLoad> water_load;    ///< per water: what its wrenches were computed for
    ClosedWaters closed{};
    CoupledPressure coupled_pressure{};
    PositionArray search_position;  ///< poses at the last neighbour search
    QuaternionArray search_orientation;
    double search_margin = 0;  ///< gap up to which that search made interfaces [m]
    /// A search is around the blocks that have moved far; each block has its own pose at its last search.
    bool searches_around = false;
    double shear_lost = 0;  ///< shear force that could not be carried over to clipped patches, in all [N]
    std::vector<std::string> warnings;
};

}  // namespace talus
