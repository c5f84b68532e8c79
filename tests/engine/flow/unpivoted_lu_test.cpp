#include "flow/unpivoted_lu.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>

using namespace talus::flow;

namespace {

/// Unsymmetric values in a symmetric structure, with dominant diagonals.
SparseMatrix anyMatrix(int size, double density, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1), value(-1, 1);
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < size; ++i) {
        entries.emplace_back(i, i, size * density + 1 + share(random));
        for (int j = 0; j < i; ++j) {
            if (share(random) > density) continue;
            entries.emplace_back(i, j, value(random));
            entries.emplace_back(j, i, value(random));
        }
    }
    SparseMatrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Vector anyVector(int size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    Vector vector(size);
    for (double& x : vector) x = value(random);
    return vector;
}

}  // namespace

TEST_CASE("unpivoted LU: solves what dense factors with pivoting solve") {
    for (const int size : {1, 2, 7, 40, 150})
        for (const double density : {0.0, 0.02, 0.2, 1.0}) {
            CAPTURE(size);
            CAPTURE(density);
            const SparseMatrix matrix = anyMatrix(size, density, 1);
            const Vector right = anyVector(size, 2);
            UnpivotedLu factors(matrix);
            REQUIRE(factors.factorise(matrix));
            const Vector expected = Eigen::MatrixXd(matrix).partialPivLu().solve(right);
            CHECK((factors.solve(right) - expected).norm() < 1e-13 * (1 + expected.norm()));
        }
}

TEST_CASE("unpivoted LU: the structure serves other values, also after a matrix that it could not take") {
    SparseMatrix matrix = anyMatrix(60, 0.1, 3);
    UnpivotedLu factors(matrix);
    REQUIRE(factors.factorise(matrix));
    const Vector right = anyVector(60, 4);
    const Vector first = factors.solve(right);
    SparseMatrix zero = 0 * matrix;
    CHECK_FALSE(factors.factorise(zero));
    SparseMatrix twice = 2 * matrix;
    REQUIRE(factors.factorise(twice));
    CHECK((2 * factors.solve(right) - first).norm() < 1e-14 * first.norm());
    REQUIRE(factors.factorise(matrix));
    CHECK(factors.solve(right) == first);  // to the bit
}

TEST_CASE("unpivoted LU: a chain fills nothing in") {
    constexpr int kSize = 30;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < kSize; ++i) {
        entries.emplace_back(i, i, 3.0);
        if (i > 0) entries.emplace_back(i, i - 1, -1.0), entries.emplace_back(i - 1, i, -2.0);
    }
    SparseMatrix matrix(kSize, kSize);
    matrix.setFromTriplets(entries.begin(), entries.end());
    CHECK(UnpivotedLu(matrix).entries() == static_cast<std::size_t>(matrix.nonZeros()));
}
