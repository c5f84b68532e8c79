#pragma once
// A sparse matrix of 6 x 6 blocks, one row for each free block, and its factors.

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "equilibrium/interface_response.h"

namespace talus::equilibrium {

/// Blocks side by side, so that the matrices of a factor are one allocation.
using Mat6s = std::vector<Mat6>;
using Vec6s = std::vector<Vec6>;

/// Structurally symmetric: an entry for each pair of free blocks that share an interface, both ways round, and the
/// diagonal. Values are unsymmetric.
struct BlockMatrix {
    std::vector<std::pair<std::int32_t, std::int32_t>> edges{};  ///< (i, j), i < j, sorted
    Mat6s diagonal{};
    Mat6s upper{}, lower{};  ///< of each edge: (i, j) and (j, i)

    BlockMatrix() = default;
    /// \param pairs of rows, in any order, repeated or not
    BlockMatrix(std::size_t rows, std::vector<std::pair<std::int32_t, std::int32_t>> pairs);

    std::size_t rows() const { return diagonal.size(); }
    void setZero();
    /// y = A x
    void multiply(const Vec6s& x, Vec6s& y) const;
};

/// LU factors with pivoting within the 6 x 6 diagonal blocks only: the drag on the diagonal and the stiffness of each
/// block against its neighbours keep these blocks well conditioned. The order of elimination (approximate minimum degree on
/// the graph of blocks) and the structure are found once for each structure.
class BlockLu {
 public:
    explicit BlockLu(const BlockMatrix& structure);

    /// False when a diagonal block is singular.
    bool factorise(const BlockMatrix& matrix);
    /// x = A^-1 x
    void solve(Vec6s& x) const;
    /// Blocks in the factors, the diagonal counted once.
    std::size_t entries() const { return diagonal_inverse_.size() + 2 * row_.size(); }

 private:
    void order(const BlockMatrix& structure);
    void findStructure();
    void eliminate(std::size_t i);

    std::vector<std::int32_t> place_{};  ///< of each row in the order of elimination
    /// Entries of the matrix in the order of elimination: of row i those with j > i, and which edge of the matrix.
    struct Entry {
        std::int32_t j = 0, edge = 0;
        bool swapped = false;  ///< j comes before i in the matrix's own order
    };
    std::vector<std::vector<Entry>> entries_{};
    std::vector<std::size_t> begin_{};  ///< of each column's structure in row_; one more at the end
    std::vector<std::int32_t> row_{};   ///< rows below the diagonal, ascending
    struct Above {
        std::int32_t column = 0;
        std::size_t position = 0;  ///< in row_
    };
    std::vector<std::size_t> above_begin_{};
    std::vector<Above> above_{};  ///< of each row: the columns before it that reach it
    Mat6s diagonal_inverse_{}, lower_{}, upper_{};
    Mat6s work_lower_{}, work_upper_{};
};

}  // namespace talus::equilibrium
