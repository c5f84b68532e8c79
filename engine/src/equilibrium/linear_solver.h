#pragma once
// The linear systems of Newton's method: factors for few blocks, iterations for many.

#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

#include "equilibrium/block_matrix.h"
#include "equilibrium/iterative_solver.h"

namespace talus::equilibrium {

/// Solves systems of one structure, several right sides with each matrix. Where complete factors would take
/// far longer, iterations are tried first. If they do not converge, this matrix and the next ones get
/// complete factors; or more iterations, where complete factors would take minutes.
class LinearSolver {
 public:
    /// \param stop  ends the work early: then nothing is solved
    LinearSolver(const BlockMatrix& structure, simd::InstructionSet instructions,
                 const std::atomic<bool>* stop);

    /// Takes a matrix of that structure. It must live until the next one is taken.
    /// \param weight  of each row, by which residuals are compared
    /// \return false when a diagonal block is singular, or when asked to stop
    bool factorise(const BlockMatrix& matrix, const std::vector<double>& weight);

    /// x = A^-1 x, exactly or, by iterations, to an accuracy.
    /// \pre  factorise() was true
    /// \return false when iterations do not converge, or when asked to stop
    bool solve(Vec6s& x, double accuracy = IterativeSolver::kAccuracy);

 private:
    bool factoriseDirectly();

    simd::InstructionSet instructions_;
    const std::atomic<bool>* stop_;
    const BlockMatrix* matrix_ = nullptr;
    const std::vector<double>* weight_ = nullptr;
    std::optional<BlockLu> direct_{};  ///< from the first matrix for which iterations failed
    std::optional<IterativeSolver> iterative_{};
    bool is_direct_ = true;  ///< of the matrix taken last
    int direct_next_ = 0;    ///< so many matrices have complete factors
};

}  // namespace talus::equilibrium
