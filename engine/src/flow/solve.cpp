#include "flow/solve.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "flow/linear_system.h"

namespace talus::flow {
namespace {

constexpr int kBeginIterations = 60;  // before Newton's method; dams of 8,000 joints need 30
constexpr double kBegun = 1e-3;       // of the inflow: imbalance from which Newton's method converges
constexpr int kStageIterations = 60;  // most stages take ten
constexpr double kRounding = 1e-13;   // of the inflow: no step can lower that
constexpr int kLineSearch = 12;       // halvings of a step
constexpr double kArmijo = 1e-4;      // share of the expected decrease that a step must bring
constexpr double kSlower = 0.5, kFaster = 1.2;  // what turns back moves more slowly, what goes on faster

class Solver {
 public:
    Solver(const Network& network, const Conditions& conditions, const std::vector<double>& transmissivity,
           const FreeSurface& surface)
        : conditions_(conditions),
          last_ramp_(surface.last_ramp),
          equations_(network, conditions, transmissivity, surface),
          heads_(Vector::Zero(static_cast<Eigen::Index>(network.nodes.size()))),
          shares_(network.triangles.size(), 1.0) {}

    Heads full() {
        bool wrong = true;
        for (; wrong && iterations_ < kStageIterations; ++iterations_) {
            solveLinear();
            wrong = equations_.switchOutlets(heads_, equations_.inflows(heads_, shares_));
        }
        const Vector inflow = equations_.inflows(heads_, shares_);
        residual_ = equations_.imbalance(inflow);
        return result(0, !wrong && equations_.isBalanced(heads_, shares_, inflow));
    }

    /// In thick sections a ramp as high as a polygon may be too narrow to begin with.
    Heads withFreeSurface() {
        const std::vector<char> held = equations_.held();
        const std::vector<double> shares = shares_;
        double ramp = 0;
        for (const double first : {equations_.height(), equations_.size()}) {
            equations_.setHeld(held);
            shares_ = shares;
            heads_.setZero();
            ramp = narrowestFrom(first);
            if (ramp > 0) break;
        }
        shares_ = equations_.sharesOf(heads_, ramp > 0 ? ramp : equations_.size());
        return result(ramp, ramp > 0);
    }

 private:
    /// Heads with constant shares. The later passes take back what rounding left of the first.
    void solveLinear() {
        equations_.hold(heads_);
        const SparseMatrix matrix = equations_.conductance(shares_);
        if (!analysed_) cholesky_.analyzePattern(matrix), analysed_ = true;
        cholesky_.factorize(matrix);
        for (int pass = 0; pass < 3; ++pass) heads_ += cholesky_.solve(unbalanced(heads_, shares_));
    }

    /// What has to be taken off the inflows of nodes that are not held.
    Vector unbalanced(const Vector& heads, const std::vector<double>& shares) const {
        Vector rest = -equations_.inflows(heads, shares);
        for (Eigen::Index n = 0; n < rest.size(); ++n)
            if (equations_.isHeld(static_cast<std::size_t>(n))) rest[n] = 0;
        return rest;
    }

    /// The narrowest ramp for which heads are found, which are those then; zero: not even for the first.
    double narrowestFrom(double first) {
        begin(first);
        double found = 0;
        for (double ramp = first; ramp >= last_ramp_ * equations_.height(); ramp /= 2) {
            const std::vector<char> held = equations_.held();
            const Vector heads = heads_;
            if (!converge(ramp)) {
                equations_.setHeld(held);
                heads_ = heads;
                break;
            }
            found = ramp;
        }
        return found;
    }

