#include "equilibrium/path_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equilibrium/local_equilibrium.h"

namespace talus::equilibrium {
namespace {

// Of a correction: blocks that let less of it converge are slowed in pseudo-time.
constexpr double kShortShare = 1.0 / 8;

double inverseSquare(double length) { return std::isfinite(length) ? 1 / (length * length) : 0.0; }

/// The bordered system about a point: corrections are a + t b, with t from the arc.
class Bordered {
 public:
    Bordered(PathEquations& equations, const Arc& arc)
        : equations_(equations),
          arc_(arc),
          by_x_(inverseSquare(arc.displacement)),
          by_value_(arc.unknown == Unknown::load ? inverseSquare(arc.load) : 0.0) {}

    /// How far a point is from the arc: (|x| / d)^2 + (s / l)^2 - 1.
    double misses(const PathStep& at) const {
        if (arc_.unknown == Unknown::none) return 0;
        return by_x_ * equations_.dot(at.x, at.x) + by_value_ * at.value * at.value - 1;
    }

    /// Computes the derivative by the unknown at a point. \pre its matrix is factorised
    bool takeRate(const PathStep& at, const Poses& poses) {
        if (arc_.unknown == Unknown::none) return true;
        equations_.byUnknown(arc_, at, poses, rate_);
        return equations_.solve(rate_);
    }

    /// Turns a residual into the correction of a point. \return the change of the unknown
    bool correct(const PathStep& at, Vec6s& residual, double& change,
                 double accuracy = IterativeSolver::kAccuracy) const {
        if (!equations_.solve(residual, accuracy)) return false;
        change = 0;
        if (arc_.unknown == Unknown::none) return true;
        change = onArc(at, residual);
        for (std::size_t r = 0; r < residual.size(); ++r) residual[r] += change * rate_[r];
        return true;
    }

    /// Of a correction, in arcs.
    double length(const Vec6s& x, double change) const {
        const double by_x = by_x_ > 0 ? by_x_ : 1.0;
        return std::sqrt(by_x * equations_.dot(x, x) + by_value_ * change * change);
    }

    const Vec6s& rate() const { return rate_; }
    double byX() const { return by_x_; }
    double byValue() const { return by_value_; }

 private:
    /// Of the line's two points on the arc, the forward one; where the line misses the arc, the nearest.
    double onArc(const PathStep& at, const Vec6s& a) const {
        Vec6s y(a.size());
        for (std::size_t r = 0; r < a.size(); ++r) y[r] = at.x[r] + a[r];
        const double second = by_x_ * equations_.dot(rate_, rate_) + by_value_;
        const double first = by_x_ * equations_.dot(y, rate_) + by_value_ * at.value;
        const double none = by_x_ * equations_.dot(y, y) + by_value_ * at.value * at.value - 1;
        const double discriminant = first * first - second * none;
        if (discriminant < 0) return -first / second;
        const double root = std::sqrt(discriminant);
        const double along = equations_.dot(at.x, y), by_rate = equations_.dot(at.x, rate_);
        const auto goesOn = [&](double t) {
            return by_x_ * (along + t * by_rate) + by_value_ * at.value * (at.value + t);
        };
        const double forth = (-first + root) / second, back = (-first - root) / second;
        return goesOn(forth) > goesOn(back) ? forth : back;
    }

