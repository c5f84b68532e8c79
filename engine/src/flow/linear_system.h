#pragma once
// The linear systems of Newton's method in a network: unsymmetric, of one structure.
//
// Factors without pivoting first, because their structure is found once and little fills in. Their solution
// is refined until its residual is rounding. Where that fails, a factorisation with pivoting solves it.

#include <Eigen/SparseLU>
#include <optional>

#include "flow/sparse.h"
#include "flow/unpivoted_lu.h"

namespace talus::flow {

class LinearSystem {
 public:
    /// A^-1 b; nothing where the matrix is singular.
    /// \pre matrices of one structure, as UnpivotedLu needs it
    std::optional<Vector> solve(const SparseMatrix& matrix, const Vector& right);
    /// How many systems were solved with pivoting.
    int pivoted() const { return pivoted_; }

 private:
    std::optional<Vector> refined(const SparseMatrix& matrix, const Vector& right);
    std::optional<Vector> withPivots(const SparseMatrix& matrix, const Vector& right);

    std::optional<UnpivotedLu> factors_;
    int pivoted_ = 0;
};

}  // namespace talus::flow
