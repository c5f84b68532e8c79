#include "build/wet_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "build/build.h"
#include "forces/contact_forces.h"
#include "forces/flow_water.h"
#include "forces/phreatic.h"
#include "forces/sum.h"
#include "forces/water.h"
#include "forces/wet_walls.h"
#include "geometry/face_frame.h"
#include "measure/words.h"
#include "model/joint_pairs.h"
#include "state/point_layout.h"
#include "talus/wet_joint_name.h"

namespace talus {
namespace {

// Distinct wet shares, as of rock bridges: a water table through a large rock mass then makes a thousand
// joints, not one for each block that it cuts.
constexpr long kWetSteps = 1000;

/// One side of an interface: its patch in the model frame as built, the outward normal of its block.
struct Side {
    std::int32_t block;
    std::vector<Vec3> corners;  ///< counter-clockwise seen from outside the block
    Vec3 normal;
};

Side sideOf(const State& state, std::size_t i, bool of_b) {
    const RelativePose pose = relativePose(state, i);
    Side side{
        of_b ? state.interfaces.block_b[i] : state.interfaces.block_a[i], {}, of_b ? -pose.e3 : pose.e3};
    for (const Vec2& corner : patchOutline(state.interfaces, i))
        side.corners.emplace_back(pose.origin + corner.x() * pose.e1 + corner.y() * pose.e2);
    if (of_b) std::reverse(side.corners.begin(), side.corners.end());
    return side;
}

Polygon inPlane(const Side& side, const FaceFrame& plane) {
    Polygon polygon;
    for (const Vec3& corner : side.corners) polygon.push(plane.toPlane(corner));
    return polygon;
}

/// A wall of water as its block lies now.
FaceFrame planeOf(const State& state, std::size_t wall) {
    const auto b = static_cast<std::size_t>(state.wet.block[wall]);
    const Mat3 turn = state.blocks.orientation.matrix(b);
    const Vec3 e1 = turn * state.wet.e1.get(wall), e2 = turn * state.wet.e2.get(wall);
    return {state.blocks.position.get(b) + turn * state.wet.origin.get(wall), e1, e2, e1.cross(e2)};
}

/// Whether a wall lies along a side of an interface and looks the same way.
bool liesAlong(const Side& side, const FaceFrame& plane, double length_scale) {
    constexpr double kSamePlane = 1e-3;  // [rad], and of the length scale: more than joints are closed by
    return (plane.e3 - side.normal).norm() <= kSamePlane &&
           std::abs(plane.height(side.corners.front())) <= kSamePlane * length_scale;
}

double wetAreaOf(const Polygon& polygon, const WallPressure& pressure) {
    Polygon wet = wetPart(polygon, pressure.hydrostatic);
    if (pressure.most && !wet.empty()) wet = wetPart(wet, *pressure.most);
    return wet.empty() ? 0.0 : area(wet);
}

/// Of the water table alone.
double areaBelowTable(const State& state, const Polygon& polygon, const FaceFrame& plane) {
    if (!state.phreatic.cells || polygon.empty()) return 0;
    return phreatic::wetArea(*state.phreatic.cells, polygon, plane);
}

/// Where a water has a wall, it presses in place of the water table.
double wetAreaOf(const State& state, const Side& side) {
    const FaceFrame own = faceFrame(side.corners[0], side.corners[1], side.normal);
    double sum = areaBelowTable(state, inPlane(side, own), own);
    const auto block = static_cast<std::size_t>(side.block);
    for (auto k = state.incidence.wet_begin[block]; k < state.incidence.wet_begin[block + 1]; ++k) {
        const auto wall = static_cast<std::size_t>(state.incidence.wet[static_cast<std::size_t>(k)]);
        const FaceFrame plane = planeOf(state, wall);
        if (!liesAlong(side, plane, state.geometry->length_scale)) continue;
        const Polygon common = intersect(inPlane(side, plane), wetPolygon(state.wet, wall));
        if (common.empty()) continue;
        sum += wetAreaOf(common, pressureOnWall(state, wall)) - areaBelowTable(state, common, plane);
    }
    return sum;
}

/// The larger of both sides: a water may be given on one of them alone.
/// \param by_flow  wet by a flow in the joints [m^2]
double wetShareOf(const State& state, std::size_t i, double by_flow) {
    if (state.interfaces.kind[i] != InterfaceKind::faces || state.interfaces.cornerCount(i) < 3) return 0;
    const Side a = sideOf(state, i, false), b = sideOf(state, i, true);
    const FaceFrame own = faceFrame(a.corners[0], a.corners[1], a.normal);
    const double whole = area(inPlane(a, own));
    const double wet = by_flow + std::max(wetAreaOf(state, a), wetAreaOf(state, b));
    return whole > 0 ? std::clamp(wet / whole, 0.0, 1.0) : 0.0;
}

Joint wetted(const Joint& dry, long steps) {
    const double share = static_cast<double>(steps) / kWetSteps;
    Joint wet = strengthened(dry, 1 - share * (1 - dry.wet_strength_factor));
    wet.wet_strength_factor = 1;
    wet.name = WetJointName{dry.name, share}.text();
    return wet;
}

/// A joint made out of another conducts water like it, at the same boundaries.
void flowsLike(std::int32_t joint, std::int32_t made, Flow& flow) {
    const auto aperture = std::find_if(flow.joint_apertures.begin(), flow.joint_apertures.end(),
                                       [&](const auto& each) { return each.first == joint; });
    if (aperture != flow.joint_apertures.end()) {
        const double same = aperture->second;
        flow.joint_apertures.emplace_back(made, same);
    }
    for (FlowBoundary& boundary : flow.boundaries)
        if (std::find(boundary.joints.begin(), boundary.joints.end(), joint) != boundary.joints.end())
            boundary.joints.push_back(made);
}

/// Two faces of two blocks may share several interfaces.
struct FacePair {
    double area = 0, wet = 0;            ///< [m^2]
    std::vector<std::int32_t> joints{};  ///< that may count between them, in the order of the model
};

TwoFaces facesOf(const Interfaces& f, std::size_t i) {
    return {static_cast<std::size_t>(f.block_a[i]), static_cast<std::size_t>(f.face_a[i]),
            static_cast<std::size_t>(f.block_b[i]), static_cast<std::size_t>(f.face_b[i])};
}

/// The joint that the model gives to an interface, else those of both faces: water may weaken the stronger
/// one to less than the other.
std::vector<std::int32_t> candidates(const Model& model, const std::vector<PairJoint>& sorted,
                                     const TwoFaces& faces) {
    if (const auto given = givenJoint(sorted, faces)) return {*given};
    const auto [first, second] = std::minmax(model.blocks[faces.block_a].face_joint[faces.face_a],
                                             model.blocks[faces.block_b].face_joint[faces.face_b]);
    return first == second ? std::vector{first} : std::vector{first, second};
}

/// The weakest of a pair's joints where so many thousandths of it are wet.
std::int32_t weakestWhereWet(const Model& model, const FacePair& pair, long steps) {
    const auto wet = [&](std::int32_t j) { return wetted(model.joints[static_cast<std::size_t>(j)], steps); };
    std::int32_t weakest = pair.joints.front();
    for (const std::int32_t joint : pair.joints)
        if (isWeaker(wet(joint), wet(weakest))) weakest = joint;
    return weakest;
}

bool isWeakened(const Joint& joint) { return joint.wet_strength_factor != 1; }

/// \pre there is one
const Joint& firstWeakened(const Model& model) {
    return *std::find_if(model.joints.begin(), model.joints.end(), isWeakened);
}

}  // namespace

bool hasWetJoints(const Model& model) {
    return model.hasWater() && std::any_of(model.joints.begin(), model.joints.end(), isWeakened);
}

std::string wetStrengthKey(const Model& model) {
    const Joint& joint = firstWeakened(model);
    return "joint." + joint.name.substr(0, joint.name.find('@')) + ".wet_strength_factor";
}

std::optional<Error> refusedWetJoints(const Model& model) {
    if (!hasWetJoints(model) || !model.flow || !model.flow->coupled) return std::nullopt;
    return Error{wetStrengthKey(model),
                 "found " + formatted("%g", firstWeakened(model).wet_strength_factor) +
                     " in a model with coupled flow, whose wet areas change as joints open; "
                     "allowed: 1, or flow.coupled = false"};
}

std::vector<double> wetShares(const State& built) {
    State state = built;
    state.load.water_share = 1;
    updateBlockForces(state);
    std::vector<double> shares(state.interfaces.size(), 0.0);
    const std::vector<double> by_flow = flow_water::wetAreas(built);
    const Model& model = state.geometry->model;
    const std::vector<PairJoint> given = sortedByBlocks(model.pair_joints);
    const auto is_weakened = [&](std::int32_t j) {
        return isWeakened(model.joints[static_cast<std::size_t>(j)]);
    };
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (state.interfaces.kind[i] != InterfaceKind::faces) continue;
        const std::vector<std::int32_t> joints = candidates(model, given, facesOf(state.interfaces, i));
        if (std::any_of(joints.begin(), joints.end(), is_weakened))
            shares[i] = wetShareOf(state, i, by_flow[i]);
    }
    return shares;
}

