#include "equilibrium/local_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "equilibrium/block_matrix.h"

namespace talus::equilibrium {
namespace {

constexpr int kIterations = 12;         // of Newton's method for these blocks
constexpr double kLeastDecrease = 0.1;  // of the residual, by a whole correction
constexpr double kNear = 0.5;           // of the first residual

/// The blocks that move, and what all others leave them of the equations.
class Part {
 public:
    Part(const PathEquations& equations, const Arc& arc, const std::vector<char>& moving, const PathStep& at)
        : equations_(equations), balance_(makeBalance(equations.state(), moving)) {
        for (const std::size_t block : balance_.block) {
            const auto row = static_cast<std::size_t>(equations.balance().row[block]);
            row_.push_back(row);
            drag_.push_back(equations.drag(arc, at, row));
            x_.push_back(at.x[row]);
        }
    }

    bool settle(Poses& poses) {
        BlockLu factors(balance_.matrix, equations_.state().instructions);
        const double first = residual(poses, x_, true);
        double merit = first;
        for (int k = 0; k < kIterations && !isEquilibrium(); ++k) {
            for (std::size_t q = 0; q < drag_.size(); ++q)
                balance_.matrix.diagonal[q].diagonal().array() += drag_[q];
            if (!std::isfinite(merit) || !factors.factorise(balance_.matrix)) return false;
            Vec6s correction = residual_;
            factors.solve(correction);
            const double share = searchLine(poses, correction, merit);
            if (share == 0) break;
            move(balance_, correction, share, poses);
            add(share, correction, x_);
            merit = residual(poses, x_, true);
        }
        return merit < kNear * first;
    }

    void writeTo(PathStep& at) const {
        for (std::size_t q = 0; q < row_.size(); ++q) at.x[row_[q]] = x_[q];
    }

 private:
    static void add(double share, const Vec6s& by, Vec6s& x) {
        for (std::size_t q = 0; q < x.size(); ++q) x[q] += share * by[q];
    }

    /// Into residual_. \return the root of the sum of squares over the weights
    double residual(const Poses& poses, const Vec6s& x, bool stiffness) {
        sumForces(equations_.state(), balance_, poses, stiffness, residual_);
        double sum = 0;
        for (std::size_t q = 0; q < x.size(); ++q) {
            residual_[q] -= drag_[q] * x[q];
            sum += residual_[q].squaredNorm() / (balance_.weight[q] * balance_.weight[q]);
        }
        return std::sqrt(sum);
    }

    bool isEquilibrium() const {
        for (std::size_t q = 0; q < row_.size(); ++q)
            if (!(equations_.inaccuracy(row_[q], residual_[q]) < 1)) return false;
        return true;
    }

    /// The longest of a few halved corrections that lessens the residual enough, else the best of them.
    double searchLine(const Poses& poses, const Vec6s& correction, double merit) {
        double share = 1, best = kInfinity, best_share = 0;
        for (int k = 0; k < static_cast<int>(equations_.rules().newton_halvings); ++k, share *= 0.5) {
            Poses tried = poses;
            move(balance_, correction, share, tried);
            Vec6s x = x_;
            add(share, correction, x);
            const double now = residual(tried, x, false);
            if (now < best) best = now, best_share = share;
            if (now < (1 - kLeastDecrease * share) * merit) break;
        }
        return best_share;
    }

    const PathEquations& equations_;
    Balance balance_;
    std::vector<std::size_t> row_{};  ///< of the whole balance, for each of these blocks
    std::vector<double> drag_{};      ///< [N/m]
    Vec6s x_{}, residual_{};
};

std::vector<char> withNeighbours(const Balance& balance, const std::vector<std::size_t>& rows,
                                 std::size_t blocks, int rings) {
    std::vector<char> moving(blocks, 0);
    for (const std::size_t r : rows) moving[balance.block[r]] = 1;
    for (int k = 0; k < rings; ++k) {
        const std::vector<char> inner = moving;
        for (const ActiveInterface& i : balance.interfaces)
            if (inner[i.block_a] != 0 || inner[i.block_b] != 0) moving[i.block_a] = moving[i.block_b] = 1;
    }
    return moving;
}

}  // namespace

bool settleWorst(const PathEquations& equations, const Arc& arc, const Vec6s& residual, PathStep& at,
                 Poses& poses) {
    const Balance& balance = equations.balance();
    const SearchRules& rules = equations.rules();
    const std::vector<char> moving =
        withNeighbours(balance, equations.worstRows(residual), equations.state().blocks.size(),
                       static_cast<int>(rules.local_rings));
    std::size_t count = 0;
    for (const std::size_t block : balance.block) count += moving[block] != 0 ? 1 : 0;
    if (static_cast<double>(count) > rules.local_share * static_cast<double>(balance.block.size()))
        return false;
    Part part(equations, arc, moving, at);
    Poses moved = poses;
    if (!part.settle(moved)) return false;
    poses = std::move(moved);
    part.writeTo(at);
    return true;
}

}  // namespace talus::equilibrium
