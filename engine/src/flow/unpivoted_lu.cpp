#include "flow/unpivoted_lu.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>

namespace talus::flow {
namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace

UnpivotedLu::UnpivotedLu(const SparseMatrix& structure) {
    order(structure);
    mirror(structure);
    const std::size_t n = place_.size();
    seen_.assign(n, -1);
    path_.resize(n);
    branch_.resize(n);
    work_.resize(n);
    diagonal_.resize(n);
    findParents();
    countEntries();
}

void UnpivotedLu::order(const SparseMatrix& structure) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> permutation(structure.cols());
    if (structure.cols() > 0) Eigen::AMDOrdering<Index>()(structure, permutation);
    place_.resize(at(static_cast<Index>(structure.cols())));
    for (Index k = 0; k < structure.cols(); ++k) place_[at(permutation.indices()[k])] = k;
}

void UnpivotedLu::mirror(const SparseMatrix& structure) {
    const std::size_t n = place_.size();
    on_diagonal_.resize(n);
    std::vector<std::vector<Mirrored>> above(n);
    for (Index column = 0; column < structure.cols(); ++column)
        for (Index p = structure.outerIndexPtr()[column]; p < structure.outerIndexPtr()[column + 1]; ++p) {
            const Index row = structure.innerIndexPtr()[p];
            const Index i = place_[at(row)], k = place_[at(column)];
            if (i == k) on_diagonal_[at(k)] = p;
            if (i < k) above[at(k)].push_back({i, p, entryOf(structure, column, row)});
        }
    mirrors_.assign(1, 0);
    for (const std::vector<Mirrored>& of : above) {
        mirrored_.insert(mirrored_.end(), of.begin(), of.end());
        mirrors_.push_back(mirrored_.size());
    }
}

/// The parent of a column is the first row below its diagonal: the first k whose reach passes its root.
void UnpivotedLu::findParents() {
    const std::size_t n = place_.size();
    parent_.assign(n, -1);
    std::vector<Index> ancestor(n, -1);  // paths are shortened on the way
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t m = mirrors_[k]; m < mirrors_[k + 1]; ++m)
            for (Index i = mirrored_[m].row; i >= 0 && i < static_cast<Index>(k);) {
                const Index next = ancestor[at(i)];
                ancestor[at(i)] = static_cast<Index>(k);
                if (next < 0) parent_[at(i)] = static_cast<Index>(k);
                i = next;
            }
}

void UnpivotedLu::countEntries() {
    const std::size_t n = place_.size();
    std::vector<std::size_t> count(n, 0);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t p = reachOf(k); p < n; ++p) ++count[at(path_[p])];
    begin_.assign(1, 0);
    for (const std::size_t of : count) begin_.push_back(begin_.back() + of);
    row_.resize(begin_.back());
    factor_.resize(begin_.back());
}

/// Row k of L has an entry wherever the elimination tree leads from an entry of A up to k.
std::size_t UnpivotedLu::reachOf(std::size_t k) {
    const auto mark = static_cast<Index>(k);
    std::size_t first = path_.size();
    seen_[k] = mark;
    for (std::size_t m = mirrors_[k]; m < mirrors_[k + 1]; ++m) {
        std::size_t length = 0;
        for (Index i = mirrored_[m].row; seen_[at(i)] != mark; i = parent_[at(i)]) {
            branch_[length++] = i;
            seen_[at(i)] = mark;
        }
        while (length > 0) path_[--first] = branch_[--length];
    }
    return first;
}

bool UnpivotedLu::factorise(const SparseMatrix& matrix) {
    const double* values = matrix.valuePtr();
    filled_.assign(begin_.begin(), begin_.end() - 1);
    std::fill(seen_.begin(), seen_.end(), -1);
    for (std::size_t k = 0; k < place_.size(); ++k) {
        const std::size_t first = reachOf(k);
        for (std::size_t m = mirrors_[k]; m < mirrors_[k + 1]; ++m)
            work_[at(mirrored_[m].row)] = {values[mirrored_[m].lower], values[mirrored_[m].upper]};
        diagonal_[k] = eliminate(k, first, values[on_diagonal_[k]]);
        if (!std::isnormal(diagonal_[k])) return false;
    }
    return true;
}