    PathEquations& equations_;
    const Arc& arc_;
    double by_x_, by_value_;
    Vec6s rate_{};
};

void add(double share, const Vec6s& x, double change, PathStep& to) {
    for (std::size_t r = 0; r < x.size(); ++r) to.x[r] += share * x[r];
    to.value += share * change;
}

}  // namespace

PathStep solveStep(PathEquations& equations, const Arc& arc, PathStep at) {
    const SearchRules& rules = equations.rules();
    Bordered bordered(equations, arc);
    Poses poses = equations.moved(at.x), tried_poses;
    PathStep tried;
    Vec6s residual, correction, next;
    int stalls = 0;
    double last_share = 1;
    at.converged = false;
    at.unknown = arc.unknown;
    for (at.iterations = 1; at.iterations <= static_cast<int>(rules.newton_iterations); ++at.iterations) {
        if (equations.stopped()) return at;
        equations.residual(arc, at, poses, true, residual);
        const double inaccuracy = equations.inaccuracy(residual);
        if (!std::isfinite(inaccuracy)) return at;
        if (inaccuracy < 1 && std::abs(bordered.misses(at)) < rules.on_arc) {
            at.converged = true;
            return at;
        }
        if (std::exchange(last_share, 1.0) < 1 && settleWorst(equations, arc, residual, at, poses)) {
            --at.iterations;
            continue;
        }
        if (!equations.factorise(arc, at)) return at;
        correction = residual;
        double change = 0;
        if (!bordered.takeRate(at, poses) || !bordered.correct(at, correction, change)) return at;
        const double length = bordered.length(correction, change), merit = equations.merit(residual);
        double share =
            std::isfinite(arc.displacement) ? std::min(1.0, rules.longest_correction / length) : 1.0;
        double best = kInfinity, best_share = 0;
        for (int k = 0; k < static_cast<int>(rules.newton_halvings); ++k, share *= 0.5) {
            tried = at;
            add(share, correction, change, tried);
            tried_poses = poses;
            move(equations.balance(), correction, share, tried_poses);
            equations.residual(arc, tried, tried_poses, false, next);
            const double next_merit = equations.merit(next);
            if (merit < rules.near_merit && next_merit < (1 - 0.5 * share) * merit) {
                best = 0.5, best_share = share;
                break;
            }
            if (merit < rules.near_merit && next_merit > rules.merit_growth * merit) continue;  // oscillating
            double next_change = 0;
            if (!bordered.correct(tried, next, next_change, rules.test_accuracy)) return at;
            const double shrinks = bordered.length(next, next_change) / length;
            if (shrinks < best) best = shrinks, best_share = share;
            if (shrinks < 1 - 0.5 * share) break;
        }
        if (best_share == 0) return at;
        last_share = best_share;
        if (arc.drag > 0 && best_share <= kShortShare) {
            tried = at;
            add(1.0, correction, change, tried);
            equations.residual(arc, tried, equations.moved(tried.x), false, next);
            equations.slow(equations.worstRows(next));
            best = 0;
        }
        stalls = best < rules.stalled || at.iterations == 1 ? 0 : stalls + 1;
        if (stalls > static_cast<int>(rules.newton_stalls)) return at;
        move(equations.balance(), correction, best_share, poses);
        add(best_share, correction, change, at);
    }
    return at;
}

namespace {

/// With the drag that lets blocks move as far as the arc; where even the least drag does not, farther along
/// the same line.
PathStep slideStep(PathEquations& equations, const Arc& arc, PathStep at) {
    constexpr int kTries = 4;
    constexpr double kMuchFarther = 2;
    Vec6s way;
    at.value = equations.rules().release_drag;
    for (int k = 0; k < kTries; ++k) {
        equations.residual(arc, at, equations.poses(), true, way);
        if (!equations.factorise(arc, at) || !equations.solve(way)) return {};
        const double scale = arc.displacement / equations.norm(way);
        if (!std::isfinite(scale) || !(scale > 0)) return {};
        if (scale * kMuchFarther > 1 || k + 1 == kTries) {
            at.value /= scale;
            add(scale, way, 0.0, at);
            return at;
        }
        at.value /= scale;  // a drag that dominates keeps displacements in proportion
    }
    return {};
}

}  // namespace

PathStep tangentStep(PathEquations& equations, const Arc& arc, const PathStep& last) {
    const std::size_t rows = equations.balance().block.size();
    PathStep at{.unknown = arc.unknown, .x = Vec6s(rows, Vec6::Zero())};
    if (arc.unknown == Unknown::drag) return slideStep(equations, arc, std::move(at));
    Vec6s force;
    Bordered bordered(equations, arc);
    equations.residual(arc, at, equations.poses(), true, force);
    if (!equations.factorise(arc, at)) return {};
    if (arc.unknown == Unknown::none) return at;
    if (!bordered.takeRate(at, equations.poses())) return {};
    const Vec6s& rate = bordered.rate();
    const double length = std::sqrt(bordered.byX() * equations.dot(rate, rate) + bordered.byValue());
    if (!std::isfinite(length)) return {};
    double sign = 1;
    if (last.unknown == Unknown::load && last.x.size() == rows)
        sign = bordered.byX() * equations.dot(rate, last.x) + bordered.byValue() * last.value < 0 ? -1 : 1;
    at.value = sign / length;
    add(at.value, rate, 0.0, at);
    return at;
}

PathStep secantStep(const PathEquations& equations, const Arc& arc, const PathStep& last) {
    if (last.x.size() != equations.balance().block.size() || last.unknown != arc.unknown) return {};
    const double by_x = inverseSquare(arc.displacement);
    const double by_value = arc.unknown == Unknown::load ? inverseSquare(arc.load) : 0.0;
    const double length =
        std::sqrt(by_x * equations.dot(last.x, last.x) + by_value * last.value * last.value);
    if (!(length > 0)) return {};
    PathStep at{.x = Vec6s(last.x.size(), Vec6::Zero())};
    add(1 / length, last.x, 0.0, at);
    at.value = arc.unknown == Unknown::drag ? last.value * length : last.value / length;
    return at;
}

}  // namespace talus::equilibrium
