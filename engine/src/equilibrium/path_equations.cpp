#include "equilibrium/path_equations.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"

namespace talus::equilibrium {
namespace {

// Times eps |x| k A / (m g): out-of-balance force by rounding of the coordinates, sums over contact points
// included.
constexpr double kRoundingMargin = 4;
// Of a cell: load difference for the derivative by the load.
constexpr double kLoadDifference = 1e-3;
// Of a block's drag: more would be as good as fixing it.
constexpr double kMostSlowed = 1e6;

}  // namespace

PathEquations::PathEquations(State& state, FirstOrderGaps& gaps, const SearchRules& rules,
                             const std::atomic<bool>* stop, PathWork& work)
    : state_(state),
      gaps_(gaps),
      rules_(rules),
      stop_(stop),
      work_(work),
      water_follows_(state.geometry->model.hasWater()),
      slowed_(state.blocks.size(), 1.0) {}

void PathEquations::setLoading(Loading loading, double load) {
    loading_ = std::move(loading);
    setLoad(load);
}

void PathEquations::setLoad(double load) {
    load_ = load;
    applied_ = std::numeric_limits<double>::quiet_NaN();
    applyLoad(load);
}

void PathEquations::applyLoad(double load) {
    if (load == applied_) return;
    loading_.apply(state_, load);
    applied_ = load;
    if (!water_follows_ || balance_.block.empty()) return;
    updateBlockForces(state_);
    readApplied(state_, balance_);
}

void PathEquations::take(const std::vector<char>& moving) {
    Balance next = makeBalance(state_, moving);
    const bool same = linear_ && next.matrix.edges == edges_ && next.block.size() == balance_.block.size();
    balance_ = std::move(next);
    if (!same) {
        edges_ = balance_.matrix.edges;
        linear_.emplace(balance_.matrix, state_.instructions, stop_);
    }
    poses_ = posesOf(state_);
    rounding_.resize(balance_.block.size());
    heaviest_drag_ = 0;
    for (std::size_t r = 0; r < balance_.block.size(); ++r) {
        const double stiffness = balance_.drag[r] / balance_.weight[r];
        const double reach = coordinateReach(state_, poses_.position, balance_.block[r]);
        rounding_[r] = kRoundingMargin * std::numeric_limits<double>::epsilon() * reach * stiffness;
        heaviest_drag_ = std::max(heaviest_drag_, stiffness * sizeOf(r));
    }
}

double PathEquations::limitOf(std::size_t row) const {
    const double limit = rules_.equilibrium_tolerance * loading_.imbalance;
    return std::max(limit, 2 * rounding_[row]);
}

double PathEquations::inaccuracy(std::size_t row, const Vec6& force) const {
    if (!force.allFinite()) return kInfinity;
    const double accuracy = rules_.newton_accuracy * rules_.equilibrium_tolerance * loading_.imbalance;
    return force.cwiseAbs().maxCoeff() / balance_.weight[row] / std::max(accuracy, rounding_[row]);
}

double PathEquations::inaccuracy(const Vec6s& force) const {
    double most = 0;
    for (std::size_t r = 0; r < force.size(); ++r) most = std::max(most, inaccuracy(r, force[r]));
    return most;
}

void PathEquations::takePoses(Poses poses) {
    poses_ = std::move(poses);
    readApplied(state_, balance_);
}

bool PathEquations::stopped() const { return work_.factors > most_factors_ || isStopped(stop_); }

double PathEquations::sizeOf(std::size_t row) const {
    return std::max(balance_.size[row], rules_.least_block_size * state_.geometry->length_scale);
}

double PathEquations::dot(const Vec6s& x, const Vec6s& y) const {
    assert(x.size() == balance_.block.size() && y.size() == x.size());
    double sum = 0;
    for (std::size_t r = 0; r < x.size(); ++r) sum += x[r].dot(y[r]) / (sizeOf(r) * sizeOf(r));
    return sum;
}

double PathEquations::norm(const Vec6s& x) const { return std::sqrt(dot(x, x)); }

Poses PathEquations::moved(const Vec6s& x) const {
    Poses poses = poses_;
    move(balance_, x, 1.0, poses);
    return poses;
}

double PathEquations::drag(const Arc& arc, const PathStep& at, std::size_t row) const {
    if (arc.unknown == Unknown::drag) return at.value * balance_.drag[row];
    if (arc.drag > 0) return arc.drag * slowed_[balance_.block[row]] * balance_.drag[row];
    const double displacement = std::isfinite(arc.displacement) ? arc.displacement : rules_.step_displacement;
    return leastDrag(displacement) * balance_.drag[row];
}

double PathEquations::leastDrag(double displacement) const {
    const double accuracy = rules_.newton_accuracy * rules_.equilibrium_tolerance * loading_.imbalance;
    return rules_.floor_drag * accuracy / (displacement * heaviest_drag_);
}

void PathEquations::residual(const Arc& arc, const PathStep& at, const Poses& poses, bool stiffness,
                             Vec6s& force) {
    applyLoad(arc.unknown == Unknown::load ? load_ + at.value : load_);
    if (stiffness) gaps_.set(state_, poses.position, poses.orientation);
    sumForces(state_, balance_, poses, stiffness, force);
    ++work_.forces;
    for (std::size_t r = 0; r < force.size(); ++r) force[r] -= drag(arc, at, r) * at.x[r];
}

void PathEquations::byUnknown(const Arc& arc, const PathStep& at, const Poses& poses, Vec6s& rate) {
    if (arc.unknown == Unknown::none) return rate.assign(at.x.size(), Vec6::Zero());
    if (arc.unknown == Unknown::drag) {
        rate.resize(at.x.size());
        for (std::size_t r = 0; r < rate.size(); ++r) rate[r] = -balance_.drag[r] * at.x[r];
        return;
    }
    const double difference = kLoadDifference * loading_.cell;
    const auto sum = [&](double load, Vec6s& force) {
        applyLoad(load);
        sumForces(state_, balance_, poses, false, force, loading_.changes_strength);
        ++work_.forces;
    };
    Vec6s before;
    sum(load_ + at.value, before);
    sum(load_ + at.value + difference, rate);
    for (std::size_t r = 0; r < rate.size(); ++r) rate[r] = (rate[r] - before[r]) / difference;
}

double PathEquations::merit(const Vec6s& force) const {
    double sum = 0;
    for (std::size_t r = 0; r < force.size(); ++r)
        sum += force[r].squaredNorm() / (balance_.weight[r] * balance_.weight[r]);
    return std::sqrt(sum);
}

std::vector<std::size_t> PathEquations::worstRows(const Vec6s& force) const {
    std::vector<std::pair<double, std::size_t>> parts;
    double left = 0;
    for (std::size_t r = 0; r < force.size(); ++r) {
        parts.emplace_back(force[r].squaredNorm() / (balance_.weight[r] * balance_.weight[r]), r);
        left += parts.back().first;
    }
    std::vector<std::size_t> rows;
    if (!std::isfinite(left)) return rows;
    std::sort(parts.begin(), parts.end(), std::greater<>());
    const double of_others = rules_.local_others * left;
    while (rows.size() < parts.size() && left > of_others) {
        left -= parts[rows.size()].first;
        rows.push_back(parts[rows.size()].second);
    }
    return rows;
}

void PathEquations::slow(const std::vector<std::size_t>& rows) {
    for (const std::size_t r : rows) {
        double& slowed = slowed_[balance_.block[r]];
        slowed = std::min(rules_.release_slowed * slowed, kMostSlowed);
    }
}

void PathEquations::recover(double share) {
    for (double& slowed : slowed_) slowed = std::max(1.0, share * slowed);
}

bool PathEquations::factorise(const Arc& arc, const PathStep& at) {
    for (std::size_t r = 0; r < balance_.block.size(); ++r)
        balance_.matrix.diagonal[r].diagonal().array() += drag(arc, at, r);
    ++work_.factors;
    return linear_->factorise(balance_.matrix, balance_.weight);
}

}  // namespace talus::equilibrium
