#include "equilibrium/block_matrix.h"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "state/caller.h"

namespace talus::equilibrium {
namespace {

/// Of blocks side by side; nothing lies between them.
double* numbers(Mat6s& blocks) { return blocks.empty() ? nullptr : blocks.front().data(); }
static_assert(sizeof(Mat6) == Mat6::SizeAtCompileTime * sizeof(double));

}  // namespace

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

BlockLu::BlockLu(const BlockMatrix& structure, simd::InstructionSet instructions,
                 const std::atomic<bool>* stop, double most_products)
    : kernel_(simd::buildFor(instructions, kEliminateScalar, kEliminateAvx2, kEliminateAvx512)), stop_(stop) {
    order(structure);
    has_structure_ = findStructure(structure, most_products);
    if (!has_structure_) return;
    findPanels();
    findReach();
    placeEntries(structure);
    const std::size_t n = structure.rows();
    diagonal_inverse_.resize(n);
    lower_.resize(row_.size());
    upper_.resize(row_.size());
    row_place_.resize(n);
    next_.resize(n + 1);
    std::iota(next_.begin(), next_.end(), -1);
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
}

/// A column's structure is its own entries and those of its children in the elimination tree (George and Liu
/// 1981).
/// \return false when asked to stop, or too large
bool BlockLu::findStructure(const BlockMatrix& structure, double most_products) {
    const std::size_t n = place_.size();
    std::vector<std::vector<std::int32_t>> columns(n);
    std::vector<std::vector<std::size_t>> children(n);
    for (const auto& [i, j] : structure.edges) {
        const auto [first, second] =
            std::minmax(place_[static_cast<std::size_t>(i)], place_[static_cast<std::size_t>(j)]);
        columns[static_cast<std::size_t>(first)].push_back(second);
    }
    begin_.assign(1, 0);
    double products = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (isStopped(stop_)) return false;
        std::vector<std::int32_t>& rows = columns[i];
        for (const std::size_t child : children[i])
            rows.insert(rows.end(), columns[child].begin() + 1, columns[child].end());
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        const auto count = static_cast<double>(rows.size());
        products += count * (count + 1);
        is_too_large_ = products > most_products;
        if (is_too_large_) return false;
        if (!rows.empty()) children[static_cast<std::size_t>(rows.front())].push_back(i);
        row_.insert(row_.end(), rows.begin(), rows.end());
        begin_.push_back(row_.size());
    }
    return true;
}

/// No wider than what stays in the first cache while products are taken.
void BlockLu::findPanels() {
    constexpr std::size_t kWidest = 8;
    for (std::size_t i = 0; i < place_.size(); ++i) {
        const bool follows = i > 0 && begin_[i] > begin_[i - 1] &&
                             static_cast<std::size_t>(row_[begin_[i - 1]]) == i &&
                             begin_[i] - begin_[i - 1] == begin_[i + 1] - begin_[i] + 1;
        if (!follows || i - panels_.back().begin == kWidest) panels_.push_back({.begin = i});
        panels_.back().end = i + 1;
    }
}

void BlockLu::findReach() {
    std::vector<std::size_t> panel_of(place_.size());
    for (std::size_t k = 0; k < panels_.size(); ++k)
        for (std::size_t i = panels_[k].begin; i < panels_[k].end; ++i) panel_of[i] = k;
    std::vector<std::vector<Reach>> reach(panels_.size());
    for (std::size_t k = 0; k < panels_.size(); ++k) {
        const std::size_t begin = begin_[panels_[k].end - 1], end = begin_[panels_[k].end];
        for (std::size_t p = begin; p < end;) {
            const std::size_t first = p, later = panel_of[static_cast<std::size_t>(row_[p])];
            while (p < end && panel_of[static_cast<std::size_t>(row_[p])] == later) ++p;
            reach[later].push_back({k, first - begin, p - first});
        }
    }
    for (std::size_t k = 0; k < panels_.size(); ++k) {
        panels_[k].reach_begin = reach_.size();
        reach_.insert(reach_.end(), reach[k].begin(), reach[k].end());
        panels_[k].reach_end = reach_.size();
    }
}

