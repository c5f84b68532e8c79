#pragma once
// Kernels of iterations of a linear system: products with its matrix and with incomplete factors of it; one
// source, a build per instruction set.

#include <cstddef>
#include <cstdint>

namespace talus::equilibrium {

/// Where a matrix has blocks above its diagonal, row by row.
struct UpperRows {
    std::size_t rows;
    const std::size_t* begin;  ///< of each row, one more at the end
    const std::int32_t* column;
};

/// Incomplete factors. Rows and columns are free blocks. Blocks are 6 x 6, 36 numbers column by column, one
/// after the other: those above the diagonal row by row, those below it row by row, and the inverse of those
/// on it.
struct FactorsView {
    std::size_t rows;
    const std::size_t *upper_begin, *lower_begin;  ///< of each row, one more at the end
    const std::int32_t *upper_column, *lower_column;
    const double *diagonal_inverse, *upper, *lower;
};

/// Each takes the same operations in the same order in each build: the same bits.
struct IterationKernels {
    /// Turns a block left of the diagonal into a factor (block times the inverse of the diagonal above it),
    /// and subtracts its products with the blocks above from slots of the row.
    void (*eliminate)(double* block, const double* inverse, const double* upper, const std::int32_t* slot,
                      std::size_t count, double* row);
    /// x = (L U)^-1 x
    void (*substitute)(const FactorsView&, double* x);
    /// y = A x, of a matrix whose blocks below the diagonal are in the order of those above it
    void (*multiply)(const UpperRows&, const double* diagonal, const double* upper, const double* lower,
                     const double* x, double* y);
};
extern const IterationKernels kIterateScalar, kIterateAvx2, kIterateAvx512;

}  // namespace talus::equilibrium
