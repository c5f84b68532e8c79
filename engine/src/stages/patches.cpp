#include "stages/patches.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "contact/points.h"
#include "stages/carry_over.h"
#include "stages/contacts.h"
#include "stages/late_contacts.h"
#include "stages/measure.h"
#include "stages/pair_search.h"
#include "stages/sharp_contacts.h"
#include "stages/water.h"
#include "state/build.h"
#include "state/point_layout.h"
#include "state/range.h"

namespace talus::stages {
namespace {

constexpr double kSearchMargin = 0.05;  // of the median block size: pairs nearer than this are interfaces
constexpr double kSlideLimit =
    0.01;  // of the root of the patch area or the smaller block's size, the larger of the
           // two: then the patch is clipped again

double searchMargin(const State& state, double ahead) {
    double fastest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        fastest = std::max(fastest, state.blocks.velocity.get(b).norm() +
                                        angularVelocity(state.blocks, b).norm() * state.geometry->radius[b]);
    return std::max(kSearchMargin * state.geometry->length_scale, 4.0 * fastest * ahead);
}

std::vector<Error> overlapErrors(const State& state, const std::vector<PairFinding>& findings) {
    std::vector<Error> errors;
    for (const PairFinding& finding : findings) {
        if (!finding.overlaps) continue;
        const auto& blocks = state.geometry->model.blocks;
        const Block& a = blocks[static_cast<std::size_t>(std::min(finding.block_a, finding.block_b))];
        const Block& b = blocks[static_cast<std::size_t>(std::max(finding.block_a, finding.block_b))];
        char depth[96];
        std::snprintf(depth, sizeof depth, "by %.3g m; allowed: at most 1e-4 of the block size",
                      finding.depth);
        errors.push_back({b.field, "blocks \"" + a.name + "\" and \"" + b.name + "\" overlap " + depth});
    }
    return errors;
}

/// Appends one interface with frames at the patch's centroid; its group is there already.
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

    // b's face plane at that point, and a's tangents carried into it.
    const Vec3 origin = x_a + turn_a * origin_a, e1 = turn_a * own.e1, e3 = turn_a * own.e3;
    const FaceFrame other = faceFrame(state.geometry->shape[ib], face_b);
    const Vec3 normal_b = turn_b * other.e3;
    const double gap = normal_b.dot(x_b + turn_b * other.origin - origin) / normal_b.dot(e3);
    const Vec3 b1 = (e1 - normal_b.dot(e1) * normal_b).normalized();
    const Vec3 b2 = b1.cross(normal_b);  // b1 x b2 = -normal_b, which points from a to b

    f.block_a.push_back(a);
    f.block_b.push_back(b);
    f.face_a.push_back(pair.face_a);
    f.face_b.push_back(pair.face_b);
    f.joint.push_back(interfaceJoint(*state.geometry, ia, face_a, ib, face_b));
    f.area.push_back(patch_area);
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

/// Contacts that come about later have no bond to lose; without a bond they have their peak friction.
void breakBonds(State& state) {
    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
        if (state.laws[static_cast<std::size_t>(state.interfaces.joint[i])].bonded) setBond(state, i, 0.0);
}

/// Interfaces that touch at the start: their gap becomes the reference, their Lps are intact.
void closeInitialInterfaces(State& state) {
    Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isSharp(f, i)) continue;
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

/// One interface to be made; without a patch: the slots of a pair that may meet by vertices or edges.
struct Found {
    std::int32_t block_a = 0, block_b = 0;
    FacePair faces{};
};

/// Appends interfaces in the order they are stored in: that of the search, but those with as many corners side by side
/// within windows short enough that neighbours in space stay neighbours in memory.
struct InterfaceWindow {
    static constexpr std::size_t kSize = 256;
    std::vector<Found> found{};
    std::vector<const Found*> order{};

    void add(State& state, const Found& next) {
        found.push_back(next);
        if (found.size() == kSize) append(state);
    }

