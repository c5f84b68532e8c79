#include "contacts/interfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>
#include <utility>

#include "contacts/carry_over.h"
#include "contacts/energy_balance.h"
#include "contacts/limits.h"
#include "contacts/pair_search.h"
#include "contacts/vertex_edge.h"
#include "forces/contact_forces.h"
#include "forces/water.h"
#include "law/points.h"
#include "state/caller.h"
#include "state/incidence.h"
#include "state/placed_shape.h"
#include "state/point_layout.h"

namespace talus {
namespace {

/// For each pair of blocks, the parts that overlap most.
std::vector<Error> overlapErrors(const State& state, const std::vector<PairFinding>& findings) {
    std::map<BoxPair, double> deepest;
    for (const PairFinding& finding : findings) {
        if (!finding.overlaps) continue;
        double& depth = deepest[std::minmax(finding.block_a, finding.block_b)];
        depth = std::max(depth, finding.depth);
    }
    std::vector<Error> errors;
    for (const auto& [pair, overlap] : deepest) {
        const auto& blocks = state.geometry->model.blocks;
        const Block& a = blocks[static_cast<std::size_t>(pair.first)];
        const Block& b = blocks[static_cast<std::size_t>(pair.second)];
        char depth[96];
        std::snprintf(depth, sizeof depth, "by %.3g m; allowed: at most 1e-4 of the block size", overlap);
        errors.push_back({b.field, "blocks \"" + a.name + "\" and \"" + b.name + "\" overlap " + depth});
    }
    return errors;
}

/// a's tangents projected along the normal into b's plane. A point of the patch is then the point of b's face
/// above it, and clipping changes no gap at any angle between the faces. Rotated tangents would keep unit
/// length; for faces this close to parallel the two agree to rounding.
std::pair<Vec3, Vec3> tangentsOfB(const Vec3& e1, const Vec3& e2, const Vec3& e3, const Vec3& normal_b) {
    constexpr double kSamePlaneAngle = 1e-5;  // [rad]
    if ((normal_b + e3).norm() <= kSamePlaneAngle) {
        const Vec3 b1 = (e1 - normal_b.dot(e1) * normal_b).normalized();
        return {b1, b1.cross(normal_b)};  // b1 x b2 = -normal_b, which points from a to b
    }
    const auto carried = [&](const Vec3& e) -> Vec3 { return e - normal_b.dot(e) / normal_b.dot(e3) * e3; };
    return {carried(e1), carried(e2)};
}

/// Appends one interface with frames at the patch's centroid; its group exists already.
void appendInterface(State& state, std::int32_t a, std::int32_t b, const FacePair& pair) {
    Interfaces& f = state.interfaces;
    const double patch_area = area(pair.patch);
    const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
    const Mat3 turn_a = state.blocks.orientation.matrix(ia), turn_b = state.blocks.orientation.matrix(ib);
    const Vec3 x_a = state.blocks.position.get(ia), x_b = state.blocks.position.get(ib);
    const auto face_a = static_cast<std::size_t>(pair.face_a), face_b = static_cast<std::size_t>(pair.face_b);

    const FaceFrame own = faceFrame(state.geometry->shape[ia], face_a);
    std::vector<Eigen::Vector2d> outline(pair.patch.begin(), pair.patch.end());
    const Eigen::Vector2d centre = centroid(pair.patch);
    for (Eigen::Vector2d& v : outline) v -= centre;
    const Vec3 origin_a = own.origin + centre.x() * own.e1 + centre.y() * own.e2;

    const Vec3 origin = x_a + turn_a * origin_a, e1 = turn_a * own.e1, e3 = turn_a * own.e3;
    const FaceFrame other = faceFrame(state.geometry->shape[ib], face_b);
    const Vec3 normal_b = turn_b * other.e3;
    const double gap = normal_b.dot(x_b + turn_b * other.origin - origin) / normal_b.dot(e3);
    const auto [b1, b2] = tangentsOfB(e1, turn_a * own.e2, e3, normal_b);

    f.block_a.push_back(a);
    f.block_b.push_back(b);
    f.face_a.push_back(pair.face_a);
    f.face_b.push_back(pair.face_b);
    f.joint.push_back(state.geometry->joints.between(ia, face_a, ib, face_b));
    f.area.push_back(patch_area);
    f.kind.push_back(InterfaceKind::faces);
    f.idle.push_back(0);
    f.travel_left.push_back(0.0);
    f.faces_are_apart.push_back(0);
    f.setFrame(f.size() - 1, {.origin_a = origin_a,
                              .e1_a = own.e1,
                              .e2_a = own.e2,
                              .origin_b = turn_b.transpose() * (origin + gap * e3 - x_b),
                              .e1_b = turn_b.transpose() * b1,
                              .e2_b = turn_b.transpose() * b2});
    placeCorners(f, f.size() - 1, outline);
}

void setBond(State& state, std::size_t i, double bond) {
    if (!state.points.remembers()) return;
    for (std::size_t k = 0; k < state.interfaces.pointCount(i); ++k)
        state.points.setBond(state.interfaces.pointSlot(i, k), bond);
}

/// Contacts made later have no bond to lose; without a bond they have their peak friction.
void breakBonds(State& state) {
    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
        if (state.laws[static_cast<std::size_t>(state.interfaces.joint[i])].bonded) setBond(state, i, 0.0);
}

/// Interfaces that touch at the start: their gap becomes the reference, their contact points are intact.
void closeInitialInterfaces(State& state) {
    Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isVertexEdge(f, i)) continue;
        const RelativePose pose = relativePose(state, i);
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        const double closed = kClosedGap * std::min(state.geometry->size[a], state.geometry->size[b]);
        double widest = 0, least = kInfinity;
        for (const Eigen::Vector2d& v : patchOutline(f, i)) {
            const double gap = pose.gap.x() + v.x() * pose.gap.y() + v.y() * pose.gap.z();
            widest = std::max(widest, std::abs(gap));
            least = std::min(least, gap);
        }
        if (widest > closed && least >= 0) continue;
        // Planes that are not parallel: only what overlaps is taken off.
        f.setReferenceGap(i, widest > closed ? Vec3(least, 0, 0) : pose.gap);
        setBond(state, i, 1.0);
    }
}

