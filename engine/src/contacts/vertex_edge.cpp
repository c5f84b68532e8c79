#include "contacts/vertex_edge.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <optional>

#include "contacts/corner_rounding.h"
#include "contacts/deep_contacts.h"
#include "contacts/limits.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "state/placed_shape.h"
#include "state/point_layout.h"
#include "state/range.h"

namespace talus {
namespace {

// Reference gap of a place that touches nothing: the kernel finds it open [m].
constexpr double kNeverCloses = -1e30;
constexpr double kTravel =
    2e-4;                        // of the smaller block's size: displacement of a near pair between two looks
constexpr double kFaster = 1.5;  // times: largest growth of a pair's speed between two looks
constexpr double kSamePlace = 1e-9;  // of the smaller block's size: the same vertex
constexpr double kNearPlace =
    0.1;  // of the smaller block's size: a new contact point this near takes the force of an old one
constexpr double kSameNormal = 0.9;  // cosine, likewise
constexpr std::size_t kPlaces = kPlacesOfPair;
static_assert(kPlaces == VertexEdgePoints::kMost);

void setIdle(Interfaces& f, std::size_t i) {
    f.idle[i] = 1;
    f.setReferenceGap(i, {kNeverCloses, 0, 0});
}

/// Hands an interface over to the other block as its reference.
void swapSides(State& state, std::size_t i) {
    Interfaces& f = state.interfaces;
    Incidence& incidence = state.incidence;
    for (const std::int32_t block : {f.block_a[i], f.block_b[i]}) {
        const auto b = static_cast<std::size_t>(block);
        // A block's interfaces are sorted, and the ground has very many.
        const auto first = incidence.interface.begin();
        const auto at =
            std::lower_bound(first + incidence.interface_begin[b], first + incidence.interface_begin[b + 1],
                             static_cast<std::int32_t>(i));
        assert(at != incidence.interface.end() && *at == static_cast<std::int32_t>(i));
        incidence.wrench[static_cast<std::size_t>(at - first)] ^= 1;  // the other side
    }
    std::swap(f.block_a[i], f.block_b[i]);
    std::swap(f.face_a[i], f.face_b[i]);
}

bool isSamePlace(const State& state, std::size_t i, const VertexEdgePoint& point, double tolerance) {
    const Interfaces& f = state.interfaces;
    return !isIdle(f, i) && f.face_a[i] == point.reference_face && f.face_b[i] == point.other_face &&
           (f.frame(i).origin_b - toOwn(state.blocks, f.block_b[i], point.on_other)).norm() <= tolerance &&
           relativePose(state, i).e3.dot(point.e1.cross(point.e2)) > 1.0 - kSamePlace;
}

/// A contact that was found late and has opened closes again at the blocks' surfaces.
void releaseGap(State& state, std::size_t i) {
    double& reference = state.interfaces.referenceGap(i, 0);
    const double opening = relativePose(state, i).gap.x();
    if (reference < 0 && opening > 0) reference = std::min(0.0, reference + opening);
}

double shearEnergy(const contact::JointLaw& law, double area, double along_1, double along_2) {
    constexpr double kNoBond = 0;
    contact::PointForce force;
    force.shear_1 = along_1;
    force.shear_2 = along_2;
    return contact::storedEnergy(law, area, kNoBond, force);
}

/// Limits the shear force that a place takes over: one spring with the force of two may hold more energy than
/// both did.
double shareKept(const State& state, const contact::JointLaw& law, double area, const CarriedPoint& from) {
    const double holds = shearEnergy(law, area, from.shear.norm(), 0.0);
    const bool all = state.springs == Springs::follow_gaps || holds <= from.shear_energy;
    return all ? 1.0 : std::sqrt(from.shear_energy / holds);
}

/// Puts a place where two blocks meet, with the forces of `from`.
void placeContact(State& state, std::size_t i, const VertexEdgePoint& point, const CarriedPoint& from) {
    Interfaces& f = state.interfaces;
    const Blocks& blocks = state.blocks;
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    const Mat3 to_a = blocks.orientation.matrix(a).transpose(),
               to_b = blocks.orientation.matrix(b).transpose();
    f.face_a[i] = point.reference_face;
    f.face_b[i] = point.other_face;
    f.joint[i] = state.geometry->joints.between(a, static_cast<std::size_t>(point.reference_face), b,
                                                static_cast<std::size_t>(point.other_face));
    InterfaceFrame frame = f.frame(i);
    frame.origin_a = toOwn(blocks, f.block_a[i], point.on_reference);
    frame.origin_b = toOwn(blocks, f.block_b[i], point.on_other);
    frame.e1_a = to_a * point.e1;
    frame.e2_a = to_a * point.e2;
    frame.e1_b = to_b * point.e1;
    frame.e2_b = to_b * point.e2;
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
    const double depth = contact::pressedBy(law, f.area[i], 0.0, from.energy);
    frame.reference_gap = {std::min(0.0, point.gap + depth), 0, 0};
    f.setFrame(i, frame);
    f.idle[i] = 0;
    // F_s = k_s A (offset - slide), the slide now zero.
    const double sign = (f.block_a[i] < f.block_b[i] ? 1.0 : -1.0) * shareKept(state, law, f.area[i], from);
    state.points.setMemory(f.pointSlot(i, 0),
                           {.offset_1 = contact::offsetFor(law, f.area[i], sign * from.shear.dot(point.e1)),
                            .offset_2 = contact::offsetFor(law, f.area[i], sign * from.shear.dot(point.e2)),
                            .bond = law.bonded ? 0.0 : 1.0,
                            .dilation = 0.0});
}

/// Assigns each vanished contact point to the nearest new one.
std::array<CarriedPoint, kPlaces> shareOut(const std::vector<CarriedPoint>& old,
                                           const VertexEdgePoints& found,
                                           const std::array<bool, kPlaces>& is_new, double sign,
                                           double near) {
    std::array<CarriedPoint, kPlaces> shares{};
    for (const CarriedPoint& point : old) {
        std::optional<std::size_t> nearest;
        double least = kInfinity;
        for (std::size_t k = 0; k < found.count; ++k) {
            const double distance = (found.points[k].on_other - point.place).norm();
            if (!is_new[k] || distance >= least) continue;
            least = distance;
            nearest = k;
        }
        if (!nearest) continue;
        const VertexEdgePoint& to = found.points[*nearest];
        const double turned = to.second_is_reference ? -sign : sign;
        shares[*nearest].energy += point.energy;
        if (least <= near && turned * to.e1.cross(to.e2).dot(point.normal) >= kSameNormal)
            shares[*nearest].shear += point.shear, shares[*nearest].shear_energy += point.shear_energy;
    }
    return shares;
}

/// Which place a found point has already; -1: none.
using Kept = std::array<int, kPlaces>;

Kept findKept(const State& state, std::size_t begin, const VertexEdgePoints& found, double size) {
    Kept kept;
    kept.fill(-1);
    const bool second_is_reference = found.count > 0 && found.points[0].second_is_reference;
    if (second_is_reference) return kept;
    for (std::size_t k = 0; k < found.count; ++k)
        for (std::size_t s = 0; s < kPlaces; ++s)
            if (std::find(kept.begin(), kept.end(), static_cast<int>(s)) == kept.end() && kept[k] < 0 &&
                isSamePlace(state, begin + s, found.points[k], kSamePlace * size))
                kept[k] = static_cast<int>(s);
    return kept;
}

/// Writes what was found into the places that begin at `begin`. \return whether any has changed
bool writePlaces(State& state, std::size_t begin, const VertexEdgePoints& found,
                 std::vector<CarriedPoint> old, double size) {
    Interfaces& f = state.interfaces;
    const Kept kept = findKept(state, begin, found, size);
    bool changes = false;
    const auto isKept = [&](std::size_t s) {
        return std::find(kept.begin(), kept.end(), static_cast<int>(s)) != kept.end();
    };
    for (std::size_t s = 0; s < kPlaces; ++s) {
        if (isKept(s)) {
            releaseGap(state, begin + s);
            continue;
        }
        if (isIdle(f, begin + s)) continue;
        const std::vector<CarriedPoint> gone = carriedPoints(contactsOf(state), begin + s);
        old.insert(old.end(), gone.begin(), gone.end());
        setIdle(f, begin + s);
        changes = true;
    }
    std::array<bool, kPlaces> is_new{};
    for (std::size_t k = 0; k < found.count; ++k) is_new[k] = kept[k] < 0;
    std::array<bool, kPlaces> rounded_off{};
    for (std::size_t k = 0; k < found.count; ++k)
        rounded_off[k] = is_new[k] && isRoundedOff(state, begin, found.points[k], size);
    const double sign = f.block_a[begin] < f.block_b[begin] ? 1.0 : -1.0;
    const auto shares = shareOut(old, found, is_new, sign, kNearPlace * size);
    if (found.count > 0 && found.points[0].second_is_reference)
        for (std::size_t s = 0; s < kPlaces; ++s) swapSides(state, begin + s);
    std::size_t next = 0;
    for (std::size_t k = 0; k < found.count; ++k) {
        if (!is_new[k]) continue;
        const bool inherits = shares[k].energy > 0 || !shares[k].shear.isZero();
        if (!inherits && rounded_off[k]) continue;
        while (isKept(next)) ++next;
        placeContact(state, begin + next++, found.points[k], shares[k]);
        changes = true;
    }
    return changes;
}

bool anyClosed(const State& state, std::size_t begin) {
    for (std::size_t s = begin; s < begin + kPlaces; ++s)
        if (!isIdle(state.interfaces, s) && relativePose(state, s).gap.x() < 0) return true;
    return false;
}

/// A pair of parts with places, and what was found where it is now.
struct Look {
    VertexEdgePoints found;
    bool changes = false;   ///< from faces to a vertex or edge, or the other way round
    bool no_faces = false;  ///< they are pressed together by two faces without an interface
    bool stays = false;  ///< they overlap so deeply that their contacts are kept (contacts/deep_contacts.h)
    double size = 0;     ///< of the smaller block [m]
    double travel = 0;   ///< until the next look [m]
};

/// Where two parts meet, with the faces' numbers in their blocks.
VertexEdgePoints findMeeting(const PlacedPart& first, const PlacedPart& second,
                             const VertexEdgeLimits& limits) {
    VertexEdgePoints found = findVertexEdgePoints(first.world(), second.world(), limits);
    for (std::size_t k = 0; k < found.count; ++k) {
        VertexEdgePoint& point = found.points[k];
        point.reference_face += (point.second_is_reference ? second : first).firstFace();
        point.other_face += (point.second_is_reference ? first : second).firstFace();
    }
    if (found.first_face >= 0) found.first_face += first.firstFace();
    if (found.second_face >= 0) found.second_face += second.firstFace();
    return found;
}

/// The same where even parallel faces do not count as one contact of faces.
VertexEdgePoints withoutFaces(const PlacedPart& first, const PlacedPart& second, VertexEdgeLimits limits) {
    limits.face_angle = -1.0;
    limits.angle_per_depth = 0.0;
    return findMeeting(first, second, limits);
}

/// Least gap (or, negative, overlap) of two faces without an interface before a search must make one [m].
/// Where springs keep their energy, a contact found pressed counts its gap from there
/// (contacts/carry_over.h), and a block that stops stays there. So the interface must exist before the faces
/// touch; within half the reach they cannot touch before the next look. Where forces follow the gaps, a late
/// contact carries the same force.
double nearestWithoutInterface(const State& state, const Look& look, const VertexEdgeLimits& limits) {
    return state.springs == Springs::keep_energy ? 0.5 * limits.reach : -look.travel;
}

/// Whether the contacts of two parts are so deep that they are kept.
/// \param faces  the interface of the faces that meet now, -1: none
bool contactsStay(const State& state, std::size_t begin, const VertexEdgePoints& found, std::int32_t faces) {
    if (state.springs != Springs::keep_energy || found.distance >= 0) return false;
    const bool would_change = found.count > 0 || faces < 0;
    return would_change && (pushAgainst(state, begin, found.axis) || areHeldByFaces(state, begin));
}

/// \param searched whether faces without an interface now will get none
Look lookAtPair(const State& state, std::size_t begin, double ahead, bool searched) {
    const Interfaces& f = state.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[begin]), b = static_cast<std::size_t>(f.block_b[begin]);
    const Geometry& geometry = *state.geometry;
    const VertexEdgeLimits limits =
        vertexEdgeLimits(geometry, a, b, 2.0 * ahead * (speedBound(state, a) + speedBound(state, b)));
    Look look;
    look.size = std::min(geometry.size[a], geometry.size[b]);
    const double apart = (state.blocks.position.get(a) - state.blocks.position.get(b)).norm() -
                         geometry.radius[a] - geometry.radius[b];
    look.travel = std::max(apart, kTravel * look.size);
    if (apart > limits.reach) return look;
    const PlacedPart first(state, partOf(geometry, f.block_a[begin], f.face_a[begin])),
        second(state, partOf(geometry, f.block_b[begin], f.face_b[begin]));
    look.found = findMeeting(first, second, limits);
    if (!look.found.near) {
        look.travel = std::max(look.found.distance - 0.5 * limits.reach, kTravel * look.size);
        return look;
    }
    look.travel = kTravel * look.size;
    if (look.found.first_face < 0) return look;
    const std::int32_t faces = interfaceOfFaces(state, f.block_a[begin], look.found.first_face,
                                                f.block_b[begin], look.found.second_face);
    look.stays = contactsStay(state, begin, look.found, faces);
    if (look.stays) return look;
    if (look.found.count > 0) {
        look.changes = faces >= 0;
    } else if (faces >= 0) {
        // Twice the depth at which the search leaves it out, so that it does.
        look.changes = look.found.distance < -2.0 * kSliverDepth * look.size &&
                       f.area[static_cast<std::size_t>(faces)] < vertexEdgeArea(geometry, a, b);
    } else if (look.found.distance < nearestWithoutInterface(state, look, limits) ||
               anyClosed(state, begin)) {
        look.no_faces = true;
        look.changes = !searched;
        if (searched) look.found = withoutFaces(first, second, limits);
    }
    return look;
}

}  // namespace

