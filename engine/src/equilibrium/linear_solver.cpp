#include "equilibrium/linear_solver.h"

#include <cassert>

namespace talus::equilibrium {
namespace {

// Iterations that a system is assumed to need: they then replace factors at some 200 free blocks in space,
// with a tenth to a quarter less time.
constexpr double kIterations = 15;
constexpr int kDirectAfterFailure = 8;
// Iterations, times kIterations, after which complete factors are cheaper; and the most iterations where they
// are not.
constexpr double kMostOfDirect = 30;
constexpr std::size_t kMostIterationsAlone = 300;

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

bool LinearSolver::factoriseDirectly() {
    if (!direct_)
        direct_.emplace(*matrix_, instructions_, stop_, products(*matrix_, kMostOfDirect * kIterations));
    is_direct_ = !direct_->isTooLarge() && direct_->factorise(*matrix_);
    return is_direct_;
}

bool LinearSolver::factorise(const BlockMatrix& matrix, const std::vector<double>& weight) {
    matrix_ = &matrix;
    weight_ = &weight;
    if (!iterative_) return factoriseDirectly();
    is_direct_ = false;
    if (direct_next_ > 0) {
        --direct_next_;
        if (factoriseDirectly()) return true;
    }
    return iterative_->factorise(matrix) || factoriseDirectly();
}

bool LinearSolver::solve(Vec6s& x, double accuracy) {
    assert(matrix_ != nullptr && x.size() == matrix_->rows());
    if (!is_direct_) {
        if (iterative_->solve(*matrix_, *weight_, x, accuracy)) return true;
        const bool may_be_direct = !direct_ || !direct_->isTooLarge();
        if (!may_be_direct || !factoriseDirectly())
            return iterative_->solve(*matrix_, *weight_, x, accuracy, kMostIterationsAlone);
        direct_next_ = kDirectAfterFailure;
    }
    direct_->solve(x);
    return true;
}

}  // namespace talus::equilibrium
