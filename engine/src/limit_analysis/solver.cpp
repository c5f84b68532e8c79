#include "limit_analysis/solver.h"

#include <algorithm>

namespace talus::limit {
namespace {

constexpr int kOutsideRounds = 8;  // in which pyramids outside the cones are refined

}  // namespace

Solver::Solver(const Assembly& assembly, std::vector<contact::JointLaw> laws, const Control& control)
    : assembly_(assembly), laws_(std::move(laws)), control_(control), pyramids_(assembly) {}

Programme Solver::make(Side side, const Loads& fixed, const Loads& growing) const {
    Programme programme(assembly_, laws_, pyramids_, side, fixed, growing, control_.stop);
    if (basis_side_ == side && !refined_) programme.startFrom(basis_);
    return programme;
}

/// Counts, and keeps the basis for the next programme.
void Solver::account(const Programme& programme, Side side) {
    ++effort_.programmes;
    effort_.iterations += programme.iterations();
    effort_.rows = std::max(effort_.rows, programme.rows());
    effort_.columns = std::max(effort_.columns, programme.columns());
    basis_ = programme.basis();
    basis_side_ = side;
}

Balance Solver::read(const Programme& programme, Outcome outcome) {
    Balance found{.outcome = outcome};
    if (outcome != Outcome::optimal) return found;
    found.imbalance = programme.imbalance();
    found.balanced = found.imbalance <= kBalanced;
    if (found.balanced) return found;
    found.growth = programme.imbalanceGrowth();
    mechanism_ = programme.mechanism();
    return found;
}

Balance Solver::checkInside(const Loads& loads) {
    Programme programme = make(Side::inside, loads, Loads(loads.size()));
    Outcome outcome = programme.balance();
    refined_ = false;
    while (outcome == Outcome::optimal && programme.imbalance() > kBalanced &&
           programme.refineInside(pyramids_)) {
        refined_ = true;
        outcome = programme.solveAgain();
    }
    account(programme, Side::inside);
    return read(programme, outcome);
}

Balance Solver::check(const Loads& loads, Side side) {
    if (side == Side::inside) return checkInside(loads);
    for (int round = 1;; ++round) {
        Programme programme = make(side, loads, Loads(loads.size()));
        const Outcome outcome = programme.balance();
        const Balance found = read(programme, outcome);
        account(programme, side);
        refined_ = found.balanced && programme.refineOutside(pyramids_);
        if (!refined_ || round == kOutsideRounds) return found;
    }
}

Growth Solver::growOnce(const Loads& fixed, const Loads& growing, double least, double most, Side side) {
    Programme programme = make(side, fixed, growing);
    Growth found{.outcome = programme.balance()};
    if (found.outcome == Outcome::optimal) found.outcome = programme.growMost(least, most);
    refined_ = false;
    while (side == Side::inside && found.outcome == Outcome::optimal && programme.refineInside(pyramids_)) {
        refined_ = true;
        found.outcome = programme.solveAgain();
    }
    account(programme, side);
    if (found.outcome != Outcome::optimal) return found;
    found.multiplier = programme.multiplier();
    if (side == Side::outside)
        refined_ = programme.refineOutside(pyramids_);
    else
        mechanism_ = programme.mechanism();
    return found;
}

Growth Solver::grow(const Loads& fixed, const Loads& growing, double least, double most, Side side,
                    double enough) {
    for (int round = 1;; ++round) {
        const Growth found = growOnce(fixed, growing, least, most, side);
        const bool done = found.outcome != Outcome::optimal || found.multiplier <= enough || !refined_;
        if (side == Side::inside || done || round == kOutsideRounds) return found;
    }
}

}  // namespace talus::limit
