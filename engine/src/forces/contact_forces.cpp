#include "forces/contact_forces.h"

#include <algorithm>
#include <cassert>

#include "forces/contact_view.h"
#include "forces/relative_pose.h"
#include "law/closed_part.h"
#include "law/points.h"

namespace talus {
namespace {

using simd::Triple;

/// Whether the arrays by interface and contact point exceed the cache of one core.
bool isBeyondCaches(const State& state) {
    constexpr std::size_t kOwnCache = 1U << 22U;  // [bytes] that cache, with a margin
    const auto bytes = [](const LaneArray& of) { return of.slots() * of.quantities() * sizeof(double); };
    return bytes(state.interfaces.frames) + bytes(state.interfaces.corners) + bytes(state.points.memory) +
               bytes(state.points.places) >
           kOwnCache;
}

ContactView contactView(State& state) {
    Blocks& blocks = state.blocks;
    Interfaces& f = state.interfaces;
    ContactPoints& points = state.points;
    return {.position = numbers(blocks.position),
            .orientation = numbers(blocks.orientation),
            .velocity = constPointers(blocks.velocity),
            .angular_velocity = constPointers(blocks.angular_velocity),
            .groups = f.groups.data(),
            .block_a = f.block_a.data(),
            .block_b = f.block_b.data(),
            .joint = f.joint.data(),
            .frames = f.frames.data(),
            .corners = f.corners.data(),
            .patch_area = f.area.data(),
            .laws = state.laws.data(),
            .point_places = points.places.data(),
            .memory = points.memory.data(),
            .wrenches = f.wrenches.empty() ? nullptr : f.wrenches.front().force.data(),
            .remembers = points.remembers(),
            .curved = hasCurves(state),
            .keeps_energy = state.springs == Springs::keep_energy,
            .beyond_caches = isBeyondCaches(state),
            .release = state.release,
            .contact_damping = state.damping.contact,
            .restitution = state.damping.restitution,
            .places = pointPlaces(state),
            .distributed = isDistributed(state)};
}

Triple<double> triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const Triple<double>& v) { return {v.x, v.y, v.z}; }

PoseOf<double> poseOf(const PositionArray& position, const QuaternionArray& orientation, std::int32_t block) {
    const auto b = static_cast<std::size_t>(block);
    const auto& [w, x, y, z] = orientation[b];
    return {triple(position.get(b)), simd::rotationOf(w, x, y, z)};
}

double affineAt(const Vec3& f, const Eigen::Vector2d& place) {
    return affine<double>({f.x(), f.y(), f.z()}, place.x(), place.y());
}

/// A patch that is partly open, with the rule "distributed".
struct Shares {
    std::vector<double> overlap{};  ///< mean of each contact point's share [m]; empty: the patch is no such
    double energy = 0;              ///< of the pressure k_n overlap, over k_n [m^4]
};

bool isPartlyOpen(const std::vector<Eigen::Vector2d>& outline, const Vec3& gap) {
    double least = kInfinity, most = -kInfinity;
    for (const Eigen::Vector2d& corner : outline) {
        least = std::min(least, affineAt(gap, corner));
        most = std::max(most, affineAt(gap, corner));
    }
    return least < 0 && most > 0;
}

/// The origin is the patch's centroid.
Shares sharesOn(const std::vector<Eigen::Vector2d>& outline, const Vec3& gap, const PointRule& rule) {
    if (rule.kind != PointRule::Kind::distributed || outline.size() == 1 || !isPartlyOpen(outline, gap))
        return {};
    const std::size_t m = outline.size();
    Shares shares{std::vector<double>(2 * m + 1)};
    std::vector<double> area(2 * m + 1);
    for (std::size_t k = 0; k < m; ++k) {
        const Eigen::Vector2d &here = outline[k], &next = outline[(k + 1) % m];
        const double triangle = 0.5 * (here.x() * next.y() - here.y() * next.x());
        const double overlap[3]{-affineAt(gap, here), -affineAt(gap, next), -gap.x()};
        const contact::TriangleShares of = contact::sharesOf(overlap);
        const std::size_t points[4]{k, (k + 1) % m, m, m + 1 + k};
        for (std::size_t p = 0; p < 4; ++p) {
            shares.overlap[points[p]] += triangle * of.overlap[p];
            area[points[p]] += triangle * (p == 3 ? 0.75 : 1.0 / 12);
        }
        for (int i = 0; i < 3; ++i)
            shares.energy += 0.5 * triangle * overlap[i] * (of.overlap[i] + of.overlap[3] / 3);
    }
    for (std::size_t p = 0; p < area.size(); ++p) shares.overlap[p] /= area[p] > 0 ? area[p] : kInfinity;
    return shares;
}

}  // namespace