    void append(State& state) {
        order.clear();
        for (const Found& one : found) order.push_back(&one);
        std::stable_sort(order.begin(), order.end(), [](const Found* a, const Found* b) {
            return a->faces.patch.size() < b->faces.patch.size();
        });
        for (const Found* one : order) {
            const Polygon& patch = one->faces.patch;
            if (patch.empty()) {
                appendSharpSlots(state, one->block_a, one->block_b);
                continue;
            }
            addToGroups(
                state.interfaces, patch.size(),
                contact::pointCount(std::span(patch.begin(), patch.size()), state.geometry->model.points));
            appendInterface(state, one->block_a, one->block_b, one->faces);
        }
        found.clear();
    }
};

}  // namespace

void buildIncidence(State& state) {
    Incidence& incidence = state.incidence;
    const Interfaces& f = state.interfaces;
    const std::size_t n = state.blocks.size();
    incidence.interface_begin.assign(n + 1, 0);
    for (std::size_t i = 0; i < f.size(); ++i) {
        ++incidence.interface_begin[static_cast<std::size_t>(f.block_a[i]) + 1];
        ++incidence.interface_begin[static_cast<std::size_t>(f.block_b[i]) + 1];
    }
    for (std::size_t b = 0; b < n; ++b) incidence.interface_begin[b + 1] += incidence.interface_begin[b];
    incidence.interface.resize(2 * f.size());
    incidence.wrench.resize(2 * f.size());
    std::vector<std::int64_t> next(incidence.interface_begin.begin(), incidence.interface_begin.end() - 1);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (const std::int32_t side : {0, 1}) {
            const auto block = static_cast<std::size_t>(side == 0 ? f.block_a[i] : f.block_b[i]);
            const auto slot = static_cast<std::size_t>(next[block]++);
            incidence.interface[slot] = static_cast<std::int32_t>(i);
            incidence.wrench[slot] = 2 * f.slot[i] + side;
        }
    if (incidence.wet_begin.size() != n + 1) incidence.wet_begin.assign(n + 1, 0);
}

namespace {

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

/// What a search leaves beside the interfaces.
struct SearchRemarks {
    std::vector<PairFinding> overlaps;  ///< without their faces
    std::vector<Error> grid{};          ///< the first patch that is no rectangle where the rule asks for one
};

SearchRemarks appendInterfaces(State& state, double margin, const SlotPairs& with_slots, bool initial,
                               bool parallel) {
    SearchRemarks remarks;
    InterfaceWindow window;
    examinePairs(state, margin, with_slots, initial, parallel, [&](const PairFinding& finding) {
        if (finding.overlaps)
            remarks.overlaps.push_back({{}, finding.block_a, finding.block_b, false, true, finding.depth});
        for (const FacePair& pair : finding.faces) {
            if (initial && remarks.grid.empty() && !suitsRule(state, pair))
                remarks.grid.push_back(gridError(state, finding, pair));
            if (remarks.grid.empty()) window.add(state, {finding.block_a, finding.block_b, pair});
        }
        if (finding.may_meet_sharply) window.add(state, {finding.block_a, finding.block_b});
    });
    window.append(state);
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

std::vector<Error> findInterfacesWithin(State& state, double margin, double ahead, bool initial,
                                        bool parallel) {
    const SlotPairs with_slots = pairsWithSlots(state.interfaces);
    const OldInterfaces old = takeInterfaces(state);
    const SearchRemarks remarks = appendInterfaces(state, margin, with_slots, initial, parallel);
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
        carried = carryOver(old, state, ahead);
    buildIncidence(state);
    renewSharpContacts(state, ahead, parallel, carried);
    state.search_position = state.blocks.position;
    state.search_orientation = state.blocks.orientation;
    state.search_margin = margin;
    if (initial) return touchErrors(state);
    rebuildPairWater(state);
    return {};
}

/// Far enough that a contact could be missed, or that a patch has slid or turned too far over its partner.
bool movedTooFar(const State& state, double margin) {
    double farthest = 0, most_turned = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::fixed) continue;
        const double shift = (state.blocks.position.get(b) - state.search_position.get(b)).norm();
        const double turn = rotationFrom(state.search_orientation, state.blocks.orientation, b);
        const double motion = shift + turn * state.geometry->radius[b];
        if (motion > kTravelLimit * state.geometry->size[b]) return true;
        farthest = std::max(farthest, motion);
        most_turned = std::max(most_turned, turn);
    }
    if (most_turned > kTurnLimit) return true;
    // Two blocks may come towards each other: half the margin each, less what they may go before the next look.
    if (farthest > 0.25 * state.search_margin || margin > 1.001 * state.search_margin) return true;
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isSharp(f, i)) continue;
        const double size = std::min(state.geometry->size[static_cast<std::size_t>(f.block_a[i])],
                                     state.geometry->size[static_cast<std::size_t>(f.block_b[i])]);
        const double limit = kSlideLimit * std::max(std::sqrt(f.area[i]), size);
        if (2.0 * farthest < limit) continue;
        const RelativePose pose = relativePose(state, i);
        if (std::hypot(pose.slide_1.x(), pose.slide_2.x()) > limit) return true;
    }
    return false;
}

}  // namespace