std::vector<CarriedPoint> carriedPoints(const Contacts& contacts, std::size_t i) {
    const Interfaces& f = contacts.interfaces;
    const RelativePose pose = relativePose(contacts.blocks, f, i);
    const contact::JointLaw& law = contacts.laws[static_cast<std::size_t>(f.joint[i])];
    const double sign = f.block_a[i] < f.block_b[i] ? 1.0 : -1.0;
    std::vector<CarriedPoint> carried;
    for (const ContactPoint& point : contactPoints(contacts, i)) {
        if (point.force.normal <= 0) continue;
        const double slide_1 =
            pose.slide_1.x() + point.position.x() * pose.slide_1.y() + point.position.y() * pose.slide_1.z();
        const double slide_2 =
            pose.slide_2.x() + point.position.x() * pose.slide_2.y() + point.position.y() * pose.slide_2.z();
        carried.push_back({pose.origin + (point.position.x() + slide_1) * pose.e1 +
                               (point.position.y() + slide_2) * pose.e2,
                           sign * pose.e3,
                           sign * (point.force.shear_1 * pose.e1 + point.force.shear_2 * pose.e2),
                           contact::normalEnergy(law, point.area, point.force.normal),
                           shearEnergy(law, point.area, point.force.shear_1, point.force.shear_2)});
    }
    return carried;
}

