#pragma once
// Frames of a run as plain data: LightFrame for viewers, FullFrame for exact restarts, and their shapes
// (RunGeometry). The engine writes them and restarts from a full one. Formats store them in files;
// formats/snapshot.fbs has the same fields with more explanation.
//
// SI units and radians. Vectors of begins: item k owns [begin[k], begin[k + 1]); they have one entry more
// than items.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "talus/joint.h"

namespace talus {

/// A vector quantity, one entry per item in each component.
template <class Number>
struct VectorList {
    std::vector<Number> x, y, z;

    template <class Vector>
    void push_back(const Vector& v) {
        x.push_back(static_cast<Number>(v.x()));
        y.push_back(static_cast<Number>(v.y()));
        z.push_back(static_cast<Number>(v.z()));
    }
};

/// Unit quaternions, a block's own frame (its centroid, its principal axes) to the model frame.
struct QuaternionList {
    std::vector<double> w, x, y, z;
};

/// Supports (talus/supports.h) as lines through the blocks they hold, at the start: of a bolt its head, both
/// sides of each joint it ties, its end.
struct SupportLines {
    std::vector<std::string> name;
    std::vector<std::int32_t> point_begin;  ///< per support; empty without any
    VectorList<double> point;               ///< [m]
    std::vector<std::int32_t> block;        ///< that each point goes with

    void add(std::int32_t with, const auto& place) {
        point.push_back(place);
        block.push_back(with);
    }
};

/// Shapes in the model frame as they lie at the start, flat. Names, waters and all other joints are the
/// model's.
struct RunGeometry {
    std::vector<double> mass;                     ///< [kg]
    VectorList<double> centroid;                  ///< [m]
    QuaternionList orientation;                   ///< at the start
    std::vector<double> size;                     ///< smallest extent of each block [m]
    std::vector<std::int32_t> vertex_begin;       ///< per block
    VectorList<double> vertex;                    ///< [m]
    std::vector<std::int32_t> face_begin;         ///< per block
    std::vector<std::int32_t> face_vertex_begin;  ///< per face
    std::vector<std::int32_t> face_vertex;  ///< index into `vertex`, counter-clockwise seen from outside
    std::vector<std::int32_t> face_joint;   ///< per face
    // Of blocks of several convex parts; both empty when there is none.
    std::vector<std::int32_t> face_part;   ///< per face: which part of its block
    std::vector<std::uint8_t> face_inner;  ///< per face: 1 where it lies on other parts, no surface

    bool isInner(std::size_t face) const { return !face_inner.empty() && face_inner[face] != 0; }
    SupportLines supports;
    /// Of wet interfaces, counted after the model's; in a file they stand among all joints.
    std::vector<Joint> wet_joints{};
};

/// Water as it stands, per water of the model. Its table is the plane up . x = table, up = (sin tilt, 0, cos
/// tilt).
struct WaterLevels {
    std::vector<double> level;  ///< depth or elevation as the scenario gives it [m]
    std::vector<double> table;  ///< [m]; nan when drained and for water given by two heads
    std::vector<std::uint8_t> drained;
};

/// Supports as they stand, in the order of SupportLines.
struct SupportForces {
    std::vector<float> force;        ///< [N]
    std::vector<float> utilisation;  ///< of what it can carry, 0..1
    std::vector<std::uint8_t> broken;
};

/// What a viewer needs of one instant: 36 bytes a block.
struct LightFrame {
    double time = 0;  ///< [s]
    std::int64_t step = 0;
    std::uint64_t state_hash = 0;
    double tilt = 0;                 ///< [rad]
    double time_step = 0;            ///< [s]
    double kinetic_energy = 0;       ///< [J]
    double elastic_energy = 0;       ///< in contacts and supports [J]
    double gravity_energy = 0;       ///< relative to the start [J]
    double out_of_balance = 0;       ///< largest out-of-balance force of a free block over its weight
    VectorList<float> displacement;  ///< of each block's centroid since the start [m]
    VectorList<float> rotation;  ///< of each block since the start: axis times angle [rad], at most pi long
    VectorList<float> velocity;  ///< of each block's centroid [m/s]
    WaterLevels water;
    SupportForces supports;
};

/// Exact states of the blocks.
struct FrameBlocks {
    VectorList<double> position;  ///< of the centroid [m]
    QuaternionList orientation;
    VectorList<double> velocity;          ///< [m/s]
    VectorList<double> angular_momentum;  ///< about the centroid, model frame [kg m^2/s]
    VectorList<double> force;             ///< sum at the end of the last step, local damping included [N]
    VectorList<double> torque;            ///< about the centroid [N m]
    std::vector<double> inverse_mass;     ///< as used in the motion [1/kg]
    VectorList<double> inverse_inertia;   ///< likewise [1/(kg m^2)]
};

/// Two faces that lie against each other. e1 and e2 span the reference face, which is a's; e1 x e2 points
/// from a to b.
struct FrameInterfaces {
    std::vector<std::int32_t> block_a, block_b, face_a, face_b, joint;
    std::vector<double> area;                 ///< of the patch [m^2]
    VectorList<double> origin_a, e1_a, e2_a;  ///< in a's own frame; the origin is the patch's centroid [m]
    VectorList<double> origin_b, e1_b, e2_b;  ///< in b's own frame
    VectorList<double> reference_gap;         ///< gap [m] and slopes that count as closed
    std::vector<std::int64_t> point_begin, patch_begin;
    std::vector<double> patch_xi, patch_eta;  ///< corners of the patch along e1, e2 [m]
    VectorList<double> force;                 ///< on b by springs and dashpots, model frame [N]
    VectorList<double> moment_a, moment_b;    ///< about the centroids of a and b [N m]

