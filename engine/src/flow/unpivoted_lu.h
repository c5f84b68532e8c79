#pragma once
// Sparse factors A = L D U with pivots on the diagonal, of a matrix with a symmetric structure.
//
// L and U have one structure, which follows from that of A alone: it is found once for all matrices of a
// network. Rows of L and columns of U are computed one after the other, each by a sparse triangular solution,
// as T. A. Davis's LDL does for symmetric matrices (ACM Transactions on Mathematical Software 31, 587, 2005).
//
// Factors without pivoting keep that structure but do not bound rounding: LinearSystem checks the solution.

#include <array>
#include <cstdint>
#include <vector>

#include "flow/sparse.h"

namespace talus::flow {

class UnpivotedLu {
 public:
    /// Finds the order of elimination (approximate minimum degree) and the structure of the factors.
    /// \pre the structure is symmetric and has the whole diagonal, compressed and sorted
    explicit UnpivotedLu(const SparseMatrix& structure);

    /// False where a pivot is zero, too small or not finite. \pre a matrix of the same structure
    bool factorise(const SparseMatrix& matrix);
    /// A^-1 b
    Vector solve(const Vector& right) const;
    /// Entries of L and U, the diagonal counted once.
    std::size_t entries() const { return diagonal_.size() + 2 * row_.size(); }

 private:
    using Index = std::int32_t;

    /// A pair of entries that mirror each other, in the order of elimination: (row, k) and (k, row), row < k.
    struct Mirrored {
        Index row = 0;
        Index upper = 0, lower = 0;  ///< where the matrix has their values
    };
    /// U(i, k) and L(k, i), in the order in which they multiply a Left.
    struct Factor {
        double upper = 0, lower = 0;
    };
    /// What is left to eliminate of (k, i) and (i, k).
    struct Left {
        double lower = 0, upper = 0;
    };
    static constexpr std::size_t kMostAtOnce = 4;  // columns; the values of more do not stay in registers

    void order(const SparseMatrix& structure);
    void mirror(const SparseMatrix& structure);
    void findParents();
    void countEntries();
    /// Columns that row k of L reaches, in the order of elimination from the place returned in path_.
    std::size_t reachOf(std::size_t k);
    double eliminate(std::size_t k, std::size_t first, double pivot);
    std::size_t nested(std::size_t first) const;
    template <std::size_t N>
    double eliminateColumns(std::size_t k, std::size_t first, double pivot);
    template <std::size_t N>
    std::array<Left, N> takeOut(const std::array<std::size_t, N>& columns);

    std::vector<Index> place_;          ///< of each unknown in the order of elimination
    std::vector<Mirrored> mirrored_;    ///< of each k, those above it
    std::vector<std::size_t> mirrors_;  ///< where those of k begin; one more at the end
    std::vector<Index> on_diagonal_;    ///< of each k: where the matrix has its diagonal
    std::vector<Index> parent_;         ///< elimination tree; -1: a root
    std::vector<std::size_t> begin_;    ///< of each column of L in row_; one more at the end
    std::vector<Index> row_;            ///< ascending
    std::vector<Factor> factor_;        ///< beside row_
    std::vector<double> diagonal_;      ///< D
    std::vector<std::size_t> filled_;   ///< of each column: the end of the rows computed so far
    std::vector<Index> seen_;           ///< of each column: the last k that reached it
    std::vector<Index> path_, branch_;  ///< see reachOf
    std::vector<Left> work_;            ///< zero between rows
};

}  // namespace talus::flow
