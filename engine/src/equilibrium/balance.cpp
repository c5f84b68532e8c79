#include "equilibrium/balance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forces/sum.h"
#include "forces/tie.h"
#include "law/points.h"
#include "state/incidence.h"
#include "state/point_layout.h"

namespace talus::equilibrium {
namespace {

bool moves(const State& state, std::size_t b) { return state.blocks.motion[b] == Motion::free; }

void listRows(const State& state, Balance& balance) {
    const double g = state.geometry->model.gravity.magnitude;
    balance.row.assign(state.blocks.size(), -1);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (!moves(state, b)) continue;
        balance.row[b] = static_cast<std::int32_t>(balance.block.size());
        balance.block.push_back(b);
        balance.weight.push_back(state.blocks.mass[b] * (g > 0 ? g : 1.0));
        balance.radius.push_back(state.geometry->radius[b]);
        balance.size.push_back(state.geometry->size[b]);
    }
}

InterfacePlace placeOf(const Interfaces& interfaces, std::size_t i) {
    const InterfaceFrame frame = interfaces.frame(i);
    return {frame.origin_a, frame.e1_a, frame.e2_a,         frame.origin_b,
            frame.e1_b,     frame.e2_b, frame.reference_gap};
}

void listInterfaces(const State& state, Balance& balance) {
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        if ((!moves(state, a) && !moves(state, b)) || isIdle(f, i)) continue;
        ActiveInterface active{.place = placeOf(f, i),
                               .interface = i,
                               .block_a = a,
                               .block_b = b,
                               .joint = f.joint[i],
                               .first_point = balance.points.size()};
        for (const contact::PatchPoint& point : interfacePoints(f, i, state.geometry->model.points))
            balance.points.push_back({point.position.x(), point.position.y(), point.area, {}});
        active.points = balance.points.size() - active.first_point;
        active.a_first = balance.row[a] < balance.row[b];
        balance.interfaces.push_back(active);
    }
}

void listTies(const State& state, Balance& balance) {
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts&) {
        if (force.tying == nullptr) return;
        const std::vector<Tie> ties = force.tying->ties(state);
        for (std::size_t k = 0; k < ties.size(); ++k) {
            const auto a = static_cast<std::size_t>(ties[k].a), b = static_cast<std::size_t>(ties[k].b);
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

/// A drag of the size of what holds a block; what touches nothing has that of its largest face on the stiffest joint.
void findDrag(const State& state, Balance& balance) {
    balance.drag.assign(balance.block.size(), 0.0);
    double stiffest = 0;
    for (const contact::JointLaw& law : state.laws)
        stiffest = std::max(stiffest, contact::largestStiffness(law));
    for (const ActiveInterface& i : balance.interfaces) {
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(i.joint)];
        const double stiffness = state.interfaces.area[i.interface] * contact::largestStiffness(law);
        for (const std::size_t b : {i.block_a, i.block_b})
            if (balance.row[b] >= 0) balance.drag[static_cast<std::size_t>(balance.row[b])] += stiffness;
    }
    for (std::size_t r = 0; r < balance.drag.size(); ++r)
        if (balance.drag[r] == 0) balance.drag[r] = stiffest * state.geometry->face_area[balance.block[r]];
}

/// \param i an interface or a tie
template <class Active>
void addStiffness(Balance& balance, const Active& i, const InterfaceStiffness& k) {
    const std::int32_t a = balance.row[i.block_a], b = balance.row[i.block_b];
    if (a >= 0) balance.matrix.diagonal[static_cast<std::size_t>(a)] -= k.aa;
    if (b >= 0) balance.matrix.diagonal[static_cast<std::size_t>(b)] -= k.bb;
    if (i.edge < 0) return;
    const auto edge = static_cast<std::size_t>(i.edge);
    (i.a_first ? balance.matrix.upper : balance.matrix.lower)[edge] -= k.ab;
    (i.a_first ? balance.matrix.lower : balance.matrix.upper)[edge] -= k.ba;
}

/// Rotations times the radius, torques over it.
void scaleByRadius(Balance& balance) {
    std::vector<double> scales;
    for (const double radius : balance.radius) scales.push_back(1.0 / radius);
    const auto scale = [&](Mat6& k, std::size_t row, std::size_t column) {
        k.bottomRows<3>() *= scales[row];
        k.rightCols<3>() *= scales[column];
    };
    BlockMatrix& matrix = balance.matrix;
    for (std::size_t r = 0; r < matrix.rows(); ++r) scale(matrix.diagonal[r], r, r);
    for (std::size_t e = 0; e < matrix.edges.size(); ++e) {
        const auto i = static_cast<std::size_t>(matrix.edges[e].first),
                   j = static_cast<std::size_t>(matrix.edges[e].second);
        scale(matrix.upper[e], i, j);
        scale(matrix.lower[e], j, i);
    }
}

/// What keeps its direction changes its moment as the block turns.
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
        if (!stiffness) continue;
        const TieRates rates = ratesOf(found, at_a, at_b);
        const InterfaceStiffness k{rates.on_a.leftCols<6>(), rates.on_a.rightCols<6>(),
                                   rates.on_b.leftCols<6>(), rates.on_b.rightCols<6>()};
        addStiffness(balance, tie, k);
    }
}

