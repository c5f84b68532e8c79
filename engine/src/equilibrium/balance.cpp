#include "equilibrium/balance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "equilibrium/response_view.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "forces/tie.h"
#include "state/incidence.h"

namespace talus::equilibrium {
namespace {

bool moves(const State& state, std::size_t b) { return state.blocks.motion[b] == Motion::free; }

void listRows(const State& state, const std::vector<char>& moving, Balance& balance) {
    const double g = state.geometry->model.gravity.magnitude;
    balance.row.assign(state.blocks.size(), -1);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (!moves(state, b) || (!moving.empty() && moving[b] == 0)) continue;
        balance.row[b] = static_cast<std::int32_t>(balance.block.size());
        balance.block.push_back(b);
        balance.weight.push_back(state.blocks.mass[b] * (g > 0 ? g : 1.0));
        balance.radius.push_back(state.geometry->radius[b]);
        balance.size.push_back(state.geometry->size[b]);
    }
}

void listInterfaces(const State& state, Balance& balance) {
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        if ((balance.row[a] < 0 && balance.row[b] < 0) || isIdle(f, i)) continue;
        balance.interfaces.push_back({.interface = i,
                                      .block_a = a,
                                      .block_b = b,
                                      .slot = static_cast<std::size_t>(f.slot[i]),
                                      .a_first = balance.row[a] < balance.row[b]});
    }
    for (const double radius : state.geometry->radius) balance.inverse_radius.push_back(1.0 / radius);
    const std::size_t slots = f.groups.size() * static_cast<std::size_t>(simd::kLanes);
    balance.wrenches.resize(slots);
    balance.carries.resize(slots);
}

void listTies(const State& state, Balance& balance) {
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts&) {
        if (force.tying == nullptr) return;
        const std::vector<Tie> ties = force.tying->ties(state);
        for (std::size_t k = 0; k < ties.size(); ++k) {
            const auto a = static_cast<std::size_t>(ties[k].a), b = static_cast<std::size_t>(ties[k].b);
            if (balance.row[a] < 0 && balance.row[b] < 0) continue;
            balance.ties.push_back({.force = force.tying,
                                    .tie = k,
                                    .block_a = a,
                                    .block_b = b,
                                    .a_first = balance.row[a] < balance.row[b]});
        }
    });
}

void makeStructure(Balance& balance) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    const auto pairOf = [&](const auto& i) {
        return std::minmax(balance.row[i.block_a], balance.row[i.block_b]);
    };
    const auto list = [&](const auto& i) {
        if (pairOf(i).first >= 0) pairs.emplace_back(pairOf(i));
    };
    for (const ActiveInterface& i : balance.interfaces) list(i);
    for (const ActiveTie& tie : balance.ties) list(tie);
    balance.matrix = BlockMatrix(balance.block.size(), std::move(pairs));
    const auto& edges = balance.matrix.edges;
    const auto find = [&](auto& i) {
        const std::pair<std::int32_t, std::int32_t> pair = pairOf(i);
        if (pair.first < 0) return;
        i.edge =
            static_cast<std::int32_t>(std::lower_bound(edges.begin(), edges.end(), pair) - edges.begin());
    };
    for (ActiveInterface& i : balance.interfaces) find(i);
    for (ActiveTie& tie : balance.ties) find(tie);
}

/// A drag as stiff as the block's joints; a block that touches nothing gets that of its largest face on the
/// stiffest joint.
void findDrag(const State& state, Balance& balance) {
    balance.drag.assign(balance.block.size(), 0.0);
    double stiffest = 0;
    for (const contact::JointLaw& law : state.laws)
        stiffest = std::max(stiffest, contact::largestStiffness(law));
    for (const ActiveInterface& i : balance.interfaces) {
        const auto joint = static_cast<std::size_t>(state.interfaces.joint[i.interface]);
        const double stiffness =
            state.interfaces.area[i.interface] * contact::largestStiffness(state.laws[joint]);
        for (const std::size_t b : {i.block_a, i.block_b})
            if (balance.row[b] >= 0) balance.drag[static_cast<std::size_t>(balance.row[b])] += stiffness;
    }
    for (std::size_t r = 0; r < balance.drag.size(); ++r)
        if (balance.drag[r] == 0) balance.drag[r] = stiffest * state.geometry->face_area[balance.block[r]];
}

using Block = Eigen::Map<const Mat6>;

void addStiffness(Balance& balance, const ActiveInterface& i, const double* k) {
    const auto block = [&](std::size_t part) { return Block(k + part * kStiffnessBlock); };
    const std::int32_t a = balance.row[i.block_a], b = balance.row[i.block_b];
    if (a >= 0) balance.matrix.diagonal[static_cast<std::size_t>(a)] -= block(0);
    if (b >= 0) balance.matrix.diagonal[static_cast<std::size_t>(b)] -= block(3);
    if (i.edge < 0) return;
    const auto edge = static_cast<std::size_t>(i.edge);
    (i.a_first ? balance.matrix.upper : balance.matrix.lower)[edge] += block(1);
    (i.a_first ? balance.matrix.lower : balance.matrix.upper)[edge] += block(2);
}