/// Row k of L and column k of U. \return the pivot that is left
double UnpivotedLu::eliminate(std::size_t k, std::size_t first, double pivot) {
    while (first < path_.size()) {
        const std::size_t count = nested(first);
        switch (count) {
            case 4:
                pivot = eliminateColumns<4>(k, first, pivot);
                break;
            case 3:
                pivot = eliminateColumns<3>(k, first, pivot);
                break;
            case 2:
                pivot = eliminateColumns<2>(k, first, pivot);
                break;
            default:
                pivot = eliminateColumns<1>(k, first, pivot);
        }
        first += count;
    }
    return pivot;
}

/// How many columns of the path, from one on, have the rows of the one before it, less itself.
std::size_t UnpivotedLu::nested(std::size_t first) const {
    const auto rows = [&](std::size_t i) { return begin_[i + 1] - begin_[i]; };
    std::size_t count = 1;
    for (; count < kMostAtOnce && first + count < path_.size(); ++count) {
        const Index before = path_[first + count - 1], next = path_[first + count];
        if (parent_[at(before)] != next || rows(at(before)) != rows(at(next)) + 1) break;
    }
    return count;
}

/// N nested columns at once: each row is read and written once. Subtractions have the order that they have
/// with one column at a time, so the bits are the same.
template <std::size_t N>
double UnpivotedLu::eliminateColumns(std::size_t k, std::size_t first, double pivot) {
    std::array<std::size_t, N> columns{}, next{};
    for (std::size_t c = 0; c < N; ++c) {
        columns[c] = at(path_[first + c]);
        next[c] = begin_[columns[c]] + (N - 1 - c);  // behind the rows of the others
    }
    const std::array<Left, N> left = takeOut(columns);
    const std::size_t last = columns[N - 1];
    for (std::size_t q = begin_[last]; q < filled_[last]; ++q) {
        Left into = work_[at(row_[q])];
        for (std::size_t c = 0; c < N; ++c) {
            const Factor factor = factor_[next[c]++];
            into.lower -= factor.upper * left[c].lower;
            into.upper -= factor.lower * left[c].upper;
        }
        work_[at(row_[q])] = into;
    }
    for (std::size_t c = 0; c < N; ++c) {
        const std::size_t i = columns[c];
        const Factor factor{left[c].upper / diagonal_[i], left[c].lower / diagonal_[i]};
        pivot -= factor.lower * left[c].upper;
        row_[filled_[i]] = static_cast<Index>(k);
        factor_[filled_[i]++] = factor;
    }
    return pivot;
}

/// What is left of row and column k in nested columns, after those before each.
template <std::size_t N>
std::array<UnpivotedLu::Left, N> UnpivotedLu::takeOut(const std::array<std::size_t, N>& columns) {
    std::array<Left, N> left{};
    for (std::size_t c = 0; c < N; ++c) {
        left[c] = work_[columns[c]];
        work_[columns[c]] = {};
        for (std::size_t before = 0; before < c; ++before) {
            const Factor factor = factor_[begin_[columns[before]] + (c - before - 1)];
            left[c].lower -= factor.upper * left[before].lower;
            left[c].upper -= factor.lower * left[before].upper;
        }
    }
    return left;
}

Vector UnpivotedLu::solve(const Vector& right) const {
    const std::size_t n = place_.size();
    std::vector<double> x(n);
    for (std::size_t u = 0; u < n; ++u) x[at(place_[u])] = right[static_cast<Eigen::Index>(u)];
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t q = begin_[i]; q < begin_[i + 1]; ++q) x[at(row_[q])] -= factor_[q].lower * x[i];
    for (std::size_t i = n; i-- > 0;) {
        x[i] /= diagonal_[i];
        for (std::size_t q = begin_[i]; q < begin_[i + 1]; ++q) x[i] -= factor_[q].upper * x[at(row_[q])];
    }
    Vector solution(right.size());
    for (std::size_t u = 0; u < n; ++u) solution[static_cast<Eigen::Index>(u)] = x[at(place_[u])];
    return solution;
}

}  // namespace talus::flow
