#include "equilibrium/iterative_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::equilibrium {
namespace {

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
      edges_(structure.edges.size()),
      blocks_(rows_ + 2 * edges_),
      kernels_(simd::buildFor(instructions, kIterateScalar, kIterateAvx2, kIterateAvx512)) {
    const auto row = [](std::int32_t i) { return static_cast<std::size_t>(i); };
    upper_begin_.assign(rows_ + 1, 0);
    lower_begin_.assign(rows_ + 1, 0);
    for (const auto& [i, j] : structure.edges) {
        ++upper_begin_[row(i) + 1];
        ++lower_begin_[row(j) + 1];
        upper_column_.push_back(j);
    }
    for (std::size_t i = 0; i < rows_; ++i) {
        upper_begin_[i + 1] += upper_begin_[i];
        lower_begin_[i + 1] += lower_begin_[i];
    }
    std::vector<std::size_t> next(lower_begin_.begin(), lower_begin_.end() - 1);
    lower_column_.resize(edges_);
    lower_edge_.resize(edges_);
    for (std::size_t e = 0; e < edges_; ++e) {
        const std::size_t at = next[row(structure.edges[e].second)]++;
        lower_column_[at] = structure.edges[e].first;
        lower_edge_[at] = e;
    }
    listUpdates();
    double* blocks = blocks_.empty() ? nullptr : blocks_.front().data();
    constexpr auto kBlock = static_cast<std::size_t>(Mat6::SizeAtCompileTime);
    view_ = {.rows = rows_,
             .upper_begin = upper_begin_.data(),
             .lower_begin = lower_begin_.data(),
             .upper_column = upper_column_.data(),
             .lower_column = lower_column_.data(),
             .update_begin = update_begin_.data(),
             .updates = updates_.data(),
             .diagonal = blocks,
             .upper = blocks + kBlock * rows_,
             .lower = blocks + kBlock * (rows_ + edges_)};
}

/// Of each block (i, k) below the diagonal those (i, j) that its product with (k, j) changes and that the matrix has.
void IterativeSolver::listUpdates() {
    std::vector<std::int32_t> place(rows_, -1);  // of row i, among all blocks
    const auto each_of = [&](std::size_t i, const auto& visit) {
        visit(i, i);
        for (std::size_t p = upper_begin_[i]; p < upper_begin_[i + 1]; ++p)
            visit(static_cast<std::size_t>(upper_column_[p]), rows_ + p);
        for (std::size_t p = lower_begin_[i]; p < lower_begin_[i + 1]; ++p)
            visit(static_cast<std::size_t>(lower_column_[p]), rows_ + edges_ + p);
    };
    for (std::size_t i = 0; i < rows_; ++i) {
        each_of(i, [&](std::size_t j, std::size_t at) { place[j] = static_cast<std::int32_t>(at); });
        for (std::size_t p = lower_begin_[i]; p < lower_begin_[i + 1]; ++p) {
            update_begin_.push_back(updates_.size());
            const auto k = static_cast<std::size_t>(lower_column_[p]);
            for (std::size_t q = upper_begin_[k]; q < upper_begin_[k + 1]; ++q) {
                if (const std::int32_t target = place[static_cast<std::size_t>(upper_column_[q])];
                    target >= 0)
                    updates_.push_back({static_cast<std::int32_t>(q), target});
            }
        }
        each_of(i, [&](std::size_t j, std::size_t) { place[j] = -1; });
    }
    update_begin_.push_back(updates_.size());
}

bool IterativeSolver::factorise(const BlockMatrix& matrix) {
    const auto at = [&](std::size_t k) { return blocks_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::copy(matrix.diagonal.begin(), matrix.diagonal.end(), at(0));
    std::copy(matrix.upper.begin(), matrix.upper.end(), at(rows_));
    for (std::size_t p = 0; p < edges_; ++p) blocks_[rows_ + edges_ + p] = matrix.lower[lower_edge_[p]];
    for (std::size_t i = 0; i < rows_; ++i) {
        kernels_.eliminate_row(view_, i);
        const Eigen::PartialPivLU<Mat6> pivots(blocks_[i]);
        const double determinant = pivots.determinant();
        if (determinant == 0 || !std::isfinite(determinant)) return false;
        blocks_[i] = pivots.inverse();
    }
    return true;
}

void IterativeSolver::precondition(const std::vector<double>& weight, Vec6s& x) const {
    for (std::size_t r = 0; r < rows_; ++r) x[r] *= weight[r];
    kernels_.substitute(view_, x.front().data());
}

void IterativeSolver::apply(const BlockMatrix& matrix, const std::vector<double>& weight, const Vec6s& x,
                            Vec6s& y) {
    work_ = x;
    precondition(weight, work_);
    y.resize(rows_);
    kernels_.multiply(view_, numbersOf(matrix.diagonal), numbersOf(matrix.upper), numbersOf(matrix.lower),
                      work_.front().data(), y.front().data());
    for (std::size_t r = 0; r < rows_; ++r) y[r] /= weight[r];
}

/// Takes from the vector after k what those before it have of it, and turns that column of the Hessenberg matrix upright.
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

bool IterativeSolver::solve(const BlockMatrix& matrix, const std::vector<double>& weight, Vec6s& x,
                            std::size_t most_iterations) {
    if (rows_ == 0) return true;
    if (!factorise(matrix)) return false;
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
        if (std::abs(residual_[k + 1]) > kAccuracy * length) continue;
        combine(k + 1, x);
        precondition(weight, x);
        return true;
    }
    return false;
}

}  // namespace talus::equilibrium
