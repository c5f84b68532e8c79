#include "equilibrium/iterative_solver.h"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "equilibrium/linear_solver.h"
#include "support/block_matrices.h"

using namespace talus::equilibrium;
using namespace talus::test;
namespace simd = talus::simd;

namespace {

constexpr double kAccuracy = IterativeSolver::kAccuracy;

/// Residual of A x = b over the right side, both over the rows' weights.
double residualOf(const BlockMatrix& matrix, const std::vector<double>& weight, const Vec6s& right,
                  const Vec6s& x) {
    Vec6s product;
    matrix.multiply(x, product);
    double sum = 0, whole = 0;
    for (std::size_t r = 0; r < right.size(); ++r) {
        sum += (product[r] - right[r]).squaredNorm() / (weight[r] * weight[r]);
        whole += right[r].squaredNorm() / (weight[r] * weight[r]);
    }
    return std::sqrt(sum / whole);
}

/// Weights over three orders of magnitude, as of boulders and pebbles.
std::vector<double> unevenWeights(std::size_t rows) {
    std::vector<double> weight;
    for (std::size_t r = 0; r < rows; ++r) weight.push_back(std::pow(10.0, static_cast<double>(r % 4)));
    return weight;
}

/// Forces that are about as large as the weights.
Vec6s forces(const std::vector<double>& weight) {
    Vec6s right;
    for (const double w : weight) right.push_back(w * Vec6::Random());
    return right;
}

BlockMatrix chainOf(std::size_t rows) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::int32_t k = 0; k + 1 < static_cast<std::int32_t>(rows); ++k) pairs.emplace_back(k, k + 1);
    BlockMatrix matrix(rows, pairs);
    std::srand(5);
    for (Mat6s* blocks : {&matrix.upper, &matrix.lower})
        for (Mat6& block : *blocks) block.setRandom();
    for (Mat6& block : matrix.diagonal) block = Mat6::Random() + 5 * Mat6::Identity();
    return matrix;
}

/// What a row's neighbours have is small beside the largest numbers of its diagonal, and large beside the
/// others.
BlockMatrix hardMatrix() {
    BlockMatrix matrix = randomMatrix(300, 1500, 3, 0.1);
    for (Mat6& block : matrix.diagonal) block.array() += 1000.0;
    return matrix;
}

bool solvedBy(simd::InstructionSet set, const BlockMatrix& matrix, const std::vector<double>& weight,
              Vec6s& x) {
    IterativeSolver solver(matrix, set);
    return solver.factorise(matrix) && solver.solve(matrix, weight, x);
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("iterations leave a residual of no more than they promise, whatever the rows weigh") {
        for (const std::pair<std::size_t, std::size_t>& size :
             {std::pair<std::size_t, std::size_t>{1, 0}, {2, 1}, {40, 80}, {90, 300}, {400, 1600}}) {
            const std::size_t rows = size.first, edges = size.second;
            CAPTURE(rows);
            const BlockMatrix first = randomMatrix(rows, edges, 3, 12);
            BlockMatrix second = first;
            for (Mat6& block : second.diagonal) block *= 1.5;
            IterativeSolver solver(first);
            for (const BlockMatrix& matrix : {first, second})
                for (const std::vector<double>& weight :
                     {std::vector<double>(rows, 1.0), unevenWeights(rows)}) {
                    const Vec6s right = forces(weight);
                    Vec6s x = right;
                    REQUIRE(solver.factorise(matrix));
                    REQUIRE(solver.solve(matrix, weight, x));
                    CHECK(residualOf(matrix, weight, right, x) < 1.01 * kAccuracy);
                }
        }
    }

    TEST_CASE("of a chain the factors are complete: one iteration solves it to rounding") {
        const BlockMatrix matrix = chainOf(60);
        const std::vector<double> weight = unevenWeights(60);
        const Vec6s right = forces(weight);
        Vec6s x = right;
        IterativeSolver solver(matrix);
        REQUIRE(solver.factorise(matrix));
        REQUIRE(solver.solve(matrix, weight, x));
        CHECK(residualOf(matrix, weight, right, x) < 1e-12);
    }

    TEST_CASE("each build of the iterations gives the same bits") {
        using simd::InstructionSet;
        const BlockMatrix matrix = randomMatrix(90, 300, 7, 10);
        const std::vector<double> weight = unevenWeights(90);
        const Vec6s right = forces(weight);
        Vec6s expected = right;
        REQUIRE(solvedBy(InstructionSet::scalar, matrix, weight, expected));
        for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
            if (!simd::isAvailable(set)) continue;
            Vec6s x = right;
            REQUIRE(solvedBy(set, matrix, weight, x));
            for (std::size_t r = 0; r < x.size(); ++r) CHECK((x[r].array() == expected[r].array()).all());
        }
    }

    TEST_CASE("what iterations do not come to the end of is refused, and x is as it was") {
        const BlockMatrix hard = hardMatrix();
        BlockMatrix singular = randomMatrix(40, 80, 3);
        singular.diagonal[0].setZero();
        BlockMatrix broken = randomMatrix(40, 80, 3);
        broken.diagonal[7](2, 3) = std::nan("");
        for (const BlockMatrix& matrix : {hard, singular, broken}) {
            const std::vector<double> weight(matrix.rows(), 1.0);
            const Vec6s right = forces(weight);
            Vec6s x = right;
            CHECK_FALSE(solvedBy(simd::bestInstructionSet(), matrix, weight, x));
            for (std::size_t r = 0; r < x.size(); ++r) CHECK((x[r].array() == right[r].array()).all());
        }
    }

    TEST_CASE(
        "a linear solver iterates where factors would fill up, and takes factors where iterations fail") {
        for (const bool is_hard : {false, true}) {
            CAPTURE(is_hard);
            const BlockMatrix matrix = is_hard ? hardMatrix() : randomMatrix(300, 1500, 3, 12);
            const std::vector<double> weight(300, 1.0);
            const Vec6s right = forces(weight);
            Vec6s x = right;
            LinearSolver solver(matrix, simd::bestInstructionSet(), nullptr);
            REQUIRE(solver.factorise(matrix, weight));
            REQUIRE(solver.solve(x));
            const double residual = residualOf(matrix, weight, right, x);
            CHECK(residual < 1.01 * kAccuracy);
            CHECK((residual < 1e-5) == is_hard);
        }
        const BlockMatrix chain = chainOf(300);
        Vec6s x(300, Vec6::Ones());
        const std::vector<double> weight(300, 1.0);
        LinearSolver solver(chain, simd::bestInstructionSet(), nullptr);
        REQUIRE(solver.factorise(chain, weight));
        REQUIRE(solver.solve(x));
        const Eigen::VectorXd exact =
            dense(chain).partialPivLu().solve(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(6 * 300)));
        CHECK((flat(x) - exact).norm() < 1e-9 * exact.norm());
    }
}