/// Derivative of a wrench by a motion: rotations times the radius of the moving block, torques over that of
/// the loaded block.
Mat6 scaled(const Eigen::Ref<const Mat6>& k, double pushed, double moving) {
    Mat6 result = k;
    result.bottomRows<3>() /= pushed;
    result.rightCols<3>() /= moving;
    return result;
}

void addStiffness(Balance& balance, const ActiveTie& tie, const TieRates& rates) {
    const std::int32_t a = balance.row[tie.block_a], b = balance.row[tie.block_b];
    const auto radius = [&](std::int32_t row) { return balance.radius[static_cast<std::size_t>(row)]; };
    if (a >= 0) {
        balance.matrix.diagonal[static_cast<std::size_t>(a)] -=
            scaled(rates.on_a.leftCols<6>(), radius(a), radius(a));
    }
    if (b >= 0) {
        balance.matrix.diagonal[static_cast<std::size_t>(b)] -=
            scaled(rates.on_b.rightCols<6>(), radius(b), radius(b));
    }
    if (tie.edge < 0) return;
    const auto edge = static_cast<std::size_t>(tie.edge);
    (tie.a_first ? balance.matrix.upper : balance.matrix.lower)[edge] -=
        scaled(rates.on_a.rightCols<6>(), radius(a), radius(b));
    (tie.a_first ? balance.matrix.lower : balance.matrix.upper)[edge] -=
        scaled(rates.on_b.leftCols<6>(), radius(b), radius(a));
}

/// A force of fixed direction changes its moment as the block turns.
void addDead(Balance& balance, const Poses& poses, bool stiffness, Vec6s& force) {
    for (std::size_t r = 0; r < balance.dead.size(); ++r) {
        const Mat3& turn = poses.turn[balance.block[r]];
        const Wrench wrench = balance.dead[r].at(turn);
        const double radius = balance.radius[r];
        force[r].head<3>() += wrench.force;
        force[r].tail<3>() += wrench.torque / radius;
        if (stiffness)
            balance.matrix.diagonal[r].bottomRightCorner<3, 3>() -=
                balance.dead[r].torqueByTurn(turn) / (radius * radius);
    }
}

void addLoad(const Vec3& acceleration, Balance& balance, const State& state, const Poses& poses,
             bool stiffness, Vec6s& force) {
    for (std::size_t r = 0; r < balance.block.size(); ++r) {
        const std::size_t b = balance.block[r];
        const double radius = balance.radius[r];
        const Vec3 water = poses.turn[b] * balance.own_force[r],
                   moment = poses.turn[b] * balance.own_moment[r];
        force[r].head<3>() += state.blocks.mass[b] * acceleration + water;
        force[r].tail<3>() += moment / radius;
        if (!stiffness) continue;
        balance.matrix.diagonal[r].topRightCorner<3, 3>() += crossMatrixOf(water) / radius;
        balance.matrix.diagonal[r].bottomRightCorner<3, 3>() += crossMatrixOf(moment) / (radius * radius);
    }
}

void addTies(const State& state, Balance& balance, const Poses& poses, bool stiffness, Vec6s& force) {
    for (const ActiveTie& tie : balance.ties) {
        const Vec3 at_a = poses.position.get(tie.block_a), at_b = poses.position.get(tie.block_b);
        const TieForce found = tie.force->between(state, tie.tie, {at_a, poses.turn[tie.block_a]},
                                                  {at_b, poses.turn[tie.block_b]});
        const auto add = [&](std::size_t block, const Wrench& wrench) {
            if (balance.row[block] < 0) return;
            const auto row = static_cast<std::size_t>(balance.row[block]);
            force[row].head<3>() += wrench.force;
            force[row].tail<3>() += wrench.torque / balance.radius[row];
        };
        add(tie.block_a, found.onA(at_a));
        add(tie.block_b, found.onB(at_b));
        if (stiffness) addStiffness(balance, tie, ratesOf(found, at_a, at_b));
    }
}

/// Groups of interfaces whose stiffness is computed at a time: as many as fit into the cache until they are
/// summed.
constexpr std::size_t kGroupsAtOnce = 4;

ResponseView responseView(const State& state, Balance& balance, const Poses& poses) {
    const Interfaces& f = state.interfaces;
    return {.position = numbers(poses.position),
            .orientation = numbers(poses.orientation),
            .groups = f.groups.data(),
            .block_a = f.block_a.data(),
            .block_b = f.block_b.data(),
            .joint = f.joint.data(),
            .frames = f.frames.data(),
            .corners = f.corners.data(),
            .patch_area = f.area.data(),
            .laws = state.laws.data(),
            .point_places = state.points.places.data(),
            .memory = state.points.memory.data(),
            .inverse_radius = balance.inverse_radius.data(),
            .wrenches = balance.wrenches.empty() ? nullptr : balance.wrenches.front().force.data(),
            .carries = balance.carries.data(),
            .stiffness = nullptr,
            .remembers = state.points.remembers(),
            .curved = hasCurves(state),
            .places = pointPlaces(state),
            .distributed = isDistributed(state)};
}

