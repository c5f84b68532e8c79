#pragma once
// The state of a simulation as structures of arrays. Each array is one quantity with its unit; an index means the same
// thing in every array of a structure. Plain data: copying a State copies the simulation, which is how a probe goes
// back to the last stable state.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "contact/law.h"
#include "simd/instruction_set.h"
#include "simd/pointers.h"
#include "simd/scalar.h"
#include "state/interface_group.h"
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

/// Unit quaternions, block's own frame to model frame.
struct QuaternionArray {
    std::vector<double> w, x, y, z;

    void resize(std::size_t n) {
        w.resize(n, 1.0);
        x.resize(n, 0.0);
        y.resize(n, 0.0);
        z.resize(n, 0.0);
    }
    Mat3 matrix(std::size_t i) const {
        const double a = w[i], b = x[i], c = y[i], d = z[i];
        Mat3 r;
        r << 1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c),  //
            2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b),   //
            2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c);
        return r;
    }
};

/// Blocks. A block's own frame sits at its centroid along its principal axes.
struct Blocks {
    VectorArray position;  ///< of the centroid [m]
    QuaternionArray orientation;
    VectorArray velocity;  ///< of the centroid [m/s]
    VectorArray
        angular_momentum;  ///< about the centroid, in the model frame, with the scaled inertia [kg m^2/s]
    VectorArray force;     ///< sum at the end of the last step, local damping included [N]
    VectorArray torque;    ///< about the centroid, likewise [N m]
    VectorArray angular_velocity;  ///< in the model frame, of the poses and momenta of the last drift [rad/s]
    std::vector<double> mass;      ///< true mass, for the weight [kg]
    VectorArray inertia;           ///< true principal moments [kg m^2]
    std::vector<double> inverse_mass;  ///< of the inertia used in the motion; 0: fixed or driven [1/kg]
    VectorArray inverse_inertia;       ///< likewise [1/(kg m^2)]
    std::vector<Motion> motion;
    std::vector<std::uint8_t> free;  ///< 1 where motion is free, for the kernels

    std::size_t size() const { return mass.size(); }
};

/// Interfaces: two faces that lie against each other. The reference face belongs to block `a`; `e1`, `e2` span it and
/// e3 = e1 x e2 points from a to b. The origin is the patch's centroid at its last clipping, as a material point of
/// each of the two blocks.
struct Interfaces {
    std::vector<std::int32_t> block_a, block_b;
    std::vector<std::int32_t> face_a, face_b;
    std::vector<std::int32_t> joint;
    std::vector<double> area;          ///< of the patch [m^2]
    VectorArray origin_a, e1_a, e2_a;  ///< in a's own frame
    VectorArray origin_b, e1_b,
        e2_b;  ///< in b's own frame: b's face plane, e1 and e2 as they lay at the clipping
    VectorArray
        reference_gap;  ///< gap [m] and its two slopes along e1, e2 that count as closed and unstressed
    std::vector<InterfaceGroup> groups;       ///< in the order of the interfaces
    std::vector<std::int32_t> group;          ///< of each interface
    std::vector<double> patch_xi, patch_eta;  ///< corners along e1, e2 from the origin, counter-clockwise [m]
    VectorArray force;                        ///< on b, by the springs and dashpots [N]
    VectorArray moment_a;                     ///< on a about a's centroid [N m]
    VectorArray moment_b;                     ///< on b about b's centroid [N m]

    std::size_t size() const { return block_a.size(); }

    const InterfaceGroup& groupOf(std::size_t i) const { return groups[static_cast<std::size_t>(group[i])]; }
    std::size_t cornerCount(std::size_t i) const { return static_cast<std::size_t>(groupOf(i).corners); }
    std::size_t pointCount(std::size_t i) const { return static_cast<std::size_t>(groupOf(i).points); }
    /// Slot of the k-th corner, and of the k-th Lp.
    std::size_t cornerSlot(std::size_t i, std::size_t k) const { return slot(i, k, groupOf(i).first_corner); }
    std::size_t pointSlot(std::size_t i, std::size_t k) const { return slot(i, k, groupOf(i).first_point); }