/// Appends an interface as it was before the search.
void appendKept(State& state, OldInterfaces& old, std::size_t o) {
    const Interfaces& from = old.interfaces;
    Interfaces& f = state.interfaces;
    const std::size_t corners = from.cornerCount(o);
    addToGroups(f, corners, from.pointCount(o));
    for (auto index : {&Interfaces::block_a, &Interfaces::block_b, &Interfaces::face_a, &Interfaces::face_b,
                       &Interfaces::joint})
        (f.*index).push_back((from.*index)[o]);
    f.area.push_back(from.area[o]);
    f.kind.push_back(from.kind[o]);
    f.idle.push_back(from.idle[o]);
    f.travel_left.push_back(from.travel_left[o]);
    f.faces_are_apart.push_back(from.faces_are_apart[o]);
    const std::size_t n = f.size() - 1;
    f.setFrame(n, from.frame(o));
    f.setWrench(n, from.wrench(o));
    growCorners(f, n);
    for (std::size_t k = 0; k < corners; ++k) {
        for (std::size_t axis = 0; axis < kCornerQuantities; ++axis)
            f.corners.set(f.cornerSlot(n, k), axis, from.corners.get(from.cornerSlot(o, k), axis));
    }
    old.kept_as[o] = static_cast<std::int64_t>(n);
}

/// Interfaces on their way into a state. They are stored in the order in which they are added. Within short
/// windows those with equal numbers of corners are side by side; neighbours in space stay neighbours in
/// memory.
class InterfaceWindow {
 public:
    InterfaceWindow(State& state, OldInterfaces& old) : state_(state), old_(old) {}

