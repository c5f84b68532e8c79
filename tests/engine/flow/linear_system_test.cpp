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

TEST_CASE("linear systems of flow: sound pivots") {
    LinearSystem system;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Eigen::MatrixXd matrix = anyMatrix(20, seed);
        matrix.diagonal().array() += 20;
        const Vector right = anyMatrix(20, 10 + seed).col(0);
        const auto solution = system.solve(sparse(matrix), right);
        REQUIRE(solution.has_value());
        CHECK((matrix * *solution - right).norm() < 1e-13 * right.norm());
    }
}

TEST_CASE("linear systems of flow: small pivots cost accuracy, which refinement gives back, or no solution") {
    LinearSystem system;
    int solved = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        Eigen::MatrixXd matrix = anyMatrix(30, seed);
        matrix.diagonal().array() *= seed % 2 == 0 ? 1e-9 : 1e-15;
        const Vector right = anyMatrix(30, 50 + seed).col(0);
        const auto solution = system.solve(sparse(matrix), right);
        if (!solution) continue;
        ++solved;
        const Vector expected = matrix.fullPivLu().solve(right);
        CHECK((*solution - expected).norm() < 1e-10 * expected.norm());
    }
    CHECK(solved > 0);
    CHECK(solved < 20);
}

TEST_CASE("linear systems of flow: no pivot has no solution, the next matrix has") {
    LinearSystem system;
    const Vector right{{2, 3}};
    CHECK_FALSE(system.solve(sparse(Eigen::MatrixXd{{0, 1}, {1, 0}}), right).has_value());
    CHECK(system.solve(sparse(Eigen::MatrixXd{{2, 1}, {1, 2}}), right).has_value());
    CHECK_FALSE(LinearSystem().solve(sparse(Eigen::MatrixXd::Zero(3, 3)), Vector::Ones(3)).has_value());
}
