#include "flow/solve.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "flow/linear_system.h"

namespace talus::flow {
namespace {

constexpr int kOutletSwitches = 300;  // of full joints: the wet part grows by about a row of nodes each time
constexpr int kSteps = 300;          // most networks take 40; 150 suffice for all random ones that were tried
constexpr double kOrders = -9;       // log10 of the imbalance at the end, for progress
constexpr double kRounding = 1e-13;  // of the inflow: no step can lower that

// Steps, as multiples of a node's storage over its conductance. Halving or doubling each of them moves no answer
// (bench/studies/free-surface.md).
constexpr double kFirstStep = 100;
constexpr double kLonger = 3;   // ratio, after a step that is taken
constexpr double kShorter = 5;  // ratio, after one that is not; in `narrow`, too, where outlets were switched
constexpr double kWorse = 4;    // imbalance after a step over that before it: such a step is not taken

class Solver {
 public:
    Solver(const Network& network, const Conditions& conditions, const std::vector<Corners>& transmissivity,
           const FreeSurface& surface, const Telling& telling)
        : conditions_(conditions),
          telling_(telling),
          equations_(network, conditions, transmissivity, surface),
          heads_(Vector::Zero(static_cast<Eigen::Index>(network.nodes.size()))) {}

    Heads full(const std::vector<double>& begin) {
        const bool found = (beginWith(begin) && solveAndSwitch()) || fill();
        return result(0, equations_.full(), found);
    }

    Heads withFreeSurface(const std::vector<double>& begin) {
        const double ramp = equations_.ramp();
        bool found = beginWith(begin) && settle(ramp, 1);
        if (!found) {
            fill();
            found = settle(ramp, 1) || narrow(ramp);
        }
        return result(ramp, equations_.wetnessOf(heads_, ramp), found);
    }

 private:
    /// How many of the orders of magnitude the imbalance has fallen by. \param residual  0: not known yet
    void tell(double residual) const {
        if (!telling_) return;
        const double done = residual > 0 ? std::clamp(std::log10(residual) / kOrders, 0.0, 1.0) : 0.0;
        telling_(
            {"flow", done,
             std::to_string(conditions_.of.size()) + " nodes, iteration " + std::to_string(iterations_)});
    }

    /// Heads above the datum, and outlets open where these have pressure. \return whether there are any
    bool beginWith(const std::vector<double>& heads) {
        if (heads.empty()) return false;
        for (std::size_t n = 0; n < heads.size(); ++n) {
            heads_[static_cast<Eigen::Index>(n)] =
                conditions_.of[n] == Condition::dry ? 0.0 : heads[n] - equations_.datum();
        }
        equations_.openOutlets(heads_);
        return true;
    }

    /// Heads of full joints. \return whether they balance, and outlets ceased to open and close
    bool fill() {
        equations_.openOutlets();
        heads_.setZero();
        return solveAndSwitch();
    }

    bool solveAndSwitch() {
        bool switched = true;
        Vector inflow;
        for (int k = 0; switched && k < kOutletSwitches; ++k, ++iterations_) {
            tell(0);
            solveFull();
            inflow = equations_.inflows(heads_, equations_.full());
            switched = equations_.switchOutlets(heads_, inflow);
        }
        residual_ = equations_.imbalance(inflow);
        return !switched && equations_.isBalanced(heads_, inflow);
    }

    /// The later passes take back what rounding left of the first.
    void solveFull() {
        equations_.hold(heads_);
        const Wetness wetness = equations_.full();
        const SparseMatrix matrix = equations_.derivative(heads_, wetness);
        if (!analysed_) cholesky_.analyzePattern(matrix), analysed_ = true;
        cholesky_.factorize(matrix);
        for (int pass = 0; pass < 3; ++pass) heads_ += cholesky_.solve(unbalanced(heads_, wetness));
    }

    /// Inflows of nodes that are not held, with the opposite sign; zero at the others.
    Vector unbalanced(const Vector& heads, const Wetness& wetness) const {
        Vector rest = -equations_.inflows(heads, wetness);
        for (Eigen::Index n = 0; n < rest.size(); ++n)
            if (equations_.isHeld(static_cast<std::size_t>(n))) rest[n] = 0;
        return rest;
    }