void BlockLu::placeEntries(const BlockMatrix& structure) {
    for (std::size_t e = 0; e < structure.edges.size(); ++e) {
        const std::int32_t i = place_[static_cast<std::size_t>(structure.edges[e].first)];
        const std::int32_t j = place_[static_cast<std::size_t>(structure.edges[e].second)];
        const auto column = static_cast<std::size_t>(std::min(i, j));
        const auto begin = row_.begin() + static_cast<std::ptrdiff_t>(begin_[column]),
                   end = row_.begin() + static_cast<std::ptrdiff_t>(begin_[column + 1]);
        const auto found = std::lower_bound(begin, end, std::max(i, j));
        entries_.push_back({static_cast<std::size_t>(found - row_.begin()), e, i > j});
    }
}

void BlockLu::takeMatrix(const BlockMatrix& matrix) {
    for (std::size_t row = 0; row < place_.size(); ++row)
        diagonal_inverse_[static_cast<std::size_t>(place_[row])] = matrix.diagonal[row];
    for (Mat6s* blocks : {&lower_, &upper_})
        for (Mat6& block : *blocks) block.setZero();
    for (const Entry& entry : entries_) {
        lower_[entry.at] = entry.swapped ? matrix.upper[entry.edge] : matrix.lower[entry.edge];
        upper_[entry.at] = entry.swapped ? matrix.lower[entry.edge] : matrix.upper[entry.edge];
    }
}

/// Subtracts the contributions of earlier panels from a panel's columns.
void BlockLu::eliminateBefore(const Panel& panel) {
    for (std::size_t i = panel.begin; i < panel.end; ++i)
        row_place_[i] = static_cast<std::int32_t>(i - panel.begin) - 1;
    auto place = static_cast<std::int32_t>(panel.end - panel.begin) - 1;
    for (std::size_t p = begin_[panel.end - 1]; p < begin_[panel.end]; ++p)
        row_place_[static_cast<std::size_t>(row_[p])] = place++;
    for (std::size_t r = panel.reach_begin; r < panel.reach_end; ++r) {
        const Reach& reach = reach_[r];
        const Panel& before = panels_[reach.panel];
        const std::size_t begin = begin_[before.end - 1] + reach.first, end = begin_[before.end];
        columns_.clear();
        for (std::size_t a = before.begin; a < before.end; ++a) {
            const std::size_t at = begin_[a] + (before.end - 1 - a) + reach.first;
            columns_.push_back({lower_[at].data(), upper_[at].data()});
        }
        places_.clear();
        for (std::size_t p = begin; p < end; ++p)
            places_.push_back(row_place_[static_cast<std::size_t>(row_[p])]);
        targets_.clear();
        for (std::size_t t = 0; t < reach.count; ++t) {
            const auto i = static_cast<std::size_t>(row_[begin + t]);
            // A column has a block less than the one before it, and the first none for its own row.
            const std::size_t first = (begin_[i] - (i - panel.begin)) * Mat6::SizeAtCompileTime;
            targets_.push_back(
                {diagonal_inverse_[i].data(), numbers(lower_) + first, numbers(upper_) + first});
        }
        kernel_({columns_.data(), columns_.size(), places_.data(), places_.size(), targets_.data(),
                 targets_.size()});
    }
}

/// Eliminates a panel's columns, each from those after it in the panel. \return whether none is singular
bool BlockLu::eliminateWithin(const Panel& panel) {
    for (std::size_t i = panel.begin; i < panel.end; ++i) {
        columns_.clear();
        for (std::size_t a = panel.begin; a < i; ++a) {
            const std::size_t at = begin_[a] + (i - a - 1);
            columns_.push_back({lower_[at].data(), upper_[at].data()});
        }
        const std::size_t first = begin_[i] * Mat6::SizeAtCompileTime;
        const EliminationTarget target{diagonal_inverse_[i].data(), numbers(lower_) + first,
                                       numbers(upper_) + first};
        const std::size_t count = begin_[i + 1] - begin_[i] + 1;
        if (!columns_.empty()) kernel_({columns_.data(), columns_.size(), next_.data(), count, &target, 1});
        const Eigen::PartialPivLU<Mat6> pivots(diagonal_inverse_[i]);
        const double determinant = pivots.determinant();
        if (determinant == 0 || !std::isfinite(determinant)) return false;
        diagonal_inverse_[i] = pivots.inverse();
        for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p)
            lower_[p] = (lower_[p] * diagonal_inverse_[i]).eval();
    }
    return true;
}

bool BlockLu::factorise(const BlockMatrix& matrix) {
    if (!has_structure_) return false;
    takeMatrix(matrix);
    for (const Panel& panel : panels_) {
        if (isStopped(stop_)) return false;
        eliminateBefore(panel);
        if (!eliminateWithin(panel)) return false;
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
