#include "equilibrium/linear_solver.h"

namespace talus::equilibrium {
namespace {

constexpr double kIterations = 15;  // that a system is taken to need
constexpr int kDirectAfterFailure = 8;

/// Products of blocks in complete factors, and what iterations take in such products.
bool isWorthIterating(const BlockMatrix& structure, double products) {
    const double blocks = static_cast<double>(3 * structure.rows() + 4 * structure.edges.size());
    return products > kIterations * blocks;
}

}  // namespace

LinearSolver::LinearSolver(const BlockMatrix& structure, simd::InstructionSet instructions,
                           const std::atomic<bool>* stop)
    : direct_(structure, instructions, stop) {
    if (isWorthIterating(structure, direct_.products())) iterative_.emplace(structure, instructions);
}

bool LinearSolver::solve(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x) {
    if (iterative_ && direct_next_ == 0) {
        if (iterative_->solve(matrix, weight, x)) return true;
        direct_next_ = kDirectAfterFailure;
    }
    if (direct_next_ > 0) --direct_next_;
    if (!direct_.factorise(matrix)) return false;
    direct_.solve(x);
    return true;
}

}  // namespace talus::equilibrium