    /// To be made between a face of one block and one of another.
    void add(std::int32_t block_a, std::int32_t block_b, const FacePair& faces) {
        const auto index = static_cast<std::size_t>(faces_.size());
        faces_.push_back(faces);
        add({Kind::faces, faces.patch.size(), block_a, block_b, index});
    }
    /// Places of two parts that may meet by vertices or edges.
    void addPlaces(std::int32_t part_a, std::int32_t part_b) { add({Kind::places, 0, part_a, part_b}); }
    /// Consecutive interfaces from before the search, to be kept as they are.
    void addKept(std::size_t first, std::size_t count) {
        const Interfaces& from = old_.interfaces;
        add({Kind::kept, isVertexEdge(from, first) ? 0 : from.cornerCount(first), 0, 0, first, count});
    }
    /// What was added last.
    void append() {
        std::size_t most = 0;
        for (const Entry& entry : entries_) most = std::max(most, entry.corners);
        for (std::size_t corners = 0; corners <= most; ++corners) {
            for (const Entry& entry : entries_)
                if (entry.corners == corners) append(entry);
        }
        entries_.clear();
        faces_.clear();
    }

 private:
    static constexpr std::size_t kSize = 256;
    enum class Kind : std::uint8_t { faces, places, kept };
    struct Entry {
        Kind kind;
        std::size_t corners;    ///< 0: places
        std::int32_t a, b;      ///< blocks, or parts
        std::size_t first = 0;  ///< in faces_, or of before the search
        std::size_t count = 0;
    };

    void add(const Entry& entry) {
        entries_.push_back(entry);
        if (entries_.size() == kSize) append();
    }

    void append(const Entry& entry) {
        switch (entry.kind) {
            case Kind::kept:
                for (std::size_t k = 0; k < entry.count; ++k) appendKept(state_, old_, entry.first + k);
                return;
            case Kind::places:
                appendVertexEdgePlaces(state_, entry.a, entry.b);
                return;
            case Kind::faces:
                break;
        }
        const FacePair& faces = faces_[entry.first];
        addToGroups(state_.interfaces, faces.patch.size(),
                    contact::pointCount(std::span(faces.patch.begin(), faces.patch.size()),
                                        state_.geometry->model.points));
        appendInterface(state_, entry.a, entry.b, faces);
    }

    State& state_;
    OldInterfaces& old_;
    std::vector<Entry> entries_{};
    std::vector<FacePair> faces_{};
};

Error gridError(const State& state, const PairFinding& finding, const FacePair& pair) {
    const auto& blocks = state.geometry->model.blocks;
    return {"contact.points", "\"grid N\" needs rectangular patches; the one between \"" +
                                  blocks[static_cast<std::size_t>(finding.block_a)].name + "\" and \"" +
                                  blocks[static_cast<std::size_t>(finding.block_b)].name + "\" has " +
                                  std::to_string(pair.patch.size()) + " corners"};
}

bool suitsRule(const State& state, const FacePair& pair) {
    return state.geometry->model.points.kind != PointRule::Kind::grid ||
           contact::isRectangle({pair.patch.begin(), pair.patch.end()});
}

/// Results of a search beside the interfaces.
struct SearchRemarks {
    std::vector<PairFinding> overlaps;  ///< without their faces
    std::vector<Error> grid{};          ///< the first patch that is no rectangle where the rule asks for one
    bool stopped = false;
};

/// All earlier interfaces outside the search; the places of a pair stay together.
void appendFarFrom(const SearchRange& range, const State& state, OldInterfaces& old,
                   InterfaceWindow& window) {
    const Interfaces& from = old.interfaces;
    old.kept_as.assign(from.size(), -1);
    for (std::size_t o = 0, next = 0; o < from.size(); o = next) {
        next = o + 1;
        if (isVertexEdge(from, o)) {
            const auto parts = partsOf(*state.geometry, from, o);
            while (next < from.size() && isVertexEdge(from, next) &&
                   partsOf(*state.geometry, from, next) == parts)
                ++next;
        }
        if (!range.has(static_cast<std::size_t>(from.block_a[o]), static_cast<std::size_t>(from.block_b[o])))
            window.addKept(o, next - o);
    }
}

