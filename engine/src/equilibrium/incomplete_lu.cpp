#include "equilibrium/incomplete_lu.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

namespace talus::equilibrium {
namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// The sums before each of the counts, and that of all at the end; counts begin at 1.
void accumulate(std::vector<std::size_t>& counts) {
    for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
}

const double* numbers(const Mat6s& blocks) { return blocks.empty() ? nullptr : blocks.front().data(); }

}  // namespace

IncompleteLu::IncompleteLu(const BlockMatrix& structure, simd::InstructionSet instructions, double drop)
    : rows_(structure.rows()),
      drop_(drop),
      kernels_(simd::buildFor(instructions, kIterateScalar, kIterateAvx2, kIterateAvx512)),
      matrix_upper_begin_(rows_ + 1, 0),
      matrix_lower_begin_(rows_ + 1, 0),
      diagonal_inverse_(rows_),
      stiffness_(rows_),
      inverse_reach_(rows_),
      place_(rows_, -1) {
    for (const auto& [i, j] : structure.edges) {
        ++matrix_upper_begin_[at(i) + 1];
        ++matrix_lower_begin_[at(j) + 1];
        matrix_upper_column_.push_back(j);
    }
    accumulate(matrix_upper_begin_);
    accumulate(matrix_lower_begin_);
    std::vector<std::size_t> next(matrix_lower_begin_.begin(), matrix_lower_begin_.end() - 1);
    matrix_lower_column_.resize(structure.edges.size());
    matrix_lower_edge_.resize(structure.edges.size());
    for (std::size_t e = 0; e < structure.edges.size(); ++e) {
        const std::size_t p = next[at(structure.edges[e].second)]++;
        matrix_lower_column_[p] = structure.edges[e].first;
        matrix_lower_edge_[p] = e;
    }
}

void IncompleteLu::readScales(const BlockMatrix& matrix) {
    for (std::size_t r = 0; r < rows_; ++r) {
        const auto of = matrix.diagonal[r].diagonal().cwiseAbs();
        const double forces = of.head<3>().sum() / 3, moments = of.tail<3>().sum() / 3;
        stiffness_[r] = forces;
        inverse_reach_[r] = moments > 0 ? std::sqrt(forces / moments) : 0.0;
    }
}

/// A block's size against the diagonal of its row; nan does not count as small.
bool IncompleteLu::isSmall(std::size_t row, std::size_t column, const Mat6& block) const {
    const double by_row = inverse_reach_[row] * inverse_reach_[row];
    const double by_column = inverse_reach_[column] * inverse_reach_[column];
    const double square = block.topLeftCorner<3, 3>().squaredNorm() +
                          by_column * block.topRightCorner<3, 3>().squaredNorm() +
                          by_row * (block.bottomLeftCorner<3, 3>().squaredNorm() +
                                    by_column * block.bottomRightCorner<3, 3>().squaredNorm());
    const double least = drop_ * stiffness_[row];
    return square < least * least;
}

/// Where the row has its block of a column, zero where it had none.
std::size_t IncompleteLu::slotOf(std::size_t column) {
    if (place_[column] < 0) {
        place_[column] = static_cast<std::int32_t>(row_.size());
        row_.emplace_back(Mat6::Zero());
        column_.push_back(static_cast<std::int32_t>(column));
        if (column < at(column_.front())) {
            pending_.push_back(static_cast<std::int32_t>(column));
            std::push_heap(pending_.begin(), pending_.end(), std::greater<>());
        }
    }
    return at(place_[column]);
}

void IncompleteLu::takeRow(const BlockMatrix& matrix, std::size_t row) {
    row_.clear();
    column_.clear();
    const auto take = [this](std::size_t column, const Mat6& block) {
        const std::size_t slot = slotOf(column);  // which may move the others
        row_[slot] = block;
    };
    take(row, matrix.diagonal[row]);
    for (std::size_t p = matrix_upper_begin_[row]; p < matrix_upper_begin_[row + 1]; ++p)
        take(at(matrix_upper_column_[p]), matrix.upper[p]);
    for (std::size_t p = matrix_lower_begin_[row]; p < matrix_lower_begin_[row + 1]; ++p)
        take(at(matrix_lower_column_[p]), matrix.lower[matrix_lower_edge_[p]]);
}

/// Subtracts the contributions of earlier rows.
void IncompleteLu::eliminateRow(std::size_t row) {
    while (!pending_.empty()) {
        const std::size_t k = at(pending_.front());
        std::pop_heap(pending_.begin(), pending_.end(), std::greater<>());
        pending_.pop_back();
        const std::size_t slot = at(place_[k]);
        if (isSmall(row, k, row_[slot])) continue;
        const std::size_t begin = upper_begin_[k], end = upper_begin_[k + 1];
        targets_.clear();
        for (std::size_t q = begin; q < end; ++q)
            targets_.push_back(static_cast<std::int32_t>(slotOf(at(upper_column_[q]))));
        const double* upper = numbers(upper_) + begin * Mat6::SizeAtCompileTime;
        kernels_.eliminate(row_[slot].data(), diagonal_inverse_[k].data(), upper, targets_.data(),
                           targets_.size(), row_.front().data());
        lower_column_.push_back(static_cast<std::int32_t>(k));
        lower_.push_back(row_[slot]);
    }
}

/// \return whether its diagonal is not singular
bool IncompleteLu::keepRow(std::size_t row) {
    const Eigen::PartialPivLU<Mat6> pivots(row_.front());
    const double determinant = pivots.determinant();
    diagonal_inverse_[row] = pivots.inverse();
    for (std::size_t s = 0; s < row_.size(); ++s) {
        const std::size_t column = at(column_[s]);
        place_[column] = -1;
        if (column <= row || isSmall(row, column, row_[s])) continue;
        upper_column_.push_back(column_[s]);
        upper_.push_back(row_[s]);
    }
    upper_begin_.push_back(upper_.size());
    lower_begin_.push_back(lower_.size());
    return determinant != 0 && std::isfinite(determinant);
}

bool IncompleteLu::factorise(const BlockMatrix& matrix) {
    readScales(matrix);
    for (std::vector<std::size_t>* begin : {&upper_begin_, &lower_begin_}) begin->assign(1, 0);
    for (std::vector<std::int32_t>* column : {&upper_column_, &lower_column_}) column->clear();
    for (Mat6s* blocks : {&upper_, &lower_}) blocks->clear();
    for (std::size_t row = 0; row < rows_; ++row) {
        takeRow(matrix, row);
        eliminateRow(row);
        if (!keepRow(row)) return false;
    }
    return true;
}

void IncompleteLu::solve(Vec6s& x) const {
    if (rows_ == 0) return;
    kernels_.substitute({.rows = rows_,
                         .upper_begin = upper_begin_.data(),
                         .lower_begin = lower_begin_.data(),
                         .upper_column = upper_column_.data(),
                         .lower_column = lower_column_.data(),
                         .diagonal_inverse = numbers(diagonal_inverse_),
                         .upper = numbers(upper_),
                         .lower = numbers(lower_)},
                        x.front().data());
}

}  // namespace talus::equilibrium
