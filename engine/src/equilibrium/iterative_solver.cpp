#include "equilibrium/iterative_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::equilibrium {
namespace {

// Systems of 1,406 free blocks take least time with 0.03 to 0.05, and up to twice as much with 0.1 and 0.01.
constexpr double kDrop = 0.03;

using Numbers = Eigen::Map<const Eigen::VectorXd>;

Numbers numbers(const Vec6s& x) {
    return {x.empty() ? nullptr : x.front().data(),
            static_cast<Eigen::Index>(x.size() * Vec6::SizeAtCompileTime)};
}
Eigen::Map<Eigen::VectorXd> numbers(Vec6s& x) {
    return {x.empty() ? nullptr : x.front().data(),
            static_cast<Eigen::Index>(x.size() * Vec6::SizeAtCompileTime)};
}
static_assert(sizeof(Vec6) == Vec6::SizeAtCompileTime * sizeof(double));

const double* numbersOf(const Mat6s& blocks) { return blocks.empty() ? nullptr : blocks.front().data(); }

}  // namespace

IterativeSolver::IterativeSolver(const BlockMatrix& structure, simd::InstructionSet instructions)
    : rows_(structure.rows()),
      factors_(structure, instructions, kDrop),
      kernels_(simd::buildFor(instructions, kIterateScalar, kIterateAvx2, kIterateAvx512)) {}

void IterativeSolver::precondition(const std::vector<double>& weight, Vec6s& x) const {
    for (std::size_t r = 0; r < rows_; ++r) x[r] *= weight[r];
    factors_.solve(x);
}

void IterativeSolver::apply(const BlockMatrix& matrix, const std::vector<double>& weight, const Vec6s& x,
                            Vec6s& y) {
    work_ = x;
    precondition(weight, work_);
    y.resize(rows_);
    kernels_.multiply(factors_.upperRows(), numbersOf(matrix.diagonal), numbersOf(matrix.upper),
                      numbersOf(matrix.lower), work_.front().data(), y.front().data());
    for (std::size_t r = 0; r < rows_; ++r) y[r] /= weight[r];
}

/// Orthogonalises the vector after k against those before it, and rotates that column of the Hessenberg
/// matrix to upper triangular form.
void IterativeSolver::orthogonalise(std::size_t k) {
    auto next = numbers(basis_[k + 1]);
    std::vector<double>& column = columns_[k];
    column.resize(k + 2);
    for (std::size_t i = 0; i <= k; ++i) {
        column[i] = next.dot(numbers(std::as_const(basis_[i])));
        next -= column[i] * numbers(std::as_const(basis_[i]));
    }
    const double length = column[k + 1] = next.norm();
    if (length > 0) next /= length;
    for (std::size_t i = 0; i < k; ++i) {
        const double turned = cosine_[i] * column[i] + sine_[i] * column[i + 1];
        column[i + 1] = cosine_[i] * column[i + 1] - sine_[i] * column[i];
        column[i] = turned;
    }
    const double radius = std::hypot(column[k], column[k + 1]);
    cosine_[k] = radius > 0 ? column[k] / radius : 1.0;
    sine_[k] = radius > 0 ? column[k + 1] / radius : 0.0;
    column[k] = radius;
    residual_[k + 1] = -sine_[k] * residual_[k];
    residual_[k] *= cosine_[k];
}

/// The combination of the basis that has the least residual.
void IterativeSolver::combine(std::size_t count, Vec6s& x) const {
    std::vector<double> share(residual_.begin(), residual_.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = count; i-- > 0;) {
        for (std::size_t k = i + 1; k < count; ++k) share[i] -= columns_[k][i] * share[k];
        share[i] /= columns_[i][i];
    }
    x.assign(rows_, Vec6::Zero());
    for (std::size_t k = 0; k < count; ++k) numbers(x) += share[k] * numbers(basis_[k]);
}

bool IterativeSolver::factorise(const BlockMatrix& matrix) {
    return rows_ == 0 || factors_.factorise(matrix);
}

bool IterativeSolver::solve(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x,
                            double accuracy, std::size_t most_iterations) {
    if (rows_ == 0) return true;
    basis_.resize(most_iterations + 1);
    columns_.resize(most_iterations);
    cosine_.resize(most_iterations);
    sine_.resize(most_iterations);
    residual_.assign(most_iterations + 1, 0.0);
    Vec6s& first = basis_[0];
    first = x;
    for (std::size_t r = 0; r < rows_; ++r) first[r] /= weight[r];
    const double length = numbers(first).norm();
    if (length == 0) return true;
    if (!std::isfinite(length)) return false;
    numbers(first) /= length;
    residual_[0] = length;
    for (std::size_t k = 0; k < most_iterations; ++k) {
        apply(matrix, weight, basis_[k], basis_[k + 1]);
        orthogonalise(k);
        if (!std::isfinite(residual_[k + 1]) || columns_[k][k] == 0) return false;
        if (std::abs(residual_[k + 1]) > accuracy * length) continue;
        combine(k + 1, x);
        precondition(weight, x);
        return true;
    }
    return false;
}

}  // namespace talus::equilibrium