void appendVertexEdgePlaces(State& state, std::int32_t part_1, std::int32_t part_2) {
    const Geometry& geometry = *state.geometry;
    const std::int32_t block_1 = geometry.part_block[static_cast<std::size_t>(part_1)],
                       block_2 = geometry.part_block[static_cast<std::size_t>(part_2)];
    const std::int32_t face_1 = firstFace(geometry, part_1), face_2 = firstFace(geometry, part_2);
    assert(block_1 != block_2);
    Interfaces& f = state.interfaces;
    const double area =
        vertexEdgeArea(geometry, static_cast<std::size_t>(block_1), static_cast<std::size_t>(block_2));
    for (std::size_t s = 0; s < kPlaces; ++s) {
        addToGroups(f, 1, 1);
        f.block_a.push_back(block_1);
        f.block_b.push_back(block_2);
        f.face_a.push_back(face_1);
        f.face_b.push_back(face_2);
        f.joint.push_back(0);
        f.area.push_back(area);
        f.kind.push_back(InterfaceKind::vertex_edge);
        f.idle.push_back(1);
        f.travel_left.push_back(0.0);
        f.faces_are_apart.push_back(0);
        f.setFrame(f.size() - 1, {.e1_a = Vec3::UnitX(),
                                  .e2_a = Vec3::UnitY(),
                                  .e1_b = Vec3::UnitX(),
                                  .e2_b = Vec3::UnitY(),
                                  .reference_gap = {kNeverCloses, 0, 0}});
        placeCorners(f, f.size() - 1, {Eigen::Vector2d::Zero()});
    }
}

