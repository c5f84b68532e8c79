#pragma once
// Linear systems of many free blocks: generalised minimal residuals, preconditioned by incomplete factors.

#include <vector>

#include "equilibrium/block_matrix.h"
#include "equilibrium/incomplete_lu.h"
#include "equilibrium/iteration_view.h"
#include "simd/instruction_set.h"

namespace talus::equilibrium {

/// GMRES (Saad and Schultz 1986) without restart, preconditioned from the right by incomplete factors. Time
/// and memory grow with the contacts.
class IterativeSolver {
 public:
    /// \param instructions  of the products; the same bits with each
    explicit IterativeSolver(const BlockMatrix& structure,
                             simd::InstructionSet instructions = simd::bestInstructionSet());
    IterativeSolver(const IterativeSolver&) = delete;
    IterativeSolver& operator=(const IterativeSolver&) = delete;

    /// Makes the incomplete factors of a matrix of the same structure.
    /// \return false where a block on its diagonal is singular
    bool factorise(const BlockMatrix& matrix);

    /// x = A^-1 x, to a residual of a given share of the right side, both over each row's weight.
    /// \pre  the matrix is the one last factorised
    /// \return false, and x as it was, when that takes more than most_iterations
    bool solve(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x,
               double accuracy = kAccuracy, std::size_t most_iterations = kMostIterations);

    /// Accuracy that Newton's method needs, as its next iteration corrects the remainder. 1e-3 takes half as
    /// many iterations again and saves none of Newton's.
    static constexpr double kAccuracy = 1e-2;
    /// Most systems take 5 to 30; many more mean an ill-conditioned one.
    static constexpr std::size_t kMostIterations = 100;

 private:
    /// x = (L U)^-1 W x, in the rows' weights W
    void precondition(const std::vector<double>& weight, Vec6s& x) const;
    /// y = W^-1 A (L U)^-1 W x
    void apply(const BlockMatrix& matrix, const std::vector<double>& weight, const Vec6s& x, Vec6s& y);
    void orthogonalise(std::size_t k);
    void combine(std::size_t count, Vec6s& x) const;

    std::size_t rows_ = 0;
    IncompleteLu factors_;
    IterationKernels kernels_;
    std::vector<Vec6s> basis_{};  ///< orthonormal
    Vec6s work_{};
    std::vector<std::vector<double>>
        columns_{};  ///< of the Hessenberg matrix, made upper triangular by rotations
    std::vector<double> cosine_{}, sine_{},
        residual_{};  ///< of these; the last residual is that of the solution
};

}  // namespace talus::equilibrium
