#include "equilibrium/block_matrix.h"

#include <doctest/doctest.h>
#include <Eigen/LU>

#include "support/block_matrices.h"

using namespace talus::equilibrium;
using namespace talus::test;
namespace simd = talus::simd;

TEST_SUITE("equilibrium") {
    TEST_CASE("block factors solve what a dense solver solves; the structure serves for other values") {
        for (const auto& [rows, edges] :
             {std::pair<std::size_t, std::size_t>{1, 0}, {2, 1}, {12, 20}, {40, 80}, {30, 800}, {90, 300}}) {
            const BlockMatrix first = randomMatrix(rows, edges, 3);
            BlockLu lu(first);
            BlockMatrix second = first;
            for (Mat6& block : second.diagonal) block *= 1.5;
            for (const BlockMatrix& matrix : {first, second}) {
                REQUIRE(lu.factorise(matrix));
                Vec6s x(rows, Vec6::Ones()), product;
                lu.solve(x);
                const Eigen::VectorXd exact = dense(matrix).partialPivLu().solve(
                    Eigen::VectorXd::Ones(static_cast<Eigen::Index>(6 * rows)));
                CHECK((flat(x) - exact).norm() < 1e-9 * exact.norm());
                matrix.multiply(x, product);
                CHECK((flat(product).array() - 1).matrix().norm() < 1e-9);
            }
        }
    }

    TEST_CASE("each build of the products gives the same bits") {
        using simd::InstructionSet;
        for (const auto& [rows, edges] : {std::pair<std::size_t, std::size_t>{30, 800}, {90, 300}}) {
            const BlockMatrix matrix = randomMatrix(rows, edges, 7);
            BlockLu scalar(matrix, InstructionSet::scalar);
            REQUIRE(scalar.factorise(matrix));
            Vec6s expected(rows, Vec6::Ones());
            scalar.solve(expected);
            for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
                if (!simd::isAvailable(set)) continue;
                BlockLu lu(matrix, set);
                REQUIRE(lu.factorise(matrix));
                Vec6s x(rows, Vec6::Ones());
                lu.solve(x);
                for (std::size_t r = 0; r < rows; ++r) CHECK((x[r].array() == expected[r].array()).all());
            }
        }
    }

    TEST_CASE("a chain of blocks has no fill, and a singular one no factors") {
        std::vector<std::pair<std::int32_t, std::int32_t>> chain;
        for (std::int32_t k = 0; k + 1 < 50; ++k) chain.emplace_back(k, k + 1);
        BlockMatrix matrix(50, chain);
        BlockLu lu(matrix);
        CHECK(lu.entries() == 50 + 2 * 49);
        CHECK_FALSE(lu.factorise(matrix));
    }

    TEST_CASE("factors that would take more products than allowed are not begun") {
        const BlockMatrix matrix = randomMatrix(90, 300, 7);
        const auto withMost = [&](double most) {
            return BlockLu(matrix, simd::bestInstructionSet(), nullptr, most);
        };
        BlockLu few = withMost(1e3), many = withMost(1e6);
        CHECK(few.isTooLarge());
        CHECK_FALSE(few.factorise(matrix));
        CHECK_FALSE(many.isTooLarge());
        CHECK(many.factorise(matrix));
    }
}
