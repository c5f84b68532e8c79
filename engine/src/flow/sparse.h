#pragma once
// The sparse matrices and vectors of a network's equations.

#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>

namespace talus::flow {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Where a matrix has the value of an entry; -1: nowhere. \pre compressed and sorted
inline std::int32_t entryOf(const SparseMatrix& matrix, std::int32_t row, std::int32_t column) {
    const std::int32_t* rows = matrix.innerIndexPtr();
    const std::int32_t* end = rows + matrix.outerIndexPtr()[column + 1];
    const std::int32_t* found = std::lower_bound(rows + matrix.outerIndexPtr()[column], end, row);
    return found != end && *found == row ? static_cast<std::int32_t>(found - rows) : -1;
}

}  // namespace talus::flow
