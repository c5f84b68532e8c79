#pragma once
// A sparse matrix of 6 x 6 blocks, one row for each free block, and its factors.

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "equilibrium/elimination_view.h"
#include "simd/instruction_set.h"

namespace talus::equilibrium {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Blocks side by side, so that the matrices of a factor are one allocation.
using Mat6s = std::vector<Mat6>;
using Vec6s = std::vector<Vec6>;

/// Structurally symmetric: an entry for each pair of free blocks that share an interface, both ways round,
/// and the diagonal. Values are unsymmetric.
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

/// LU factors with pivoting within the 6 x 6 diagonal blocks only: the drag on the diagonal and the stiffness
/// of each block against its neighbours keep these blocks well conditioned. The order of elimination
/// (approximate minimum degree on the graph of blocks) and the structure are found once for each structure.
class BlockLu {
 public:
    /// \param instructions  of the products; the same bits with each
    /// \param stop  ends the work early, and every later one: then nothing is factorised
    /// \param most_products  of blocks in a factorisation; where it would take more nothing is factorised
    explicit BlockLu(const BlockMatrix& structure,
                     simd::InstructionSet instructions = simd::bestInstructionSet(),
                     const std::atomic<bool>* stop = nullptr,
                     double most_products = std::numeric_limits<double>::infinity());

    /// Whether a factorisation would exceed its limit of products.
    bool isTooLarge() const { return is_too_large_; }

    /// False when a diagonal block is singular, or when asked to stop.
    bool factorise(const BlockMatrix& matrix);
    /// x = A^-1 x
    void solve(Vec6s& x) const;
    /// Blocks in the factors, the diagonal counted once.
    std::size_t entries() const { return diagonal_inverse_.size() + 2 * row_.size(); }

 private:
    /// Columns side by side of one structure: each one's rows are those of the one before it, less itself.
    struct Panel {
        std::size_t begin = 0, end = 0;              ///< columns
        std::size_t reach_begin = 0, reach_end = 0;  ///< in reach_: the panels before it that reach it
    };
    /// An earlier panel, and its first row that is one of the later panel's columns, with how many are.
    struct Reach {
        std::size_t panel = 0, first = 0, count = 0;
    };
    /// Where a block of the matrix goes.
    struct Entry {
        std::size_t at = 0;    ///< in lower_ and upper_
        std::size_t edge = 0;  ///< of the matrix
        bool swapped = false;  ///< the order of elimination is not the matrix's own
    };

    void order(const BlockMatrix& structure);
    bool findStructure(const BlockMatrix& structure, double most_products);
    void findPanels();
    void findReach();
    void placeEntries(const BlockMatrix& structure);
    void takeMatrix(const BlockMatrix& matrix);
    void eliminateBefore(const Panel& panel);
    bool eliminateWithin(const Panel& panel);

    EliminationKernel kernel_;
    const std::atomic<bool>* stop_;
    bool has_structure_ = false;  ///< was not stopped before it had
    bool is_too_large_ = false;
    std::vector<std::int32_t> place_{};  ///< of each row in the order of elimination
    std::vector<std::size_t> begin_{};   ///< of each column's structure in row_; one more at the end
    std::vector<std::int32_t> row_{};    ///< rows below the diagonal, ascending
    std::vector<Panel> panels_{};
    std::vector<Reach> reach_{};
    std::vector<Entry> entries_{};
    Mat6s diagonal_inverse_{}, lower_{}, upper_{};
    // Arguments of the kernel.
    std::vector<std::int32_t> row_place_{}, places_{}, next_{};
    std::vector<EliminatedColumn> columns_{};
    std::vector<EliminationTarget> targets_{};
};

}  // namespace talus::equilibrium
