#pragma once
// The linear systems of Newton's method: factors of few blocks, iterations for many.

#include <atomic>
#include <optional>
#include <vector>

#include "equilibrium/block_matrix.h"
#include "equilibrium/iterative_solver.h"

namespace talus::equilibrium {

/// Solves systems of one structure. Where complete factors would take far longer than some iterations, these are tried first; the
/// few systems that they do not come to the end of have complete factors, and so have the next ones; or more iterations, where
/// complete factors would take minutes.
class LinearSolver {
 public:
    /// \param stop  ends the work early: then nothing is solved
    LinearSolver(const BlockMatrix& structure, simd::InstructionSet instructions,
                 const std::atomic<bool>* stop);

    /// x = A^-1 x, exactly or to IterativeSolver::kAccuracy.
    /// \param matrix  of that structure
    /// \param weight  of each row, by which residuals are compared
    /// \return false when a diagonal block is singular, when iterations do not come to an end, or when asked to stop
    bool solve(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x);

 private:
    bool iterate(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x);

    simd::InstructionSet instructions_;
    const std::atomic<bool>* stop_;
    std::optional<BlockLu>
        direct_{};  ///< where there are iterations, from the first system that they fail at
    std::optional<IterativeSolver> iterative_{};
    int direct_next_ = 0;  ///< so many systems have complete factors
};

}  // namespace talus::equilibrium