namespace {

/// Calls each(begin) for the first place of every pair, in any order when `parallel`, and updates the idle
/// flags of their groups.
template <class Each>
void updatePairs(Interfaces& f, bool parallel, const Each& each) {
    static_assert(simd::kLanes % kPlaces == 0, "a group holds whole pairs");
    forRange(f.groups.size(), 16, parallel, [&](Range range) {
        for (std::size_t g = range.begin; g < range.end; ++g) {
            const InterfaceGroup& group = f.groups[g];
            if (!isVertexEdge(f, static_cast<std::size_t>(group.begin))) continue;
            assert(group.size % static_cast<std::int32_t>(kPlaces) == 0);
            for (std::int32_t i = 0; i < group.size; i += static_cast<std::int32_t>(kPlaces))
                each(static_cast<std::size_t>(group.begin + i));
            markIdle(f, g);
        }
    });
}

}  // namespace

PlaceChanges updateVertexEdges(State& state, double ahead, bool parallel, const std::vector<double>& moved,
                               bool may_wait, std::vector<char>* wanting) {
    assert(ahead >= 0 && (moved.empty() || moved.size() == state.blocks.size()));
    std::vector<double> ways = moved;
    if (moved.empty()) {
        ways.resize(state.blocks.size());
        for (std::size_t b = 0; b < ways.size(); ++b) ways[b] = kFaster * speedBound(state, b) * ahead;
    }
    const auto way_of = [&](std::int32_t block) { return ways[static_cast<std::size_t>(block)]; };
    const auto mark = [&](std::int32_t block) {
        const auto b = static_cast<std::size_t>(block);
        if (state.blocks.motion[b] != Motion::fixed) std::atomic_ref<char>{(*wanting)[b]}.store(1);
    };
    std::atomic<bool> search = false, places = false;
    updatePairs(state.interfaces, parallel, [&](std::size_t begin) {
        Interfaces& f = state.interfaces;
        double& left = f.travel_left[begin];
        left -= way_of(f.block_a[begin]) + way_of(f.block_b[begin]);
        if (left > 0) return;
        const Look look = lookAtPair(state, begin, ahead, may_wait || f.faces_are_apart[begin] != 0);
        if (look.changes) {
            search = !may_wait;
            left = may_wait ? look.travel : left;
            if (wanting != nullptr && !may_wait) {
                mark(f.block_a[begin]);
                mark(f.block_b[begin]);
            }
            return;
        }
        if (!look.stays && writePlaces(state, begin, look.found, {}, look.size)) places = true;
        left = look.travel;
    });
    return {.places = places, .search = search};
}

void renewVertexEdges(State& state, double ahead, bool parallel, const CarriedPoints& carried,
                      const std::vector<char>& around) {
    assert(ahead >= 0 && state.incidence.interface_begin.size() == state.blocks.size() + 1);
    const auto is_near = [&](std::int32_t block) {
        return around.empty() || around[static_cast<std::size_t>(block)] != 0;
    };
    updatePairs(state.interfaces, parallel, [&](std::size_t begin) {
        if (!is_near(state.interfaces.block_a[begin]) && !is_near(state.interfaces.block_b[begin])) return;
        const Look look = lookAtPair(state, begin, ahead, true);
        state.interfaces.faces_are_apart[begin] = look.no_faces ? 1 : 0;
        state.interfaces.travel_left[begin] = look.travel;
        if (look.stays) return;
        const auto of_pair = carried.find(partsOf(*state.geometry, state.interfaces, begin));
        writePlaces(state, begin, look.found,
                    of_pair == carried.end() ? std::vector<CarriedPoint>{} : of_pair->second, look.size);
    });
}

}  // namespace talus
