#pragma once
// Where the equations of a network have their entries: the same in every iteration.

#include <array>
#include <cstdint>
#include <vector>

#include "flow/conditions.h"
#include "flow/sparse.h"

namespace talus::flow {

/// An entry for each pair of corners of a triangle, both ways round, and the diagonal. Nodes with a head, and
/// dry ones, are no unknowns: they have their diagonal alone.
class Structure {
 public:
    Structure(const Network& network, const Conditions& conditions);

    const SparseMatrix& empty() const { return empty_; }  ///< every entry is zero

    /// Where the values of a matrix of this structure have the entry of two corners of a triangle; -1: nowhere.
    std::int32_t entry(std::size_t triangle, std::size_t row, std::size_t column) const {
        return entry_[triangle][3 * row + column];
    }
    std::int32_t diagonal(std::size_t node) const { return diagonal_[node]; }

 private:
    SparseMatrix empty_;
    std::vector<std::array<std::int32_t, 9>> entry_;
    std::vector<std::int32_t> diagonal_;
};

}  // namespace talus::flow
