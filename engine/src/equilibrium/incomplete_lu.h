#pragma once
// Incomplete factors of a matrix of 6 x 6 blocks: small blocks are left out.

#include <cstdint>
#include <vector>

#include "equilibrium/block_matrix.h"
#include "equilibrium/iteration_view.h"
#include "simd/instruction_set.h"

namespace talus::equilibrium {

/// LU factors row by row in the matrix's own order, without the blocks that are small beside the diagonal of
/// their row, ILUT (Saad 1994) of 6 x 6 blocks. The choice is by value: a slipping or lightly pressed joint
/// has few, and a stiff one keeps its fill at any distance. (bench/studies/linear-systems.md compares it with
/// factors of a fixed structure.)
class IncompleteLu {
 public:
    /// \param instructions  of the products; the same bits with each
    /// \param drop  blocks of a norm below that share of their row's diagonal are left out, moments over the
    ///              reach of the blocks; 0: none, and the factors are complete
    IncompleteLu(const BlockMatrix& structure, simd::InstructionSet instructions, double drop);

    /// \pre  a matrix of that structure
    /// \return false, and no factors, where a block on the diagonal is singular
    bool factorise(const BlockMatrix& matrix);
    /// x = (L U)^-1 x
    void solve(Vec6s& x) const;
    /// Where the matrix has blocks above its diagonal.
    UpperRows upperRows() const { return {rows_, matrix_upper_begin_.data(), matrix_upper_column_.data()}; }
    /// Blocks in the factors.
    std::size_t entries() const { return diagonal_inverse_.size() + upper_.size() + lower_.size(); }

 private:
    void readScales(const BlockMatrix& matrix);
    std::size_t slotOf(std::size_t column);
    void takeRow(const BlockMatrix& matrix, std::size_t row);
    void eliminateRow(std::size_t row);
    bool keepRow(std::size_t row);
    bool isSmall(std::size_t row, std::size_t column, const Mat6& block) const;

    std::size_t rows_ = 0;
    double drop_ = 0;
    IterationKernels kernels_;
    // Of the matrix, row by row: where its blocks are.
    std::vector<std::size_t> matrix_upper_begin_{}, matrix_lower_begin_{};
    std::vector<std::int32_t> matrix_upper_column_{}, matrix_lower_column_{};
    std::vector<std::size_t> matrix_lower_edge_{};
    // The factors, row by row.
    std::vector<std::size_t> upper_begin_{}, lower_begin_{};
    std::vector<std::int32_t> upper_column_{}, lower_column_{};
    Mat6s diagonal_inverse_{}, upper_{}, lower_{};
    // Scales for the comparison, per row: its stiffness [N/m], and one over the reach of its moments [1/m].
    std::vector<double> stiffness_{}, inverse_reach_{};
    // The row that is being eliminated: its blocks in slots, the diagonal in the first.
    Mat6s row_{};
    std::vector<std::int32_t> column_{}, place_{};  ///< of each slot; of each column its slot or -1
    std::vector<std::int32_t> pending_{};  ///< columns left of the diagonal, the next one first (a heap)
    std::vector<std::int32_t> targets_{};
};

}  // namespace talus::equilibrium
