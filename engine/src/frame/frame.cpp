#include "frame/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "forces/closed_water.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "forces/water.h"
#include "frame/frame_fields.h"
#include "frame/frame_readings.h"
#include "frame/vertex_edge_fields.h"
#include "geometry/parts.h"
#include "measure/measure.h"
#include "model/gravity.h"
#include "state/block_motion.h"

namespace talus {
namespace {

constexpr double kNoTable = std::numeric_limits<double>::quiet_NaN();

/// Copies an array of the state into the frame.
struct ToFrame {
    void operator()(const VectorArray& s, VectorList<double>& f) const { f.x = s.x, f.y = s.y, f.z = s.z; }
    void operator()(const PositionArray& s, VectorList<double>& f) const {
        for (auto* values : {&f.x, &f.y, &f.z}) values->clear();
        for (std::size_t i = 0; i < s.size(); ++i) f.push_back(s.get(i));
    }
    void operator()(const QuaternionArray& s, QuaternionList& f) const {
        for (auto* values : {&f.w, &f.x, &f.y, &f.z}) values->clear();
        for (const auto& [w, x, y, z] : s)
            f.w.push_back(w), f.x.push_back(x), f.y.push_back(y), f.z.push_back(z);
    }
    template <class A, class B>
    void operator()(const std::vector<A>& s, std::vector<B>& f) const {
        f.assign(s.begin(), s.end());
    }
    template <class A, class B>
    std::enable_if_t<std::is_arithmetic_v<A>> operator()(const A& s, B& f) const {
        f = static_cast<B>(s);
    }
};

/// The tilt of gravity for a viewer: of a given direction, that of its projection onto the plane of x and z.
double shownTilt(const State& state) {
    const Gravity& gravity = state.geometry->model.gravity;
    if (!gravity.direction) return state.load.tilt;
    const Vec3 down = downward(gravity, state.load.tilt);
    return std::atan2(-down.x(), -down.z());
}

void addWaterLevels(const State& state, WaterLevels& levels) {
    const auto& waters = state.geometry->model.waters;
    for (std::size_t w = 0; w < waters.size(); ++w) {
        levels.level.push_back(levelNow(state, w, state.load.time));
        levels.drained.push_back(state.drained[w]);
        const PressureField field = pressureField(state, w, state.load);
        const double unit_weight = field.gradient.norm();
        // p = p0 + gradient . x in the state's coordinates; the table is in the model's.
        const double shift = field.gradient.dot(state.geometry->origin);
        levels.table.push_back(unit_weight > 0 ? (field.p0 - shift) / unit_weight : kNoTable);
    }
}

void addWaterLoads(const State& state, FrameWaters& waters) {
    for (std::size_t w = 0; w < state.pressure.size(); ++w) {
        waters.p0.push_back(state.pressure[w].p0);
        waters.gradient.push_back(state.pressure[w].gradient);
        waters.tilt.push_back(state.water_load[w].tilt);
        waters.share.push_back(state.water_load[w].share);
        waters.level.push_back(state.water_load[w].level);
        waters.load_drained.push_back(state.water_load[w].drained ? 1 : 0);
    }
}

void addSupports(const State& state, SupportForces& forces) {
    for (const Supports& kind : supportReports(state))
        for (const SupportReport& support : kind.reports) {
            forces.force.push_back(static_cast<float>(support.force));
            forces.utilisation.push_back(static_cast<float>(support.utilisation));
            forces.broken.push_back(support.broken ? 1 : 0);
        }
}

void addLaws(const State& state, FrameLaws& laws) {
    for (const auto& parameter : contact::kLawParameters<double>) {
        std::vector<double>& values = laws.named(parameter.name);
        for (const contact::JointLaw& law : state.laws) values.push_back(law.*parameter.value);
    }
    for (const contact::JointLaw& law : state.laws) laws.bonded.push_back(law.bonded ? 1 : 0);
}

/// Frames, corners and contact points interface by interface, with what the contact points carry.
void addPatches(const State& state, FrameInterfaces& f, FramePoints& points) {
    const bool dilates = std::any_of(state.laws.begin(), state.laws.end(), contact::dilates);
    f.patch_begin = f.point_begin = {0};
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        InterfaceFrame frame = state.interfaces.frame(i);
        frame.reference_gap = storedReferenceGap(state.interfaces, i);
        eachFrameVector(f, [&](auto vector, VectorList<double>& list) { list.push_back(frame.*vector); });
        const InterfaceWrench wrench = state.interfaces.wrench(i);
        eachWrenchVector(f, [&](auto vector, VectorList<double>& list) { list.push_back(wrench.*vector); });
        for (const Eigen::Vector2d& corner : patchOutline(state.interfaces, i)) {
            f.patch_xi.push_back(corner.x());
            f.patch_eta.push_back(corner.y());
        }
        f.patch_begin.push_back(static_cast<std::int64_t>(f.patch_xi.size()));
        for (const ContactPoint& point : contactPoints(state, i)) {
            points.xi.push_back(point.position.x());
            points.eta.push_back(point.position.y());
            points.area.push_back(point.area);
            points.offset_1.push_back(point.memory.offset_1);
            points.offset_2.push_back(point.memory.offset_2);
            points.bond.push_back(point.memory.bond);
            if (dilates) points.dilation.push_back(point.memory.dilation);
            points.normal.push_back(point.force.normal);
            points.shear_1.push_back(point.force.shear_1);
            points.shear_2.push_back(point.force.shear_2);
        }
        f.point_begin.push_back(static_cast<std::int64_t>(points.size()));
    }
}

void addShape(const Block& block, RunGeometry& g) {
    const auto first_vertex = static_cast<std::int32_t>(g.vertex.x.size());
    for (const Vec3& v : block.shape.vertices) g.vertex.push_back(v);
    for (const auto& face : block.shape.faces) {
        for (const std::int32_t v : face) g.face_vertex.push_back(first_vertex + v);
        g.face_vertex_begin.push_back(static_cast<std::int32_t>(g.face_vertex.size()));
    }
    g.face_joint.insert(g.face_joint.end(), block.face_joint.begin(), block.face_joint.end());
    g.vertex_begin.push_back(static_cast<std::int32_t>(g.vertex.x.size()));
    g.face_begin.push_back(static_cast<std::int32_t>(g.face_vertex_begin.size() - 1));
}

void addParts(const Polyhedron& shape, RunGeometry& g) {
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        g.face_part.push_back(static_cast<std::int32_t>(partOf(shape.faces, f)));
        g.face_inner.push_back(shape.isInner(f) ? 1 : 0);
    }
}

}  // namespace

