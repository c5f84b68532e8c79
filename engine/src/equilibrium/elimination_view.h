#pragma once
// The products that take nearly all of a factorisation's time; one source, a build per instruction set.

#include <cstddef>
#include <cstdint>

namespace talus::equilibrium {

/// An eliminated column, from its first later row and column. Blocks are 6 x 6, 36 numbers column by column,
/// one after the other.
struct EliminatedColumn {
    const double *lower, *upper;  ///< the blocks below it, and those beside it
};

/// A later column and the row of the same number.
struct EliminationTarget {
    double* diagonal;
    double *lower, *upper;  ///< its blocks, as if there were one for each place
};

/// Contribution of a panel (adjacent columns of the same structure) to the columns of a later panel. The
/// first blocks after it are those that reach these columns.
struct EliminationView {
    const EliminatedColumn* columns;
    std::size_t column_count;
    const std::int32_t* place;  ///< of each block after the panel, in its target's
    std::size_t count;          ///< of those
    // read and written
    const EliminationTarget* targets;
    std::size_t target_count;
};

/// Each product is added up in the order of its columns and then taken away: the same bits from each build.
using EliminationKernel = void (*)(const EliminationView&);
extern const EliminationKernel kEliminateScalar, kEliminateAvx2, kEliminateAvx512;

}  // namespace talus::equilibrium