    std::size_t size() const { return block_a.size(); }

    /// A place kept for a vertex or an edge that touches nothing now: nothing to show.
    bool isIdle(std::size_t i) const {
        return patch_begin[i + 1] - patch_begin[i] == 1 && reference_gap.x[i] < kIdleGap;
    }
    static constexpr double kIdleGap = -1e29;  ///< [m]
};

enum class PointState : std::uint8_t { open, sticking, slipping };

/// Contact points, interface by interface. The last three quantities are for reading: a restart leaves them.
struct FramePoints {
    std::vector<double> xi, eta;             ///< place on the reference face [m]
    std::vector<double> area;                ///< tributary area A_s [m^2]
    std::vector<double> offset_1, offset_2;  ///< plastic slide [m]
    std::vector<double> bond;                ///< share of the peak strength left
    std::vector<double> dilation;            ///< [m]; empty when no joint dilates
    std::vector<double> normal;              ///< F_n, effective, compression positive [N]
    std::vector<double> shear_1, shear_2;    ///< F_s on b along e1, e2 [N]
    std::vector<float> water;                ///< P: shares of the water's exact thrust on the patch [N]
    std::vector<PointState> state;
    std::vector<float> mobilised;  ///< shear force over shear strength, 0..1

    std::size_t size() const { return area.size(); }
};

/// Walls that water pushes on, polygons fixed to a block, sorted by water.
struct FrameWetPatches {
    std::vector<std::int32_t> block, water;
    std::vector<std::int64_t> water_begin;  ///< per water
    std::vector<std::int32_t> interface;    ///< it is a wall of, or -1
    VectorList<double> origin, e1, e2;      ///< in the block's own frame [m]
    std::vector<std::int64_t> vertex_begin;
    std::vector<double> vertex_x, vertex_y;  ///< [m]
    VectorList<double> head;                 ///< at the origin [m] and its gradient
    VectorList<double> force, moment;        ///< in the block's own frame [N, N m]
    VectorList<double> computed_position;    ///< pose for which they were computed
    QuaternionList computed_orientation;
};

/// Per water: the pressure p0 + gradient . x and the load it was computed for.
struct FrameWaters {
    std::vector<double> p0;       ///< [Pa]
    VectorList<double> gradient;  ///< [Pa/m]
    std::vector<double> tilt, share, level;
    std::vector<std::uint8_t> load_drained;
    std::vector<std::uint8_t> drained;  ///< as it is now
};

/// One array of what a force remembers. Flags are 0 or 1.
struct ForceArray {
    std::string name;  ///< of the force and its own: "bolts.yielded"
    std::vector<double> values;
};

/// Parameters of the contact law for each joint, divided by the factor of a strength reduction.
struct FrameLaws {
    struct Parameter {
        std::string name;            ///< as the law calls it
        std::vector<double> values;  ///< per joint
    };
    /// One for each name that joint properties give (JointProperty::in_law); a file may lack some or have
    /// others.
    std::vector<Parameter> parameters = none();
    std::vector<std::uint8_t> bonded;

    /// Null when there is none of this name.
    const std::vector<double>* find(std::string_view name) const {
        for (const Parameter& parameter : parameters)
            if (parameter.name == name) return &parameter.values;
        return nullptr;
    }
    /// The parameter's values, made empty when there are none of this name.
    std::vector<double>& named(std::string_view name) {
        for (Parameter& parameter : parameters)
            if (parameter.name == name) return parameter.values;
        return parameters.emplace_back(Parameter{std::string(name), {}}).values;
    }
    std::vector<double>& of(double Joint::*property) { return named(propertyOf(property).in_law); }
    const std::vector<double>& of(double Joint::*property) const {
        return *find(propertyOf(property).in_law);
    }

 private:
    static std::vector<Parameter> none() {
        std::vector<Parameter> all;
        for (const JointProperty& property : kJointProperties)
            if (!property.in_law.empty()) all.push_back({std::string(property.in_law), {}});
        return all;
    }
};

struct FrameLoads {
    double tilt = 0, gravity_share = 1, water_share = 1, time = 0;
    double mass_damping = 0, rotation_damping = 0, contact_damping = 0, local_damping = 0;
    double release = 1;
};

/// What a resumed run needs beside the state to end in the same bits.
struct RunProgress {
    double time_step = 0;        ///< [s]
    double stability_bound = 0;  ///< [s]
    double step_safety = 0;      ///< as a share of the stability bound
    double next_frame = 0;       ///< when the next frame is due [s]
    std::int64_t frames = 0;     ///< handed out so far
    bool warned_of_step = false;
};

/// Everything that moves, to the bit: a run that starts from it ends as the run it came from.
struct FullFrame {
    double time = 0;  ///< [s]
    std::int64_t step = 0;
    std::uint64_t state_hash = 0;
    FrameBlocks blocks;
    FrameInterfaces interfaces;
    FramePoints points;
    FrameWetPatches wet;
    FrameWaters waters;
    std::vector<ForceArray> memory;  ///< what forces remember beside contacts and `waters`
    FrameLaws laws;
    FrameLoads loads;
    VectorList<double> search_position;  ///< poses at the last neighbour search
    QuaternionList search_orientation;
    double search_margin = 0;  ///< [m]
    RunProgress progress;
    double shear_lost = 0;  ///< [N]
    std::vector<std::string> warnings;
    double origin_x = 0, origin_y = 0, origin_z = 0;  ///< of all positions, in the model frame [m]
};

/// Hash of a full frame's own values, which is its state_hash as long as nothing was changed.
std::uint64_t hashOf(const FullFrame& frame);

}  // namespace talus