 private:
    std::size_t slot(std::size_t i, std::size_t k, std::int64_t first) const {
        return static_cast<std::size_t>(first) + i - static_cast<std::size_t>(groupOf(i).begin) +
               k * static_cast<std::size_t>(simd::kLanes);
    }
};

/// What contact points (Lps) remember; where they lie follows from the patch (contact/points.h), and the forces they
/// carry from the poses (stages::pointStates). `bond` and `dilation` are there when a joint has such memory, the
/// positions when the kernel does not derive them itself.
struct ContactPoints {
    std::vector<double> offset_1, offset_2;  ///< plastic slide [m]
    std::vector<double> bond;                ///< share of the peak strength left, 1 intact, 0 broken
    std::vector<double> dilation;            ///< [m]
    std::vector<double> xi, eta, area;  ///< `quarter` and `grid`: from the interface's origin [m], A_s [m^2]
    std::size_t count = 0;              ///< without the unused slots

    std::size_t size() const { return count; }
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
    VectorArray head;               ///< [m]: at the origin and its gradient; for water given by two heads
    VectorArray force, moment;      ///< on the block about its centroid, in its own frame, as last computed
    VectorArray computed_position;  ///< pose of the block when they were computed
    QuaternionArray computed_orientation;

    std::size_t size() const { return block.size(); }
};

/// The pressure of one water: p(x) = max(0, p0 + gradient . x) [Pa], x in the model frame; for two heads only `p0`
/// counts, times the head along the patch.
struct PressureField {
    double p0 = 0;
    Vec3 gradient = Vec3::Zero();
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

/// Which interfaces and wet patches push on each block, in a fixed order (compressed rows).
struct Incidence {
    std::vector<std::int64_t> interface_begin;
    std::vector<std::int32_t> interface;  ///< interface index
    std::vector<std::int8_t> side;        ///< 0: the block is the interface's a, 1: its b
    std::vector<std::int64_t> wet_begin;
    std::vector<std::int32_t> wet;
};

inline std::pair<std::int32_t, std::int32_t> pairOf(const PairJoint& pair) {
    return std::minmax(pair.block_a, pair.block_b);
}

/// What does not change while blocks move: shapes, names, the description itself.
struct Geometry {
    Model model;
    std::vector<Polyhedron> shape;       ///< in each block's own frame
    std::vector<double> size;            ///< smallest extent of each block [m]
    std::vector<double> radius;          ///< farthest vertex from the centroid [m]
    std::vector<PairJoint> pair_joints;  ///< sorted by pair of blocks
    VectorArray initial_position;
    QuaternionArray initial_orientation;
    double length_scale = 0;     ///< median block size [m]
    Vec3 origin = Vec3::Zero();  ///< of the state's positions, in the model frame [m]
};

/// Loads that an analysis changes.
struct Load {
    double tilt = 0;           ///< [rad]
    double gravity_share = 1;  ///< 0..1, for loading
    double water_share = 1;    ///< 0..1, for loading
    double time = 0;           ///< for water levels over time [s]
};

struct State {
    std::shared_ptr<const Geometry> geometry;
    std::vector<contact::JointLaw> laws;  ///< one per joint; strength reduction changes these
    Blocks blocks;
    Interfaces interfaces;
    ContactPoints points;
    WetPatches wet;
    Incidence incidence;
    Load load;
    Damping damping;
    double release = 1.0;                                            ///< see contactLaw
    simd::InstructionSet instructions = simd::bestInstructionSet();  ///< the kernels', same bits with each
    double time = 0;                                                 ///< [s]
    std::int64_t step = 0;
    std::vector<std::uint8_t> drained;    ///< per water: 1 once it has run out through an open joint
    std::vector<PressureField> pressure;  ///< per water, for `water_load`
    std::vector<WaterLoad> water_load;    ///< per water: what its wrenches were computed for
    VectorArray search_position;          ///< poses at the last neighbour search
    QuaternionArray search_orientation;
    double search_margin = 0;  ///< gap up to which that search made interfaces [m]
    double invalid_since =
        -1;                 ///< time at which a contact came about that is not modelled; negative: none [s]
    double shear_lost = 0;  ///< shear force that could not be carried over to clipped patches, in all [N]
    std::vector<std::string> warnings;
};

}  // namespace talus
