#pragma once
// What iterations of a linear system consist of: products with its matrix and with incomplete factors of it; one source, a build per
// instruction set.

#include <cstddef>
#include <cstdint>

namespace talus::equilibrium {

/// A block of the matrix's structure that a row's elimination changes: what lies below the diagonal times `upper` is taken off it.
struct IncompleteUpdate {
    std::int32_t upper;   ///< of the blocks above the diagonal
    std::int32_t target;  ///< of all blocks of the factors
};

/// Rows and columns are free blocks. Blocks are 6 x 6, 36 numbers column by column, one after the other: those on the diagonal, then
/// those above it row by row, then those below it row by row.
struct IterationView {
    std::size_t rows;
    const std::size_t *upper_begin, *lower_begin;  ///< of each row, one more at the end
    const std::int32_t *upper_column, *lower_column;
    const std::size_t* update_begin;  ///< of each block below the diagonal, one more at the end
    const IncompleteUpdate* updates;
    double *diagonal, *upper, *lower;  ///< the factors; of eliminated rows the inverse of the diagonal
};

/// Each takes the same operations in the same order in each build: the same bits.
struct IterationKernels {
    /// Takes from a row what those before it bring, within the structure. Its diagonal is then to be inverted.
    void (*eliminate_row)(const IterationView&, std::size_t row);
    /// x = (L U)^-1 x
    void (*substitute)(const IterationView&, double* x);
    /// y = A x, of a matrix of this structure whose blocks below the diagonal are in the order of those above it
    void (*multiply)(const IterationView&, const double* diagonal, const double* upper, const double* lower,
                     const double* x, double* y);
};
extern const IterationKernels kIterateScalar, kIterateAvx2, kIterateAvx512;

}  // namespace talus::equilibrium
