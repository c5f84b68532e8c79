#include "law/points.h"

#include <doctest/doctest.h>

#include <random>

#include "geometry/polygon.h"

using namespace talus;
using contact::PatchPoint;
using contact::patchPoints;

namespace {

/// Vertices on an ellipse at sorted random angles: convex, counter-clockwise.
std::vector<Eigen::Vector2d> randomPatch(std::mt19937& random, int vertices) {
    std::uniform_real_distribution<double> angle(0, 2 * M_PI), shift(-3, 3);
    std::vector<double> angles;
    for (int k = 0; k < vertices; ++k) angles.push_back(angle(random));
    std::sort(angles.begin(), angles.end());
    const double x = shift(random), y = shift(random);
    std::vector<Eigen::Vector2d> patch;
    for (const double a : angles) patch.emplace_back(x + 2 * std::cos(a), y + std::sin(a));
    return patch;
}

Polygon polygonOf(const std::vector<Eigen::Vector2d>& patch) {
    Polygon polygon;
    for (const auto& v : patch) polygon.push(v);
    return polygon;
}

double sumArea(const std::vector<PatchPoint>& points) {
    double sum = 0;
    for (const PatchPoint& p : points) sum += p.area;
    return sum;
}

const std::vector<Eigen::Vector2d> kRectangle{{0, 0}, {0.2, 0}, {0.2, 0.1}, {0, 0.1}};

}  // namespace

TEST_SUITE("law") {
    TEST_CASE("vertex rule: areas and moments up to degree two are exact on random polygons") {
        std::mt19937 random(7);
        for (int k = 0; k < 200; ++k) {
            const auto patch = randomPatch(random, 3 + k % 8);
            const Polygon polygon = polygonOf(patch);
            const auto points = patchPoints(patch, {PointRule::Kind::vertex, 0});
            REQUIRE(points.size() == 2 * patch.size() + 1);
            double xx = 0, xy = 0, yy = 0;
            Eigen::Vector2d first = Eigen::Vector2d::Zero();
            for (const PatchPoint& p : points) {
                first += p.area * p.position;
                xx += p.area * p.position.x() * p.position.x();
                xy += p.area * p.position.x() * p.position.y();
                yy += p.area * p.position.y() * p.position.y();
            }
            const SecondMoments exact = secondMoments(polygon);
            CHECK(sumArea(points) == doctest::Approx(area(polygon)).epsilon(1e-12));
            CHECK((first / area(polygon) - centroid(polygon)).norm() < 1e-12);
            CHECK(xx == doctest::Approx(exact.xx).epsilon(1e-11));
            CHECK(xy == doctest::Approx(exact.xy).epsilon(1e-9));
            CHECK(yy == doctest::Approx(exact.yy).epsilon(1e-11));
        }
    }

    TEST_CASE("vertex rule: nine Lps on a rectangle, the outermost on its corners") {
        const auto points = patchPoints(kRectangle, {PointRule::Kind::vertex, 0});
        CHECK(points.size() == 9);
        for (int k = 0; k < 4; ++k) {
            CHECK(points[static_cast<std::size_t>(k)].position == kRectangle[static_cast<std::size_t>(k)]);
            CHECK(points[static_cast<std::size_t>(k)].area == doctest::Approx(0.02 / 24));
        }
    }

    TEST_CASE("quarter rule: four equal areas at the quarter points of a rectangle") {
        const auto points = patchPoints(kRectangle, {PointRule::Kind::quarter, 0});
        REQUIRE(points.size() == 4);
        for (const PatchPoint& p : points) CHECK(p.area == doctest::Approx(0.005));
        CHECK(points[0].position.x() == doctest::Approx(0.05));
        CHECK(points[0].position.y() == doctest::Approx(0.025));
    }

    TEST_CASE("quarter and corner rules: areas add up, quarter keeps the centroid") {
        std::mt19937 random(11);
        for (int k = 0; k < 50; ++k) {
            const auto patch = randomPatch(random, 3 + k % 6);
            const auto quarter = patchPoints(patch, {PointRule::Kind::quarter, 0});
            const auto corner = patchPoints(patch, {PointRule::Kind::corner, 0});
            CHECK(sumArea(quarter) == doctest::Approx(area(polygonOf(patch))));
            CHECK(sumArea(corner) == doctest::Approx(area(polygonOf(patch))));
            Eigen::Vector2d first = Eigen::Vector2d::Zero();
            for (const PatchPoint& p : quarter) first += p.area * p.position;
            CHECK((first / sumArea(quarter) - centroid(polygonOf(patch))).norm() < 1e-12);
        }
    }

    TEST_CASE("grid rule: N x N cell centroids") {
        const auto points = patchPoints(kRectangle, {PointRule::Kind::grid, 4});
        CHECK(points.size() == 16);
        CHECK(sumArea(points) == doctest::Approx(0.02));
        CHECK(points[0].position.x() == doctest::Approx(0.025));
        CHECK(contact::isRectangle(kRectangle));
        const std::vector<Eigen::Vector2d> skewed{{0, 0}, {1, 0}, {1.2, 1}, {0.2, 1}};
        CHECK_FALSE(contact::isRectangle(skewed));
    }
}