PointPlaces pointPlaces(const State& state) {
    switch (state.geometry->model.points.kind) {
        case PointRule::Kind::vertex:
        case PointRule::Kind::distributed:
            return PointPlaces::vertex;
        case PointRule::Kind::corner:
            return PointPlaces::corner;
        case PointRule::Kind::quarter:
        case PointRule::Kind::grid:
            break;
    }
    return PointPlaces::stored;
}

bool isDistributed(const State& state) {
    return state.geometry->model.points.kind == PointRule::Kind::distributed;
}

bool hasCurves(const State& state) {
    return std::any_of(state.laws.begin(), state.laws.end(), [](const auto& law) { return law.curved; });
}

RelativePose relativePose(const PositionArray& position, const QuaternionArray& orientation,
                          const Interfaces& interfaces, std::size_t interface) {
    assert(interface < interfaces.size());
    const InterfaceFrame frame = interfaces.frame(interface);
    const FramesOf<double> frames{triple(frame.origin_a),     triple(frame.e1_a), triple(frame.e2_a),
                                  triple(frame.origin_b),     triple(frame.e1_b), triple(frame.e2_b),
                                  triple(frame.reference_gap)};
    const PoseOf<double> a = poseOf(position, orientation, interfaces.block_a[interface]);
    const PoseOf<double> b = poseOf(position, orientation, interfaces.block_b[interface]);
    const auto pose = relativePoseOf(frames, a, b);
    return {vec3(pose.gap), vec3(pose.slide_1), vec3(pose.slide_2), vec3(a.position + pose.arm_a),
            vec3(pose.e1),  vec3(pose.e2),      vec3(pose.e3)};
}

RelativePose relativePose(const Blocks& blocks, const Interfaces& interfaces, std::size_t interface) {
    return relativePose(blocks.position, blocks.orientation, interfaces, interface);
}

RelativePose relativePose(const State& state, std::size_t i) {
    return relativePose(state.blocks, state.interfaces, i);
}

void updateContacts(State& state, Range groups) {
    assert(groups.begin <= groups.end && groups.end <= state.interfaces.groups.size());
    assert((state.damping.contact == 0 && !state.damping.restitution) ||
           state.blocks.angular_velocity.size() == state.blocks.size());
    simd::buildFor(state.instructions, updateContactsScalar, updateContactsAvx2, updateContactsAvx512)(
        contactView(state), groups.begin, groups.end);
}

Contacts contactsOf(const State& state) {
    return {state.blocks, state.interfaces, state.points, state.laws, state.geometry->model.points};
}

std::vector<ContactPoint> contactPoints(const State& state, std::size_t i) {
    return contactPoints(contactsOf(state), i);
}

std::vector<ContactPoint> contactPoints(const Contacts& contacts, std::size_t i) {
    constexpr double kNoRelease = 0.0;
    const Interfaces& f = contacts.interfaces;
    const contact::JointLaw& law = contacts.laws[static_cast<std::size_t>(f.joint[i])];
    const RelativePose pose = relativePose(contacts.blocks, f, i);
    const Shares shares = sharesOn(patchOutline(f, i), pose.gap, contacts.rule);
    std::vector<ContactPoint> result;
    for (const contact::PatchPoint& place : interfacePoints(f, i, contacts.rule)) {
        const std::size_t k = result.size();
        ContactPoint point{.position = place.position,
                           .area = place.area,
                           .gap = affineAt(pose.gap, place.position),
                           .force = {},
                           .memory = contacts.points.memoryAt(f.pointSlot(i, k))};
        if (!shares.overlap.empty())
            point.gap = contact::gapOfShare<double>(law, point.memory.bond, point.gap, shares.overlap[k]);
        contact::PointMemory scratch = point.memory;
        point.force = contact::contactLaw(law, place.area, point.gap, affineAt(pose.slide_1, place.position),
                                          affineAt(pose.slide_2, place.position), kNoRelease, scratch);
        result.push_back(point);
    }
    return result;
}

double storedEnergy(const Contacts& contacts, std::size_t i) {
    const contact::JointLaw& law = contacts.laws[static_cast<std::size_t>(contacts.interfaces.joint[i])];
    double sum = 0;
    bool share_all = true;
    const std::vector<ContactPoint> points = contactPoints(contacts, i);
    for (const ContactPoint& point : points) {
        sum += contact::storedEnergy(law, point.area, point.memory.bond, point.force);
        share_all = share_all && contact::followsShare<double>(law, point.memory.bond) == 1;
    }
    if (!share_all || contacts.rule.kind != PointRule::Kind::distributed) return sum;
    const Shares shares = sharesOn(patchOutline(contacts.interfaces, i),
                                   relativePose(contacts.blocks, contacts.interfaces, i).gap, contacts.rule);
    if (shares.overlap.empty()) return sum;
    // The pressure varies over a share: the energy is that of the pressure, not of its mean.
    for (const ContactPoint& point : points)
        sum -= contact::normalEnergy(law, point.area, point.force.normal);
    return sum + law.normal_stiffness * shares.energy;
}

}  // namespace talus