void addWrench(Balance& balance, const ActiveInterface& i, Vec6s& force) {
    const InterfaceWrench& wrench = balance.wrenches[i.slot];
    const auto add = [&](std::int32_t row, double sign, const Vec3& moment) {
        if (row < 0) return;
        Vec6& sum = force[static_cast<std::size_t>(row)];
        sum.head<3>() += sign * wrench.force;
        sum.tail<3>() += moment;
    };
    add(balance.row[i.block_a], -1.0, wrench.moment_a);
    add(balance.row[i.block_b], 1.0, wrench.moment_b);
}

void addContacts(const State& state, Balance& balance, const Poses& poses, bool stiffness, Vec6s& force) {
    ResponseView view = responseView(state, balance, poses);
    const ResponseKernel respond =
        simd::buildFor(state.instructions, kRespondScalar, kRespondAvx2, kRespondAvx512);
    constexpr auto kWidth = static_cast<std::size_t>(simd::kLanes);
    if (stiffness) {
        balance.stiffness.resize(kGroupsAtOnce * kWidth * kStiffnessQuantities);
        view.stiffness = balance.stiffness.data();
    }
    const auto group_of = [](const ActiveInterface& i) { return i.slot / kWidth; };
    auto next = balance.interfaces.begin();
    while (next != balance.interfaces.end()) {
        const std::size_t begin = group_of(*next);
        auto last = next;
        std::size_t end = begin + 1;
        for (; last != balance.interfaces.end() && group_of(*last) <= end &&
               group_of(*last) < begin + kGroupsAtOnce;
             ++last)
            end = group_of(*last) + 1;
        respond(view, begin, end);
        for (; next != last; ++next) {
            if (balance.carries[next->slot] == 0) continue;
            addWrench(balance, *next, force);
            if (stiffness) {
                addStiffness(balance, *next,
                             view.stiffness + (next->slot - begin * kWidth) * kStiffnessQuantities);
            }
        }
    }
}

/// q after a small turn by a rotation vector in the model frame.
Quaternion turned(const Quaternion& q, const Vec3& by) {
    const double angle = by.norm();
    const Vec3 v = (angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5) * by;
    const double w = std::cos(0.5 * angle);
    const Quaternion p{
        w * q.w - v.x() * q.x - v.y() * q.y - v.z() * q.z, w * q.x + v.x() * q.w + v.y() * q.z - v.z() * q.y,
        w * q.y - v.x() * q.z + v.y() * q.w + v.z() * q.x, w * q.z + v.x() * q.y - v.y() * q.x + v.z() * q.w};
    const double norm = std::sqrt(p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z);
    return {p.w / norm, p.x / norm, p.y / norm, p.z / norm};
}

}  // namespace

Balance makeBalance(const State& state, const std::vector<char>& moving) {
    Balance balance;
    listRows(state, moving, balance);
    listInterfaces(state, balance);
    listTies(state, balance);
    makeStructure(balance);
    findDrag(state, balance);
    readApplied(state, balance);
    return balance;
}

void readApplied(const State& state, Balance& balance) {
    balance.own_force.resize(balance.block.size());
    balance.own_moment.resize(balance.block.size());
    for (std::size_t r = 0; r < balance.block.size(); ++r) {
        const Mat3 back = state.blocks.orientation.matrix(balance.block[r]).transpose();
        const Wrench water = turningForcesOn(state, balance.block[r]);
        balance.own_force[r] = back * water.force;
        balance.own_moment[r] = back * water.torque;
    }
    balance.dead.clear();
    if (!hasDeadForces(state)) return;
    for (const std::size_t block : balance.block) balance.dead.push_back(deadForcesOn(state, block));
}

Poses posesOf(const State& state) {
    Poses poses{state.blocks.position, state.blocks.orientation, {}};
    for (std::size_t b = 0; b < state.blocks.size(); ++b) poses.turn.push_back(poses.orientation.matrix(b));
    return poses;
}

void setPoses(const Poses& poses, State& state) {
    state.blocks.position = poses.position;
    state.blocks.orientation = poses.orientation;
}

void move(const Balance& balance, const Vec6s& by, double share, Poses& poses) {
    for (std::size_t r = 0; r < balance.block.size(); ++r) {
        const std::size_t b = balance.block[r];
        poses.position.set(b, poses.position.get(b) + share * by[r].head<3>());
        poses.orientation[b] = turned(poses.orientation[b], share / balance.radius[r] * by[r].tail<3>());
        poses.turn[b] = poses.orientation.matrix(b);
    }
}

void sumForces(const State& state, Balance& balance, const Poses& poses, bool stiffness, Vec6s& force,
               bool contacts) {
    force.assign(balance.block.size(), Vec6::Zero());
    if (stiffness) balance.matrix.setZero();
    if (contacts) addContacts(state, balance, poses, stiffness, force);
    for (std::size_t r = 0; r < force.size(); ++r) force[r].tail<3>() /= balance.radius[r];
    addTies(state, balance, poses, stiffness, force);
    addLoad(bodyAcceleration(state), balance, state, poses, stiffness, force);
    addDead(balance, poses, stiffness, force);
}

}  // namespace talus::equilibrium