    /// Each triangle's share moves by its own weight: less where it went to and fro.
    void begin(double ramp) {
        std::vector<double> weight(shares_.size(), 1.0), before(shares_.size(), 0.0);
        for (int k = 0; k < kBeginIterations; ++k, ++iterations_) {
            solveLinear();
            const bool switched = equations_.switchOutlets(heads_, equations_.inflows(heads_, shares_));
            const std::vector<double> next = equations_.sharesOf(heads_, ramp);
            const Vector inflow = equations_.inflows(heads_, next);
            if (!switched &&
                (equations_.imbalance(inflow) < kBegun || equations_.isBalanced(heads_, next, inflow)))
                return;
            for (std::size_t t = 0; t < next.size(); ++t) {
                const double step = next[t] - shares_[t];
                weight[t] = step * before[t] < 0 ? kSlower * weight[t] : std::min(1.0, kFaster * weight[t]);
                before[t] = step;
                shares_[t] += weight[t] * step;
            }
        }
    }

    /// One stage of Newton's method.
    bool converge(double ramp) {
        for (int k = 0; k < kStageIterations; ++k, ++iterations_) {
            equations_.hold(heads_);
            const std::vector<double> shares = equations_.sharesOf(heads_, ramp);
            const Vector inflow = equations_.inflows(heads_, shares);
            const bool switched = equations_.switchOutlets(heads_, inflow);
            residual_ = equations_.imbalance(inflow);
            if (!switched && equations_.isBalanced(heads_, shares, inflow)) return polish(ramp), true;
            equations_.hold(heads_);
            if (!step(ramp)) return false;
        }
        return false;
    }

    /// One step more takes a balance to rounding.
    void polish(double ramp) {
        for (int k = 0; k < 2 && residual_ > kRounding; ++k) {
            const Vector before = heads_;
            if (!step(ramp)) return;
            const double now =
                equations_.imbalance(equations_.inflows(heads_, equations_.sharesOf(heads_, ramp)));
            if (!(now < residual_)) heads_ = before;
            residual_ = std::min(now, residual_);
        }
    }

    /// False where the derivative has no inverse.
    bool step(double ramp) {
        const Vector rest = unbalanced(heads_, equations_.sharesOf(heads_, ramp));
        const std::optional<Vector> direction = newton_.solve(equations_.derivative(heads_, ramp), rest);
        if (!direction) return false;
        const double size = rest.norm();
        double length = 1;
        Vector trial;
        for (int k = 0; k < kLineSearch; ++k, length /= 2) {
            trial = heads_ + length * *direction;
            if (unbalanced(trial, equations_.sharesOf(trial, ramp)).norm() < (1 - kArmijo * length) * size)
                break;
        }
        heads_ = trial;
        return true;
    }

    Heads result(double ramp, bool found) const {
        Heads result;
        const Vector inflow = equations_.inflows(heads_, shares_);
        const bool still = equations_.isStill(heads_);  // what flows is rounding
        for (std::size_t n = 0; n < conditions_.of.size(); ++n) {
            const bool dry = conditions_.of[n] == Condition::dry;
            const auto i = static_cast<Eigen::Index>(n);
            result.head.push_back(dry ? std::numeric_limits<double>::quiet_NaN()
                                      : heads_[i] + equations_.datum());
            result.inflow.push_back(dry || still ? 0.0 : inflow[i]);
        }
        result.wet_share = shares_;
        result.iterations = iterations_;
        result.ramp = ramp;
        result.residual = residual_;
        if (found) result.residual = still ? 0 : equations_.imbalance(inflow);
        result.found = found;
        return result;
    }

    const Conditions& conditions_;
    double last_ramp_;  ///< of a patch's height
    Equations equations_;
    Vector heads_;                ///< above the datum [m]
    std::vector<double> shares_;  ///< of each triangle
    Eigen::SimplicialLDLT<SparseMatrix> cholesky_;
    bool analysed_ = false;
    LinearSystem newton_;
    int iterations_ = 0;
    double residual_ = 0;
};

}  // namespace

Heads solveHeads(const Network& network, const Conditions& conditions,
                 const std::vector<double>& transmissivity, bool free_surface, const FreeSurface& surface) {
    Solver solver(network, conditions, transmissivity, surface);
    return free_surface ? solver.withFreeSurface() : solver.full();
}

}  // namespace talus::flow
