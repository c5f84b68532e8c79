#include "flow/upstream.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

using namespace talus::flow;

namespace {

/// Conductances of the sides of a triangle of 1 m2/s: half the cotangents of the opposite angles.
Corners conductancesOf(const std::array<Eigen::Vector2d, 3>& corner) {
    Corners conductance{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d a = corner[k] - corner[(k + 2) % 3],
                              b = corner[(k + 1) % 3] - corner[(k + 2) % 3];
        conductance[k] = a.dot(b) / (2 * std::abs(a.x() * b.y() - a.y() * b.x()));
    }
    return conductance;
}

/// Apexes over a side of 2 m: the angle there is acute, right, obtuse.
std::array<Corners, 3> threeTriangles() {
    const auto with = [](double height) {
        return conductancesOf({Eigen::Vector2d(-1, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, height)});
    };
    return {with(1.6), with(1), with(0.3)};
}

class Draw {
 public:
    explicit Draw(unsigned seed) : random_(seed) {}
    Corners corners(double low, double high) {
        std::uniform_real_distribution<double> between(low, high);
        return {between(random_), between(random_), between(random_)};
    }

 private:
    std::mt19937 random_;
};

}  // namespace

TEST_CASE("upstream: a full triangle carries what a linear head gives") {
    Draw draw(1);
    for (const Corners& c : threeTriangles())
        for (int trial = 0; trial < 10; ++trial) {
            const Corners h = draw.corners(-1, 1);
            const TriangleFlow flow = triangleFlow(c, h, {1, 1, 1});
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
                const double expected = c[i] * (h[i] - h[next]) + c[last] * (h[i] - h[last]);
                CHECK(flow.inflow[i] == doctest::Approx(expected).epsilon(1e-12));
            }
        }
}

TEST_CASE("upstream: what flows in flows out, and derivatives are those by differences") {
    constexpr double kStep = 1e-6;
    Draw draw(2);
    for (const Corners& c : threeTriangles())
        for (int trial = 0; trial < 10; ++trial) {
            const Corners h = draw.corners(-1, 1), k = draw.corners(0, 1);
            const TriangleFlow flow = triangleFlow(c, h, k);
            CHECK(std::abs(flow.inflow[0] + flow.inflow[1] + flow.inflow[2]) < 1e-14);
            for (std::size_t j = 0; j < 3; ++j) {
                Corners more = h, less = h, more_k = k, less_k = k;
                more[j] += kStep, less[j] -= kStep;
                more_k[j] += kStep, less_k[j] -= kStep;
                const TriangleFlow up = triangleFlow(c, more, k), down = triangleFlow(c, less, k);
                const TriangleFlow wet = triangleFlow(c, h, more_k), dry = triangleFlow(c, h, less_k);
                for (std::size_t i = 0; i < 3; ++i) {
                    CHECK(std::abs(flow.by_head[i][j] - (up.inflow[i] - down.inflow[i]) / (2 * kStep)) <
                          1e-8);
                    CHECK(std::abs(flow.by_conductivity[i][j] -
                                   (wet.inflow[i] - dry.inflow[i]) / (2 * kStep)) < 1e-8);
                }
            }
        }
}

TEST_CASE("upstream: the highest corner counts, a dry one below it does not") {
    const auto [acute, right, obtuse] = threeTriangles();
    for (const Corners& c : {acute, right})
        for (const double below : {0.0, 0.3}) {
            // Both lower corners are level: nothing flows between them.
            const TriangleFlow flow = triangleFlow(c, {0, 0, 1}, {below, below, 0.7});
            CHECK(flow.inflow[2] == doctest::Approx(0.7 * (c[1] + c[2])).epsilon(1e-12));
            CHECK(flow.inflow[0] == doctest::Approx(-0.7 * c[2]).epsilon(1e-12));
        }
    // Along the long side of an obtuse triangle water flows through the apex, which is dry here.
    const TriangleFlow through = triangleFlow(obtuse, {1, -1, 0}, {1, 1, 0});
    CHECK(through.inflow[0] == doctest::Approx(obtuse[2] + 2 * obtuse[0]).epsilon(1e-12));
    CHECK(through.inflow[1] == 0);
}

TEST_CASE("upstream: more water in a corner never takes any from another") {
    Draw draw(3);
    for (const Corners& c : threeTriangles())
        for (int trial = 0; trial < 20; ++trial) {
            const TriangleFlow flow = triangleFlow(c, draw.corners(-1, 1), draw.corners(0, 1));
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    CHECK((i == j ? flow.by_conductivity[i][j] : -flow.by_conductivity[i][j]) >= 0);
        }
}
