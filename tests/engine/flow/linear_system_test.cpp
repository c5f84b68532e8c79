#include "flow/linear_system.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>
#include <vector>

using namespace talus::flow;

namespace {

/// With an entry everywhere, also where it is zero.
SparseMatrix sparse(const Eigen::MatrixXd& dense) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < dense.rows(); ++i)
        for (int j = 0; j < dense.cols(); ++j) entries.emplace_back(i, j, dense(i, j));
    SparseMatrix matrix(dense.rows(), dense.cols());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Eigen::MatrixXd anyMatrix(Eigen::Index size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    Eigen::MatrixXd matrix(size, size);
    for (double& x : matrix.reshaped()) x = value(random);
    return matrix;
}

}  // namespace

TEST_CASE("linear systems of flow: without pivoting where the pivots allow it") {
    LinearSystem system;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Eigen::MatrixXd matrix = anyMatrix(20, seed);
        matrix.diagonal().array() += 20;
        const Vector right = anyMatrix(20, 10 + seed).col(0);
        const auto solution = system.solve(sparse(matrix), right);
        REQUIRE(solution.has_value());
        CHECK((matrix * *solution - right).norm() < 1e-13 * right.norm());
    }
    CHECK(system.pivoted() == 0);
}

TEST_CASE("linear systems of flow: a pivot of zero is solved with pivoting") {
    LinearSystem system;
    const Eigen::MatrixXd swap{{0, 1}, {1, 0}};
    const Vector right{{2, 3}};
    const auto solution = system.solve(sparse(swap), right);
    REQUIRE(solution.has_value());
    CHECK((*solution - Vector{{3, 2}}).norm() < 1e-15);
    CHECK(system.pivoted() == 1);
    // The next matrix has sound pivots again.
    REQUIRE(system.solve(sparse(Eigen::MatrixXd{{2, 1}, {1, 2}}), right).has_value());
    CHECK(system.pivoted() == 1);
}

TEST_CASE("linear systems of flow: small pivots cost accuracy, which refinement or pivoting gives back") {
    LinearSystem system;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        Eigen::MatrixXd matrix = anyMatrix(30, seed);
        matrix.diagonal().array() *= seed % 2 == 0 ? 1e-9 : 1e-15;
        const Vector right = anyMatrix(30, 50 + seed).col(0);
        const auto solution = system.solve(sparse(matrix), right);
        REQUIRE(solution.has_value());
        const Vector expected = matrix.fullPivLu().solve(right);
        CHECK((*solution - expected).norm() < 1e-10 * expected.norm());
    }
    CHECK(system.pivoted() > 0);
}

TEST_CASE("linear systems of flow: a singular matrix has no solution") {
    LinearSystem system;
    CHECK_FALSE(system.solve(sparse(Eigen::MatrixXd::Zero(3, 3)), Vector::Ones(3)).has_value());
}
