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

/// What the law takes at a contact point of a partly open patch.
struct PointShare {
    double overlap = 0;  ///< mean [m]
    double closed = 0;   ///< of its area
};

/// A patch that is partly open, with the rule "distributed".
struct Shares {
    std::vector<PointShare> points{};  ///< empty: the patch is no such
    double energy = 0;                 ///< of the pressure k_n overlap, over k_n [m^4]
};

bool isPartlyOpen(const std::vector<Eigen::Vector2d>& outline, const Vec3& gap) {
    double least = kInfinity, most = -kInfinity;
    for (const Eigen::Vector2d& corner : outline) {
        least = std::min(least, affineAt(gap, corner));
        most = std::max(most, affineAt(gap, corner));
    }
    return least < 0 && most > 0;
}

Shares sharesOf(const Interfaces& interfaces, std::size_t interface, const Vec3& gap, const PointRule& rule) {
    if (rule.kind != PointRule::Kind::distributed || interfaces.cornerCount(interface) == 1) return {};
    const std::vector<Eigen::Vector2d> outline = patchOutline(interfaces, interface);
    if (!isPartlyOpen(outline, gap)) return {};
    // The origin is the patch's centroid.
    const std::size_t m = outline.size();
    Shares shares{std::vector<PointShare>(2 * m + 1)};
    std::vector<double> area(2 * m + 1);
    for (std::size_t k = 0; k < m; ++k) {
        const Eigen::Vector2d &here = outline[k], &next = outline[(k + 1) % m];
        const double triangle = 0.5 * (here.x() * next.y() - here.y() * next.x());
        const double overlap[3]{-affineAt(gap, here), -affineAt(gap, next), -gap.x()};
        const contact::TriangleShares of = contact::sharesOf(overlap);
        const std::size_t points[4]{k, (k + 1) % m, m, m + 1 + k};
        for (std::size_t p = 0; p < 4; ++p) {
            shares.points[points[p]].overlap += triangle * of.overlap[p];
            shares.points[points[p]].closed += triangle * of.closed[p];
            area[points[p]] += triangle * (p == 3 ? 0.75 : 1.0 / 12);
        }
        for (int i = 0; i < 3; ++i)
            shares.energy += 0.5 * triangle * overlap[i] * (of.overlap[i] + of.overlap[3] / 3);
    }
    for (std::size_t p = 0; p < area.size(); ++p) {
        const double whole = area[p] > 0 ? area[p] : kInfinity;
        shares.points[p].overlap /= whole;
        shares.points[p].closed /= whole;
    }
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

bool isPartlyOpen(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    return f.cornerCount(i) > 1 && isPartlyOpen(patchOutline(f, i), relativePose(state, i).gap);
}

Contacts contactsOf(const State& state) {
    return {state.blocks, state.interfaces, state.points, state.laws, state.geometry->model.points};
}

std::vector<ContactPoint> contactPoints(const State& state, std::size_t i) {
    return contactPoints(contactsOf(state), i);
}

namespace {

/// A contact point with its force. \param share  where the patch is partly open; else null
ContactPoint pointAt(const Contacts& contacts, std::size_t i, std::size_t k, const contact::PatchPoint& place,
                     const RelativePose& pose, const PointShare* share) {
    constexpr double kNoRelease = 0.0;
    const Interfaces& f = contacts.interfaces;
    const contact::JointLaw& law = contacts.laws[static_cast<std::size_t>(f.joint[i])];
    ContactPoint point{.position = place.position,
                       .area = place.area,
                       .gap = affineAt(pose.gap, place.position),
                       .force = {},
                       .memory = contacts.points.memoryAt(f.pointSlot(i, k))};
    if (share != nullptr) {
        point.gap =
            contact::gapOfShare<double>(law, point.memory.bond, point.gap, share->overlap, share->closed);
        point.cohesive = contact::cohesiveShare<double>(law, point.memory.bond, share->closed);
    }
    contact::PointMemory scratch = point.memory;
    point.force =
        contact::contactLaw(law, place.area, point.gap, affineAt(pose.slide_1, place.position),
                            affineAt(pose.slide_2, place.position), kNoRelease, scratch, point.cohesive);
    return point;
}

/// Calls use(point) for the contact points of an interface, in order.
template <class Use>
void forEachPoint(const Contacts& contacts, std::size_t i, const RelativePose& pose, const Shares& shares,
                  const Use& use) {
    const Interfaces& f = contacts.interfaces;
    if (f.cornerCount(i) == 1) return use(pointAt(contacts, i, 0, onlyPoint(f, i), pose, nullptr));
    std::size_t k = 0;
    for (const contact::PatchPoint& place : interfacePoints(f, i, contacts.rule)) {
        use(pointAt(contacts, i, k, place, pose, shares.points.empty() ? nullptr : &shares.points[k]));
        ++k;
    }
}

/// Whether a patch is open all over, by more than rounding, and has no bond: then it holds no energy.
bool isClearlyOpen(const Contacts& contacts, std::size_t i, const Vec3& gap) {
    constexpr double kRounding = 1e-9;  // of the widest gap
    const Interfaces& f = contacts.interfaces;
    if (contacts.points.remembers() || contacts.laws[static_cast<std::size_t>(f.joint[i])].curved)
        return false;
    double least = kInfinity, most = 0;
    for (std::size_t k = 0; k < f.cornerCount(i); ++k) {
        const std::size_t slot = f.cornerSlot(i, k);
        const double at_corner = affineAt(gap, {f.corners.get(slot, 0), f.corners.get(slot, 1)});
        least = std::min(least, at_corner);
        most = std::max(most, at_corner);
    }
    return least > kRounding * most;
}

}  // namespace

std::vector<ContactPoint> contactPoints(const Contacts& contacts, std::size_t i) {
    const RelativePose pose = relativePose(contacts.blocks, contacts.interfaces, i);
    std::vector<ContactPoint> result;
    result.reserve(contacts.interfaces.pointCount(i));
    forEachPoint(contacts, i, pose, sharesOf(contacts.interfaces, i, pose.gap, contacts.rule),
                 [&](const ContactPoint& point) { result.push_back(point); });
    return result;
}

double storedEnergy(const Contacts& contacts, std::size_t i) {
    const contact::JointLaw& law = contacts.laws[static_cast<std::size_t>(contacts.interfaces.joint[i])];
    const RelativePose pose = relativePose(contacts.blocks, contacts.interfaces, i);
    if (isClearlyOpen(contacts, i, pose.gap)) return 0.0;
    const Shares shares = sharesOf(contacts.interfaces, i, pose.gap, contacts.rule);
    double sum = 0;
    bool share_all = true;
    forEachPoint(contacts, i, pose, shares, [&](const ContactPoint& point) {
        sum += contact::storedEnergy(law, point.area, point.memory.bond, point.force);
        share_all = share_all && contact::followsShare<double>(law, point.memory.bond) == 1;
    });
    if (!share_all || shares.points.empty()) return sum;
    // The pressure varies over a share: the energy is that of the pressure, not of its mean.
    forEachPoint(contacts, i, pose, shares, [&](const ContactPoint& point) {
        sum -= contact::normalEnergy(law, point.area, point.force.normal);
    });
    return sum + law.normal_stiffness * shares.energy;
}

}  // namespace talus