Placed placedOf(const Poses& poses, std::size_t b) { return {poses.position.get(b), poses.turn[b]}; }

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

Balance makeBalance(const State& state) {
    Balance balance;
    listRows(state, balance);
    listInterfaces(state, balance);
    listTies(state, balance);
    makeStructure(balance);
    findDrag(state, balance);
    readMemory(state, balance);
    readApplied(state, balance);
    return balance;
}

void readMemory(const State& state, Balance& balance) {
    for (const ActiveInterface& i : balance.interfaces)
        for (std::size_t k = 0; k < i.points; ++k)
            balance.points[i.first_point + k].memory =
                state.points.memoryAt(state.interfaces.pointSlot(i.interface, k));
}

void writeMemory(const Balance& balance, State& state) {
    for (const ActiveInterface& i : balance.interfaces)
        for (std::size_t k = 0; k < i.points; ++k)
            state.points.setMemory(state.interfaces.pointSlot(i.interface, k),
                                   balance.points[i.first_point + k].memory);
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

void sumForces(const State& state, Balance& balance, const Poses& poses, double rounding, bool stiffness,
               Vec6s& force) {
    force.assign(balance.block.size(), Vec6::Zero());
    if (stiffness) balance.matrix.setZero();
    InterfaceStiffness k;
    for (const ActiveInterface& i : balance.interfaces) {
        const InterfaceWrenches wrenches = interfaceResponse(
            i.place, placedOf(poses, i.block_a), placedOf(poses, i.block_b),
            state.laws[static_cast<std::size_t>(i.joint)], {balance.points.data() + i.first_point, i.points},
            rounding, stiffness ? &k : nullptr);
        if (!wrenches.carries) continue;
        if (const std::int32_t a = balance.row[i.block_a]; a >= 0)
            force[static_cast<std::size_t>(a)] += wrenches.on_a;
        if (const std::int32_t b = balance.row[i.block_b]; b >= 0)
            force[static_cast<std::size_t>(b)] += wrenches.on_b;
        if (stiffness) addStiffness(balance, i, k);
    }
    for (std::size_t r = 0; r < force.size(); ++r) force[r].tail<3>() /= balance.radius[r];
    addTies(state, balance, poses, stiffness, force);
    if (stiffness) scaleByRadius(balance);
    addLoad(bodyAcceleration(state), balance, state, poses, stiffness, force);
    addDead(balance, poses, stiffness, force);
}

void commitRounded(const State& state, Balance& balance, const Poses& poses, double rounding) {
    for (const ActiveInterface& i : balance.interfaces)
        commitSlides(i.place, placedOf(poses, i.block_a), placedOf(poses, i.block_b),
                     state.laws[static_cast<std::size_t>(i.joint)],
                     {balance.points.data() + i.first_point, i.points}, rounding);
}

double relativeMotion(const Balance& balance, const ActiveInterface& i, const Poses& from, const Poses& to) {
    double most = 0;
    for (std::size_t k = 0; k < i.points; ++k) {
        const SolverPoint& point = balance.points[i.first_point + k];
        most = std::max(most,
                        (slidesAndGap(i.place, placedOf(to, i.block_a), placedOf(to, i.block_b), point) -
                         slidesAndGap(i.place, placedOf(from, i.block_a), placedOf(from, i.block_b), point))
                            .norm());
    }
    return most;
}

double deepestPoint(const Balance& balance, const Poses& poses) {
    double deepest = 0;
    for (const ActiveInterface& i : balance.interfaces)
        for (std::size_t k = 0; k < i.points; ++k) {
            const SolverPoint& point = balance.points[i.first_point + k];
            deepest = std::max(
                deepest,
                point.memory.dilation -
                    slidesAndGap(i.place, placedOf(poses, i.block_a), placedOf(poses, i.block_b), point).z());
        }
    return deepest;
}

double largestRatio(const Balance& balance, const Vec6s& force) {
    double largest = 0;
    for (std::size_t r = 0; r < force.size(); ++r)
        largest = std::max(largest, force[r].cwiseAbs().maxCoeff() / balance.weight[r]);
    return largest;
}

}  // namespace talus::equilibrium