    /// Halves the ramp, from the height of a polygon to the last one. Each solution starts from the heads before.
    bool narrow(double last) {
        fill();
        double ramp = std::max(last, equations_.height());
        bool found = settle(ramp, kShorter);
        while (found && ramp > last) {
            ramp = std::max(ramp / 2, last);
            found = settle(ramp, kShorter);
        }
        return found;
    }

    /// Steps from the heads as they are until nothing changes. \return whether that was found
    /// \param switched_by  what divides a step after which outlets opened or closed
    bool settle(double ramp, double switched_by) {
        double step = kFirstStep;
        for (int k = 0; k < kSteps; ++k, ++iterations_) {
            equations_.hold(heads_);
            const Vector inflow = equations_.inflows(heads_, equations_.wetnessOf(heads_, ramp));
            const bool switched = equations_.switchOutlets(heads_, inflow);
            residual_ = equations_.imbalance(inflow);
            tell(residual_);
            if (!switched && equations_.isBalanced(heads_, inflow)) return polish(ramp), true;
            equations_.hold(heads_);
            const auto [heads, growth] = stepped(ramp, step);
            const bool is_taken = growth < kWorse;
            if (is_taken) heads_ = heads;
            step = !is_taken ? step / kShorter : switched ? step / switched_by : kLonger * step;
        }
        return false;
    }

    /// A step or two of Newton's method take a balance to rounding.
    void polish(double ramp) {
        for (int k = 0; k < 2 && residual_ > kRounding; ++k) {
            const Vector heads = stepped(ramp, kInfinity).heads;
            const double now =
                equations_.imbalance(equations_.inflows(heads, equations_.wetnessOf(heads, ramp)));
            if (!(now < residual_)) return;
            heads_ = heads;
            residual_ = now;
        }
    }

    struct Stepped {
        Vector heads;
        double growth = kInfinity;  ///< of the imbalance, summed over the nodes
    };

    /// The growth is infinite where the step's system has no solution.
    Stepped stepped(double ramp, double step) {
        const Wetness wetness = equations_.wetnessOf(heads_, ramp);
        const Vector rest = unbalanced(heads_, wetness);
        SparseMatrix matrix = equations_.derivative(heads_, wetness);
        equations_.addStorage(1 / step, matrix);
        const std::optional<Vector> change = system_.solve(matrix, rest);
        if (!change) return {heads_};
        Vector heads = heads_ + *change;
        equations_.stopInRamp(heads_, ramp, heads);
        const double after = unbalanced(heads, equations_.wetnessOf(heads, ramp)).lpNorm<1>();
        return {std::move(heads), after / rest.lpNorm<1>()};
    }

    Heads result(double ramp, const Wetness& wetness, bool found) const {
        Heads result;
        const Vector inflow = equations_.inflows(heads_, wetness);
        const bool still = equations_.isStill(heads_);  // what flows is rounding
        for (std::size_t n = 0; n < conditions_.of.size(); ++n) {
            const bool dry = conditions_.of[n] == Condition::dry;
            const auto i = static_cast<Eigen::Index>(n);
            result.head.push_back(dry ? std::numeric_limits<double>::quiet_NaN()
                                      : heads_[i] + equations_.datum());
            result.inflow.push_back(dry || still ? 0.0 : inflow[i]);
        }
        result.wet_share = equations_.sharesOf(wetness);
        result.iterations = iterations_;
        result.ramp = ramp;
        result.residual = residual_;
        if (found) result.residual = still ? 0 : equations_.imbalance(inflow);
        result.found = found;
        return result;
    }

    const Conditions& conditions_;
    const Telling& telling_;
    Equations equations_;
    Vector heads_;  ///< above the datum [m]
    Eigen::SimplicialLDLT<SparseMatrix> cholesky_;
    bool analysed_ = false;
    LinearSystem system_;
    int iterations_ = 0;
    double residual_ = 0;
};

}  // namespace

Heads solveHeads(const Network& network, const Conditions& conditions,
                 const std::vector<Corners>& transmissivity, bool free_surface, const FreeSurface& surface,
                 const Telling& telling, const std::vector<double>& begin) {
    Solver solver(network, conditions, transmissivity, surface, telling);
    return free_surface ? solver.withFreeSurface(begin) : solver.full(begin);
}

}  // namespace talus::flow