Model withWetJoints(const Model& model, const State& built, const std::vector<double>& shares) {
    const Interfaces& f = built.interfaces;
    const std::vector<PairJoint> given = sortedByBlocks(model.pair_joints);
    std::map<std::array<std::int32_t, 4>, FacePair> pairs;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (f.kind[i] != InterfaceKind::faces) continue;
        FacePair& pair = pairs[{f.block_a[i], f.face_a[i], f.block_b[i], f.face_b[i]}];
        pair.area += f.area[i];
        pair.wet += shares[i] * f.area[i];
        if (pair.joints.empty()) pair.joints = candidates(model, given, facesOf(f, i));
    }
    Model wet = model;
    std::vector<PairJoint> first;  // before those of the model: of several that fit the first counts
    std::map<std::pair<std::int32_t, long>, std::int32_t> made;
    for (const auto& [faces, pair] : pairs) {
        const long steps = std::lround(kWetSteps * pair.wet / pair.area);
        if (steps == 0) continue;
        const std::int32_t joint = weakestWhereWet(model, pair, steps);
        const Joint& dry = model.joints[static_cast<std::size_t>(joint)];
        if (!isWeakened(dry)) continue;  // it counts between dry faces too
        const auto [place, is_new] =
            made.try_emplace({joint, steps}, static_cast<std::int32_t>(wet.joints.size()));
        if (is_new) {
            wet.joints.push_back(wetted(dry, steps));
            if (wet.flow) flowsLike(joint, place->second, *wet.flow);
        }
        first.push_back({faces[0], faces[2], place->second, false, "", faces[1], faces[3]});
    }
    wet.pair_joints.insert(wet.pair_joints.begin(), first.begin(), first.end());
    return wet;
}

Result<State> buildWithWetJoints(std::shared_ptr<const Model>& model, bool parallel, const Control& control) {
    Result<State> dry = buildState(model, parallel, control);
    if (!dry || !hasWetJoints(*model)) return dry;
    if (auto refused = refusedWetJoints(*model)) return *refused;
    Model wet = withWetJoints(*model, *dry, wetShares(*dry));
    if (wet.joints.size() == model->joints.size()) return dry;  // no area is wet, or it has them already
    model = std::make_shared<const Model>(std::move(wet));
    return buildState(model, parallel, control);
}

Result<State> buildWithWetJoints(const Model& model, bool parallel, const Control& control) {
    std::shared_ptr<const Model> kept = keptByCaller(model);
    return buildWithWetJoints(kept, parallel, control);
}

}  // namespace talus
