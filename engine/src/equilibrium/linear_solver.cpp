#include "equilibrium/linear_solver.h"

namespace talus::equilibrium {
namespace {

constexpr double kIterations = 15;  // that a system is taken to need
constexpr int kDirectAfterFailure = 8;
// Iterations after which complete factors are worth it, times kIterations; and the most where they are not.
constexpr double kMostOfDirect = 30;
constexpr std::size_t kMostIterations = 300;

/// Of blocks, in so many iterations.
double products(const BlockMatrix& structure, double iterations) {
    return iterations * static_cast<double>(3 * structure.rows() + 4 * structure.edges.size());
}

}  // namespace

LinearSolver::LinearSolver(const BlockMatrix& structure, simd::InstructionSet instructions,
                           const std::atomic<bool>* stop)
    : instructions_(instructions), stop_(stop) {
    direct_.emplace(structure, instructions, stop, products(structure, kIterations));
    if (!direct_->isTooLarge()) return;
    direct_.reset();
    iterative_.emplace(structure, instructions);
}

/// \return whether that has solved it; else complete factors are due, where they are not too large
bool LinearSolver::iterate(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x) {
    const bool is_too_large = direct_ && direct_->isTooLarge();
    if (!is_too_large && iterative_->solve(matrix, weight, x)) return true;
    if (!direct_)
        direct_.emplace(matrix, instructions_, stop_, products(matrix, kMostOfDirect * kIterations));
    return direct_->isTooLarge() && iterative_->solve(matrix, weight, x, kMostIterations);
}

bool LinearSolver::solve(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x) {
    if (iterative_ && direct_next_ == 0) {
        if (iterate(matrix, weight, x)) return true;
        if (direct_->isTooLarge()) return false;
        direct_next_ = kDirectAfterFailure;
    }
    if (direct_next_ > 0) --direct_next_;
    if (!direct_->factorise(matrix)) return false;
    direct_->solve(x);
    return true;
}

}  // namespace talus::equilibrium
