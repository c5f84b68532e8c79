#include "stages/contacts.h"

#include "contact/points.h"
#include "stages/contact_view.h"
#include "stages/relative_pose.h"

namespace talus::stages {
namespace {

using simd::Triple;

double* pointerOrNull(std::vector<double>& values) { return values.empty() ? nullptr : values.data(); }

PointPlaces placesOf(PointRule::Kind kind) {
    switch (kind) {
        case PointRule::Kind::vertex:
            return PointPlaces::vertex;
        case PointRule::Kind::corner:
            return PointPlaces::corner;
        case PointRule::Kind::quarter:
        case PointRule::Kind::grid:
            break;
    }
    return PointPlaces::stored;
}

ContactView contactView(State& state) {
    Blocks& blocks = state.blocks;
    Interfaces& f = state.interfaces;
    ContactPoints& points = state.points;
    const QuaternionArray& q = blocks.orientation;
    return {.position = constPointers(blocks.position),
            .orientation = {q.w.data(), q.x.data(), q.y.data(), q.z.data()},
            .velocity = constPointers(blocks.velocity),
            .angular_velocity = constPointers(blocks.angular_velocity),
            .groups = f.groups.data(),
            .block_a = f.block_a.data(),
            .block_b = f.block_b.data(),
            .joint = f.joint.data(),
            .origin_a = constPointers(f.origin_a),
            .e1_a = constPointers(f.e1_a),
            .e2_a = constPointers(f.e2_a),
            .origin_b = constPointers(f.origin_b),
            .e1_b = constPointers(f.e1_b),
            .e2_b = constPointers(f.e2_b),
            .reference_gap = constPointers(f.reference_gap),
            .patch_area = f.area.data(),
            .patch_xi = f.patch_xi.data(),
            .patch_eta = f.patch_eta.data(),
            .laws = state.laws.data(),
            .xi = points.xi.data(),
            .eta = points.eta.data(),
            .area = points.area.data(),
            .offset_1 = points.offset_1.data(),
            .offset_2 = points.offset_2.data(),
            .bond = pointerOrNull(points.bond),
            .dilation = pointerOrNull(points.dilation),
            .force = pointers(f.force),
            .moment_a = pointers(f.moment_a),
            .moment_b = pointers(f.moment_b),
            .release = state.release,
            .contact_damping = state.damping.contact,
            .places = placesOf(state.geometry->model.points.kind)};
}

Triple<double> triple(const VectorArray& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }
Vec3 vec3(const Triple<double>& v) { return {v.x, v.y, v.z}; }

PoseOf<double> poseOf(const Blocks& blocks, std::int32_t block) {
    const auto b = static_cast<std::size_t>(block);
    const QuaternionArray& q = blocks.orientation;
    return {triple(blocks.position, b), simd::rotationOf(q.w[b], q.x[b], q.y[b], q.z[b])};
}

double affineAt(const Vec3& f, const Eigen::Vector2d& place) {
    return affine<double>({f.x(), f.y(), f.z()}, place.x(), place.y());
}

}  // namespace

Vec3 angularVelocity(const Blocks& blocks, std::size_t block) {
    const Mat3 r = blocks.orientation.matrix(block);
    return r *
           blocks.inverse_inertia.get(block).cwiseProduct(r.transpose() * blocks.angular_momentum.get(block));
}

RelativePose relativePose(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const FramesOf<double> frames{triple(f.origin_a, i),     triple(f.e1_a, i), triple(f.e2_a, i),
                                  triple(f.origin_b, i),     triple(f.e1_b, i), triple(f.e2_b, i),
                                  triple(f.reference_gap, i)};
    const PoseOf<double> a = poseOf(state.blocks, f.block_a[i]);
    const auto pose = relativePoseOf(frames, a, poseOf(state.blocks, f.block_b[i]));
    return {vec3(pose.gap), vec3(pose.slide_1), vec3(pose.slide_2), vec3(a.position + pose.arm_a),
            vec3(pose.e1),  vec3(pose.e2),      vec3(pose.e3)};
}

void updateContacts(State& state, Range groups) {
    const ContactView view = contactView(state);
    if (state.instructions == simd::InstructionSet::avx2)
        updateContactsAvx2(view, groups.begin, groups.end);
    else
        updateContactsScalar(view, groups.begin, groups.end);
}

std::vector<PointState> pointStates(const State& state, std::size_t i) {
    constexpr double kNoRelease = 0.0;
    const ContactPoints& points = state.points;
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    const RelativePose pose = relativePose(state, i);
    std::vector<PointState> result;
    for (const contact::PatchPoint& place :
         interfacePoints(state.interfaces, i, state.geometry->model.points)) {
        const std::size_t slot = state.interfaces.pointSlot(i, result.size());
        PointState point{.position = place.position, .area = place.area, .force = {}, .memory = {}};
        point.memory.offset_1 = points.offset_1[slot];
        point.memory.offset_2 = points.offset_2[slot];
        if (!points.bond.empty()) {
            point.memory.bond = points.bond[slot];
            point.memory.dilation = points.dilation[slot];
        }
        contact::PointMemory scratch = point.memory;
        point.force = contact::contactLaw(law, place.area, affineAt(pose.gap, place.position),
                                          affineAt(pose.slide_1, place.position),
                                          affineAt(pose.slide_2, place.position), kNoRelease, scratch);
        result.push_back(point);
    }
    return result;
}

}  // namespace talus::stages
