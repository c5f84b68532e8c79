#pragma once
// The kernels' source.

#include "equilibrium/iteration_view.h"
#include "equilibrium/six_lanes.h"

namespace talus::equilibrium {
namespace {

TALUS_KERNEL const double* blockOf(const double* blocks, std::size_t k) { return blocks + kBlock * k; }

void eliminateRow(double* block, const double* inverse, const double* upper, const std::int32_t* slot,
                  std::size_t count, double* row) {
    const Columns unscaled = loadBlock(block);
    Columns factor;
    for (std::size_t k = 0; k < kColumn; ++k) factor.c[k] = product(unscaled, inverse + kColumn * k);
    storeBlock(block, factor);
    for (std::size_t u = 0; u < count; ++u) {
        double* target = row + kBlock * static_cast<std::size_t>(slot[u]);
        Columns c = loadBlock(target);
        takeProduct(factor, blockOf(upper, u), c);
        storeBlock(target, c);
    }
}

void substitute(const FactorsView& view, double* x) {
    const auto at = [x](std::int32_t column) { return x + kColumn * static_cast<std::size_t>(column); };
    for (std::size_t i = 0; i < view.rows; ++i) {
        Six sum = load(x + kColumn * i);
        for (std::size_t p = view.lower_begin[i]; p < view.lower_begin[i + 1]; ++p)
            sum = sum - product(loadBlock(blockOf(view.lower, p)), at(view.lower_column[p]));
        store(x + kColumn * i, sum);
    }
    for (std::size_t i = view.rows; i-- > 0;) {
        Six sum = load(x + kColumn * i);
        for (std::size_t p = view.upper_begin[i]; p < view.upper_begin[i + 1]; ++p)
            sum = sum - product(loadBlock(blockOf(view.upper, p)), at(view.upper_column[p]));
        double right[kColumn];
        store(right, sum);
        store(x + kColumn * i, product(loadBlock(blockOf(view.diagonal_inverse, i)), right));
    }
}

void multiply(const UpperRows& structure, const double* diagonal, const double* upper, const double* lower,
              const double* x, double* y) {
    for (std::size_t i = 0; i < structure.rows; ++i)
        store(y + kColumn * i, product(loadBlock(blockOf(diagonal, i)), x + kColumn * i));
    for (std::size_t i = 0; i < structure.rows; ++i) {
        Six sum = load(y + kColumn * i);
        for (std::size_t p = structure.begin[i]; p < structure.begin[i + 1]; ++p) {
            const std::size_t j = kColumn * static_cast<std::size_t>(structure.column[p]);
            sum = sum + product(loadBlock(blockOf(upper, p)), x + j);
            store(y + j, load(y + j) + product(loadBlock(blockOf(lower, p)), x + kColumn * i));
        }
        store(y + kColumn * i, sum);
    }
}

constexpr IterationKernels kIterate{eliminateRow, substitute, multiply};

}  // namespace
}  // namespace talus::equilibrium
