#pragma once
// Matrices of 6 x 6 blocks to solve with, and what a dense solver makes of them.

#include <Eigen/Core>

#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "equilibrium/block_matrix.h"

namespace talus::test {

/// Unsymmetric values on a random graph; with the default diagonal large enough to eliminate without
/// exchanging rows of blocks.
inline equilibrium::BlockMatrix randomMatrix(std::size_t rows, std::size_t edges, unsigned seed,
                                             double diagonal = 8) {
    using namespace equilibrium;
    std::mt19937 random(seed);
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    std::uniform_int_distribution<std::int32_t> row(0, static_cast<std::int32_t>(rows) - 1);
    while (pairs.size() < edges)
        if (const std::pair pair{row(random), row(random)}; pair.first != pair.second) pairs.push_back(pair);
    BlockMatrix matrix(rows, pairs);
    std::srand(seed);
    for (Mat6& block : matrix.upper) block.setRandom();
    for (Mat6& block : matrix.lower) block.setRandom();
    for (Mat6& block : matrix.diagonal) block = Mat6::Random() + diagonal * Mat6::Identity();
    return matrix;
}

inline Eigen::MatrixXd dense(const equilibrium::BlockMatrix& m) {
    const auto n = static_cast<Eigen::Index>(6 * m.rows());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t r = 0; r < m.rows(); ++r) {
        const auto at = static_cast<Eigen::Index>(6 * r);
        result.block<6, 6>(at, at) = m.diagonal[r];
    }
    for (std::size_t e = 0; e < m.edges.size(); ++e) {
        const Eigen::Index i = 6 * m.edges[e].first, j = 6 * m.edges[e].second;
        result.block<6, 6>(i, j) = m.upper[e];
        result.block<6, 6>(j, i) = m.lower[e];
    }
    return result;
}

inline Eigen::VectorXd flat(const equilibrium::Vec6s& x) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(6 * x.size()));
    for (std::size_t r = 0; r < x.size(); ++r) result.segment<6>(static_cast<Eigen::Index>(6 * r)) = x[r];
    return result;
}

}  // namespace talus::test
