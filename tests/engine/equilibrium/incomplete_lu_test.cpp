#include "equilibrium/incomplete_lu.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "support/block_matrices.h"

using namespace talus::equilibrium;
using namespace talus::test;
namespace simd = talus::simd;

namespace {

IncompleteLu factorsOf(const BlockMatrix& matrix, double drop) {
    IncompleteLu factors(matrix, simd::bestInstructionSet(), drop);
    REQUIRE(factors.factorise(matrix));
    return factors;
}

/// Of the factors' solution, over the right side.
double residualOf(const IncompleteLu& factors, const BlockMatrix& matrix) {
    std::srand(11);
    Vec6s right(matrix.rows());
    for (Vec6& row : right) row.setRandom();
    Vec6s x = right, product;
    factors.solve(x);
    matrix.multiply(x, product);
    return (flat(product) - flat(right)).norm() / flat(right).norm();
}

/// S A S, as if lengths were counted in another unit: moments and turns change, forces and ways do not.
BlockMatrix inUnits(BlockMatrix matrix, double unit) {
    Vec6 scale = Vec6::Ones();
    scale.tail<3>().setConstant(unit);
    for (Mat6s* blocks : {&matrix.diagonal, &matrix.upper, &matrix.lower})
        for (Mat6& block : *blocks) block = (scale.asDiagonal() * block * scale.asDiagonal()).eval();
    return matrix;
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("factors of which nothing is left out solve to rounding") {
        for (const std::pair<std::size_t, std::size_t>& size :
             {std::pair<std::size_t, std::size_t>{1, 0}, {2, 1}, {30, 0}, {40, 80}, {120, 400}}) {
            CAPTURE(size.first);
            for (const unsigned seed : {1u, 2u, 3u}) {
                const BlockMatrix matrix = randomMatrix(size.first, size.second, seed, 12);
                CHECK(residualOf(factorsOf(matrix, 0), matrix) < 1e-10);
            }
        }
    }

    TEST_CASE("the less is left out, the more blocks there are and the better is the solution") {
        const BlockMatrix matrix = randomMatrix(300, 1200, 5, 14);
        std::size_t entries = 0;
        double residual = 1;
        for (const double drop : {0.3, 0.1, 0.03, 0.01, 0.003}) {
            CAPTURE(drop);
            const IncompleteLu factors = factorsOf(matrix, drop);
            CHECK(factors.entries() > entries);
            CHECK(residualOf(factors, matrix) < residual);
            entries = factors.entries();
            residual = residualOf(factors, matrix);
        }
        CHECK(entries < factorsOf(matrix, 0).entries());
    }

    TEST_CASE("blocks that are small beside their row's diagonal leave nothing but the diagonal") {
        BlockMatrix matrix = randomMatrix(50, 200, 4);
        for (Mat6& block : matrix.diagonal) block = 1e3 * Mat6::Identity();
        CHECK(factorsOf(matrix, 0.1).entries() == matrix.rows());
        CHECK(factorsOf(matrix, 1e-4).entries() >= matrix.rows() + 2 * matrix.edges.size());
    }

    TEST_CASE("what is left out does not depend on the unit of length") {
        const BlockMatrix matrix = randomMatrix(120, 500, 6, 12);
        const std::size_t entries = factorsOf(matrix, 0.1).entries();
        for (const double unit : {1e-3, 0.25, 64.0, 1e3}) {
            CAPTURE(unit);
            CHECK(factorsOf(inUnits(matrix, unit), 0.1).entries() == entries);
        }
    }

    TEST_CASE("a singular matrix has no factors, and the next one has those that it always had") {
        const BlockMatrix good = randomMatrix(60, 150, 3, 12);
        BlockMatrix singular = good, broken = good;
        singular.diagonal[20].setZero();
        for (Mat6s* blocks : {&singular.upper, &singular.lower})
            for (Mat6& block : *blocks) block.setZero();
        broken.upper[7](2, 3) = std::nan("");
        IncompleteLu factors(good, simd::bestInstructionSet(), 0.05);
        Vec6s expected(good.rows(), Vec6::Ones());
        factorsOf(good, 0.05).solve(expected);
        for (const BlockMatrix& bad : {singular, broken}) {
            CHECK_FALSE(factors.factorise(bad));
            REQUIRE(factors.factorise(good));
            Vec6s x(good.rows(), Vec6::Ones());
            factors.solve(x);
            for (std::size_t r = 0; r < x.size(); ++r) CHECK((x[r].array() == expected[r].array()).all());
        }
    }
}