std::int32_t largestInterface(const State& state, std::int32_t block_1, std::int32_t block_2) {
    const Incidence& incidence = state.incidence;
    // The block with fewer interfaces knows them all: a floor may have thousands.
    const auto count = [&](std::int32_t b) {
        return incidence.interface_begin[static_cast<std::size_t>(b) + 1] -
               incidence.interface_begin[static_cast<std::size_t>(b)];
    };
    const std::int32_t block = count(block_1) <= count(block_2) ? block_1 : block_2;
    std::int32_t best = -1;
    for (auto k = incidence.interface_begin[static_cast<std::size_t>(block)];
         k < incidence.interface_begin[static_cast<std::size_t>(block) + 1]; ++k) {
        const std::int32_t i = incidence.interface[static_cast<std::size_t>(k)];
        const auto index = static_cast<std::size_t>(i);
        if (isSharp(state.interfaces, index)) continue;
        if (std::minmax(state.interfaces.block_a[index], state.interfaces.block_b[index]) !=
            std::minmax(block_1, block_2))
            continue;
        if (best < 0 || state.interfaces.area[index] > state.interfaces.area[static_cast<std::size_t>(best)])
            best = i;
    }
    return best;
}

std::vector<Error> findInterfaces(State& state, bool initial, bool parallel) {
    const double margin = searchMargin(state, 0.0);
    return findInterfacesWithin(state, margin, 0.0, initial, parallel);
}

bool refreshInterfaces(State& state, bool parallel, double ahead) {
    const double margin = searchMargin(state, ahead);
    if (!movedTooFar(state, margin) && !updateSharpContacts(state, ahead, parallel)) {
        pressLateContacts(state);
        return false;
    }
    findInterfacesWithin(state, margin, ahead, false, parallel);
    // Forces are there again before anything looks at them.
    updateContacts(state, {0, state.interfaces.groups.size()});
    updateWater(state);
    return true;
}

std::int32_t interfaceJoint(const Geometry& geometry, std::size_t block_a, std::size_t face_a,
                            std::size_t block_b, std::size_t face_b) {
    const std::pair<std::int32_t, std::int32_t> key =
        std::minmax({static_cast<std::int32_t>(block_a), static_cast<std::int32_t>(block_b)});
    const auto& pairs = geometry.pair_joints;
    const auto found =
        std::lower_bound(pairs.begin(), pairs.end(), key,
                         [](const PairJoint& pair, const auto& k) { return pairOf(pair) < k; });
    if (found != pairs.end() && pairOf(*found) == key) return found->joint;
    const Model& model = geometry.model;
    const std::int32_t joint_a = model.blocks[block_a].face_joint[face_a];
    const std::int32_t joint_b = model.blocks[block_b].face_joint[face_b];
    const double phi_a = model.joints[static_cast<std::size_t>(joint_a)].friction;
    const double phi_b = model.joints[static_cast<std::size_t>(joint_b)].friction;
    if (phi_a == phi_b) return std::min(joint_a, joint_b);
    return phi_a < phi_b ? joint_a : joint_b;
}

}  // namespace talus::stages
