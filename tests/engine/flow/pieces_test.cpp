#include "flow/pieces.h"

#include <doctest/doctest.h>

#include <array>
#include <random>

using namespace talus;
using talus::flow::Ring;

namespace {

constexpr double kSame = 1e-6;

FlowBoundary boxed(const Vec3& low, const Vec3& high) {
    FlowBoundary boundary;
    boundary.box_min = low;
    boundary.box_max = high;
    return boundary;
}

double areaOf(const Ring& ring) {
    Vec3 twice = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
        twice += (ring[k] - ring[0]).cross(ring[k + 1] - ring[0]);
    return 0.5 * twice.norm();
}

double areaOf(const std::vector<Ring>& pieces) {
    double sum = 0;
    for (const Ring& piece : pieces) sum += areaOf(piece);
    return sum;
}

std::vector<Ring> piecesOf(const Ring& ring, const std::vector<FlowBoundary>& boundaries) {
    return flow::piecesOf(ring, 0, boundaries, Vec3::Zero(), kSame);
}

const Ring kSquare{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};

}  // namespace

TEST_CASE("pieces: a box inside a polygon is one of five, by hand") {
    const auto pieces = piecesOf(kSquare, {boxed({1, 1, -1}, {2, 3, 1})});
    REQUIRE(pieces.size() == 5);
    CHECK(areaOf(pieces) == doctest::Approx(16).epsilon(1e-12));
    CHECK(areaOf(pieces.back()) == doctest::Approx(2).epsilon(1e-12));
    CHECK((flow::centroidOf(pieces.back()) - Vec3(1.5, 2, 0)).norm() < 1e-12);
}

TEST_CASE("pieces: a box that misses, holds or only touches a polygon leaves it whole") {
    for (const auto& [low, high] : {std::pair(Vec3(5, 0, -1), Vec3(6, 4, 1)),
                                    {Vec3(1, 1, 1), Vec3(2, 2, 2)},
                                    {Vec3(-1, -1, -1), Vec3(5, 5, 1)},
                                    {Vec3(0, 0, 0), Vec3(4, 4, 0)}}) {
        const auto pieces = piecesOf(kSquare, {boxed(low, high)});
        REQUIRE(pieces.size() == 1);
        CHECK(pieces[0] == kSquare);
    }
    CHECK(piecesOf(kSquare, {FlowBoundary{}}).size() == 1);  // no box
    FlowBoundary other = boxed({1, 1, -1}, {2, 3, 1});
    other.joints = {1};
    CHECK(piecesOf(kSquare, {other}).size() == 1);
}

TEST_CASE("pieces: a box without a width is a line of the mesh") {
    const auto pieces = piecesOf(kSquare, {boxed({1, -1, -1}, {1, 5, 1})});
    REQUIRE(pieces.size() == 2);
    CHECK(areaOf(pieces[0]) == doctest::Approx(4).epsilon(1e-12));
    CHECK(areaOf(pieces[1]) == doctest::Approx(12).epsilon(1e-12));
}

TEST_CASE("pieces: they cover the polygon, whatever the boxes, and lie on one side of each") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> between(-0.5, 4.5);
    for (int draw = 0; draw < 300; ++draw) {
        std::vector<FlowBoundary> boxes;
        for (int k = 0; k < 2; ++k) {
            const Vec3 a(between(random), between(random), -1), b(between(random), between(random), 1);
            boxes.push_back(boxed(a.cwiseMin(b), a.cwiseMax(b)));
        }
        const Ring triangle{{0, 0, 0}, {4, 1, 0.5}, {1, 4, -0.5}};
        const auto pieces = piecesOf(triangle, boxes);
        CHECK(areaOf(pieces) == doctest::Approx(areaOf(triangle)).epsilon(1e-9));
        for (const Ring& piece : pieces)
            for (const FlowBoundary& box : boxes) {
                const Vec3 middle = flow::centroidOf(piece);
                const bool inside = (middle.array() > box.box_min.array()).all() &&
                                    (middle.array() < box.box_max.array()).all();
                for (const Vec3& x : piece)
                    if (inside)
                        CHECK(((x - box.box_min).minCoeff() > -1e-9 && (box.box_max - x).minCoeff() > -1e-9));
            }
    }
}

TEST_CASE("pieces: only corners of an outline inside the polygon draw the mesh together") {
    const auto corners = [](const FlowBoundary& boundary) {
        return flow::cornersInside(kSquare, 0, std::array{boundary}, Vec3::Zero(), kSame);
    };
    const auto all = corners(boxed({1, 1, -1}, {2, 3, 1}));
    REQUIRE(all.size() == 4);
    for (const auto& corner : all) CHECK(corner.side == doctest::Approx(1).epsilon(1e-12));
    CHECK(corners(boxed({1, 3, -1}, {2, 5, 1})).size() == 2);
    CHECK(corners(boxed({1, -1, -1}, {2, 5, 1})).empty());  // a strip: flow is straight
    CHECK(corners(boxed({1, 1, -1}, {1, 3, 1})).empty());   // no width
    FlowBoundary face = boxed({1, 1, -1}, {2, 3, 1});
    face.face = Vec3::UnitX();
    CHECK(corners(face).empty());
}
