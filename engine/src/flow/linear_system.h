#pragma once
// The linear systems of a network's steps: unsymmetric, of one structure.
//
// Factors without pivoting, because their structure is found once and little fills in. Their solution is
// refined until its residual is rounding. Where that fails, the step is to become shorter: storage on the
// diagonal makes pivots sound. No system of the networks in bench/studies/free-surface.md needs that.

#include <optional>

#include "flow/sparse.h"
#include "flow/unpivoted_lu.h"

namespace talus::flow {

class LinearSystem {
 public:
    /// A^-1 b; nothing where the matrix is singular, or pivots too small for the residual to become small.
    /// \pre matrices of one structure, as UnpivotedLu needs it
    std::optional<Vector> solve(const SparseMatrix& matrix, const Vector& right);

 private:
    std::optional<UnpivotedLu> factors_;
};

}  // namespace talus::flow
