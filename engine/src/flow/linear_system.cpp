#include "flow/linear_system.h"

namespace talus::flow {
namespace {

// Componentwise backward error: the residual over |A| |x| + |b| in its row (Arioli, Demmel and Duff 1989, SIAM
// Journal on Matrix Analysis and Applications 10). Rounding alone leaves some 1e-15.
constexpr double kBackwardError = 1e-13;
constexpr int kRefinements = 4;  // one or two do where pivots are sound

bool isSmall(const Vector& residual, const SparseMatrix& matrix, const Vector& solution,
             const Vector& right) {
    const Vector scale = matrix.cwiseAbs() * solution.cwiseAbs() + right.cwiseAbs();
    return residual.allFinite() && (residual.array().abs() <= kBackwardError * scale.array()).all();
}

}  // namespace

std::optional<Vector> LinearSystem::solve(const SparseMatrix& matrix, const Vector& right) {
    if (!factors_) factors_.emplace(matrix);
    if (!factors_->factorise(matrix)) return std::nullopt;
    Vector solution = factors_->solve(right);
    for (int k = 0; k <= kRefinements; ++k) {
        const Vector residual = right - matrix * solution;
        if (isSmall(residual, matrix, solution, right)) return solution;
        solution += factors_->solve(residual);
    }
    return std::nullopt;
}

}  // namespace talus::flow