SearchRemarks appendInterfaces(State& state, OldInterfaces& old, const SearchRange& range,
                               const KnownPairs& known, bool initial, bool parallel, const Control& control) {
    SearchRemarks remarks;
    InterfaceWindow window(state, old);
    if (!range.around.empty()) appendFarFrom(range, state, old, window);
    const auto take = [&](const PairFinding& finding) {
        if (finding.overlaps)
            remarks.overlaps.push_back({{},
                                        finding.block_a,
                                        finding.block_b,
                                        finding.part_a,
                                        finding.part_b,
                                        false,
                                        true,
                                        finding.depth});
        for (const FacePair& pair : finding.faces) {
            if (initial && remarks.grid.empty() && !suitsRule(state, pair))
                remarks.grid.push_back(gridError(state, finding, pair));
            if (remarks.grid.empty()) window.add(finding.block_a, finding.block_b, pair);
        }
        if (finding.may_meet_by_vertices) window.addPlaces(finding.part_a, finding.part_b);
    };
    remarks.stopped = !examinePairs(state, range, known, initial, parallel, take, control);
    window.append();
    return remarks;
}

std::vector<Error> touchErrors(const State& state) {
    std::vector<Error> errors;
    const Model& model = state.geometry->model;
    for (const PairJoint& pair : model.pair_joints) {
        if (!pair.must_touch) continue;
        if (largestInterface(state, pair.block_a, pair.block_b) < 0)
            errors.push_back({pair.field + ".between",
                              "blocks \"" + model.blocks[static_cast<std::size_t>(pair.block_a)].name +
                                  "\" and \"" + model.blocks[static_cast<std::size_t>(pair.block_b)].name +
                                  "\" share no interface; allowed: two blocks whose faces touch"});
    }
    return errors;
}

/// Of the blocks around which was searched, or of all.
void keepSearchPoses(State& state, const std::vector<char>& around) {
    if (around.empty()) {
        state.search_position = state.blocks.position;
        state.search_orientation = state.blocks.orientation;
        return;
    }
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (!around[b]) continue;
        state.search_position.set(b, state.blocks.position.get(b));
        state.search_orientation[b] = state.blocks.orientation[b];
    }
}

std::vector<Error> interrupted() { return {{"", "interrupted while its contacts were searched for"}}; }

}  // namespace

std::vector<Error> makeInterfaces(State& state, const SearchRange& range, bool initial, bool parallel,
                                  const Control& control) {
    const bool keeps_energy = state.springs == Springs::keep_energy;
    const KnownPairs known{pairsWithPlaces(*state.geometry, state.interfaces, range),
                           narrowPatchesCount(state, initial) ? PartPairs{} : pairsThatBear(state, range),
                           keeps_energy ? deepFaces(state, range) : std::vector<DeepFaces>{}};
    const std::vector<PairEnergy> held =
        keeps_energy ? energyOfPairs(contactsOf(state)) : std::vector<PairEnergy>{};
    OldInterfaces old = takeInterfaces(state, range.near);
    const SearchRemarks remarks = appendInterfaces(state, old, range, known, initial, parallel, control);
    if (remarks.stopped) {
        state.interfaces = std::move(old.interfaces);
        state.points = std::move(old.points);
        return interrupted();
    }
    if (initial) {
        std::vector<Error> errors = overlapErrors(state, remarks.overlaps);
        if (errors.empty()) errors = remarks.grid;
        if (!errors.empty()) return errors;
    }
    makePoints(state);
    breakBonds(state);
    CarriedPoints carried;
    if (initial)
        closeInitialInterfaces(state);
    else
        carried = carryOver(old, state, range.ahead);
    if (initial && isStopped(control)) return interrupted();
    buildIncidence(state);
    renewVertexEdges(state, range.ahead, parallel, carried, range.around);
    if (keeps_energy) balanceEnergy(state, held);
    keepSearchPoses(state, range.around);
    state.search_margin = range.margin;
    if (initial) return touchErrors(state);
    rebuildPairWater(state);
    return {};
}

}  // namespace talus