RunGeometry geometryOf(const State& state, std::size_t own_joints) {
    RunGeometry g;
    g.mass = state.blocks.mass;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        g.centroid.push_back(state.geometry->origin + state.geometry->initial_position.get(b));
    ToFrame{}(state.geometry->initial_orientation, g.orientation);
    g.size = state.geometry->size;
    g.vertex_begin = g.face_begin = g.face_vertex_begin = {0};
    for (const Block& block : state.geometry->model.blocks) addShape(block, g);
    if (state.geometry->part_block.size() > state.blocks.size())
        for (const Block& block : state.geometry->model.blocks) addParts(block.shape, g);
    g.supports = supportLines(state);
    const std::vector<Joint>& joints = state.geometry->model.joints;
    g.wet_joints.assign(joints.begin() + static_cast<std::ptrdiff_t>(own_joints), joints.end());
    return g;
}

LightFrame lightFrameOf(const State& state) {
    LightFrame frame;
    frame.time = state.time;
    frame.step = state.step;
    frame.state_hash = stateHash(state);
    frame.tilt = shownTilt(state);
    frame.kinetic_energy = kineticEnergy(state);
    frame.elastic_energy = elasticEnergy(state);
    frame.gravity_energy = gravityEnergy(state);
    frame.out_of_balance = outOfBalanceRatio(state);
    const Geometry& geometry = *state.geometry;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        frame.displacement.push_back(state.blocks.position.get(b) - geometry.initial_position.get(b));
        frame.rotation.push_back(
            rotationVector(geometry.initial_orientation[b], state.blocks.orientation[b]));
        frame.velocity.push_back(state.blocks.velocity.get(b));
    }
    addWaterLevels(state, frame.water);
    addSupports(state, frame.supports);
    return frame;
}

FullFrame fullFrameOf(const State& state) {
    FullFrame frame;
    frame.state_hash = stateHash(state);
    eachField(state, frame, ToFrame{});
    const Vec3& origin = state.geometry->origin;
    frame.origin_x = origin.x(), frame.origin_y = origin.y(), frame.origin_z = origin.z();
    addWaterLoads(state, frame.waters);
    frame.memory = forceMemory(state);
    addLaws(state, frame.laws);
    addPatches(state, frame.interfaces, frame.points);
    addReadings(state, frame.interfaces, frame.points);
    return frame;
}

}  // namespace talus
