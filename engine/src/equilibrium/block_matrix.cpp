#include "equilibrium/block_matrix.h"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace talus::equilibrium {

BlockMatrix::BlockMatrix(std::size_t rows, std::vector<std::pair<std::int32_t, std::int32_t>> pairs)
    : edges(std::move(pairs)) {
    for (auto& [i, j] : edges)
        if (i > j) std::swap(i, j);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    diagonal.resize(rows);
    upper.resize(edges.size());
    lower.resize(edges.size());
    setZero();
}

void BlockMatrix::setZero() {
    for (Mat6s* blocks : {&diagonal, &upper, &lower})
        for (Mat6& block : *blocks) block.setZero();
}

void BlockMatrix::multiply(const Vec6s& x, Vec6s& y) const {
    y.resize(rows());
    for (std::size_t i = 0; i < rows(); ++i) y[i].noalias() = diagonal[i] * x[i];
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto i = static_cast<std::size_t>(edges[e].first),
                   j = static_cast<std::size_t>(edges[e].second);
        y[i].noalias() += upper[e] * x[j];
        y[j].noalias() += lower[e] * x[i];
    }
}

BlockLu::BlockLu(const BlockMatrix& structure) {
    order(structure);
    findStructure();
    const std::size_t n = structure.rows();
    diagonal_inverse_.resize(n);
    lower_.resize(row_.size());
    upper_.resize(row_.size());
    work_lower_.resize(n);
    work_upper_.resize(n);
}

void BlockLu::order(const BlockMatrix& structure) {
    const auto n = static_cast<int>(structure.rows());
    std::vector<Eigen::Triplet<double>> ones;
    for (int i = 0; i < n; ++i) ones.emplace_back(i, i, 1.0);
    for (const auto& [i, j] : structure.edges) {
        ones.emplace_back(i, j, 1.0);
        ones.emplace_back(j, i, 1.0);
    }
    Eigen::SparseMatrix<double> graph(n, n);
    graph.setFromTriplets(ones.begin(), ones.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(n);
    if (n > 0) Eigen::AMDOrdering<int>()(graph, permutation);
    place_.resize(structure.rows());
    for (int k = 0; k < n; ++k) place_[static_cast<std::size_t>(permutation.indices()[k])] = k;
    entries_.resize(structure.rows());
    for (std::size_t e = 0; e < structure.edges.size(); ++e) {
        const std::int32_t i = place_[static_cast<std::size_t>(structure.edges[e].first)];
        const std::int32_t j = place_[static_cast<std::size_t>(structure.edges[e].second)];
        entries_[static_cast<std::size_t>(std::min(i, j))].push_back(
            {std::max(i, j), static_cast<std::int32_t>(e), i > j});
    }
}

/// A column's structure is its own entries and what its children in the tree of elimination bring (George and Liu 1981).
void BlockLu::findStructure() {
    const std::size_t n = place_.size();
    std::vector<std::vector<std::int32_t>> columns(n);
    std::vector<std::vector<std::size_t>> children(n);
    begin_.assign(1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<std::int32_t>& rows = columns[i];
        for (const Entry& entry : entries_[i]) rows.push_back(entry.j);
        for (const std::size_t child : children[i])
            rows.insert(rows.end(), columns[child].begin() + 1, columns[child].end());
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        if (!rows.empty()) children[static_cast<std::size_t>(rows.front())].push_back(i);
        row_.insert(row_.end(), rows.begin(), rows.end());
        begin_.push_back(row_.size());
    }
    above_begin_.assign(n + 1, 0);
    for (const std::int32_t row : row_) ++above_begin_[static_cast<std::size_t>(row) + 1];
    for (std::size_t i = 0; i < n; ++i) above_begin_[i + 1] += above_begin_[i];
    above_.resize(row_.size());
    std::vector<std::size_t> next(above_begin_.begin(), above_begin_.end() - 1);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t p = begin_[k]; p < begin_[k + 1]; ++p)
            above_[next[static_cast<std::size_t>(row_[p])]++] = {static_cast<std::int32_t>(k), p};
}

/// Takes from row and column i what the columns before it bring.
void BlockLu::eliminate(std::size_t i) {
    Mat6& diagonal = diagonal_inverse_[i];
    for (std::size_t a = above_begin_[i]; a < above_begin_[i + 1]; ++a) {
        const std::size_t at = above_[a].position,
                          end = begin_[static_cast<std::size_t>(above_[a].column) + 1];
        const Mat6 &left = lower_[at], &right = upper_[at];
        diagonal.noalias() -= left * right;
        for (std::size_t p = at + 1; p < end; ++p) {
            const auto j = static_cast<std::size_t>(row_[p]);
            work_lower_[j].noalias() -= lower_[p] * right;
            work_upper_[j].noalias() -= left * upper_[p];
        }
    }
}

bool BlockLu::factorise(const BlockMatrix& matrix) {
    for (std::size_t row = 0; row < place_.size(); ++row)
        diagonal_inverse_[static_cast<std::size_t>(place_[row])] = matrix.diagonal[row];
    for (std::size_t i = 0; i < place_.size(); ++i) {
        for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p) {
            work_lower_[static_cast<std::size_t>(row_[p])].setZero();
            work_upper_[static_cast<std::size_t>(row_[p])].setZero();
        }
        for (const Entry& entry : entries_[i]) {
            const auto j = static_cast<std::size_t>(entry.j), e = static_cast<std::size_t>(entry.edge);
            work_lower_[j] = entry.swapped ? matrix.upper[e] : matrix.lower[e];
            work_upper_[j] = entry.swapped ? matrix.lower[e] : matrix.upper[e];
        }
        eliminate(i);
        const Eigen::PartialPivLU<Mat6> pivots(diagonal_inverse_[i]);
        const double determinant = pivots.determinant();
        if (determinant == 0 || !std::isfinite(determinant)) return false;
        diagonal_inverse_[i] = pivots.inverse();
        for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p) {
            lower_[p].noalias() = work_lower_[static_cast<std::size_t>(row_[p])] * diagonal_inverse_[i];
            upper_[p] = work_upper_[static_cast<std::size_t>(row_[p])];
        }
    }
    return true;
}

void BlockLu::solve(Vec6s& x) const {
    const std::size_t n = place_.size();
    Vec6s y(n);
    for (std::size_t row = 0; row < n; ++row) y[static_cast<std::size_t>(place_[row])] = x[row];
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p)
            y[static_cast<std::size_t>(row_[p])].noalias() -= lower_[p] * y[i];
    for (std::size_t i = n; i-- > 0;) {
        Vec6 sum = y[i];
        for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p)
            sum.noalias() -= upper_[p] * y[static_cast<std::size_t>(row_[p])];
        y[i].noalias() = diagonal_inverse_[i] * sum;
    }
    for (std::size_t row = 0; row < n; ++row) x[row] = y[static_cast<std::size_t>(place_[row])];
}

}  // namespace talus::equilibrium
