#include "contacts/face_pairs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/random_shapes.h"

using namespace talus;
using namespace talus::test;

namespace {

const FacePairLimits kLimits{.max_gap = 1e-3, .max_overlap = 1e-3, .max_angle = 1e-3};

std::vector<FacePair> facePairs(const Polyhedron& a, const Polyhedron& b,
                                const FacePairLimits& limits = kLimits) {
    const Placed in_a(a), in_b(b);
    return findFacePairs(in_a.world(), in_b.world(), limits);
}

constexpr int kBottom = 4, kTop = 5;  // faces of makeBox
const Polyhedron kBrick = box({0, 0, 0}, {0.2, 0.1, 0.1});

Polyhedron shifted(const Polyhedron& shape, double x, double y, double z) {
    return moved(shape, Mat3::Identity(), {x, y, z});
}

Vec3 patchCentroid(const FacePair& pair, const Polyhedron& a) {
    return faceFrame(a, pair.face_a).toWorld(centroid(pair.patch));
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE("a face's frame: right-handed, outward, along the first edge") {
        Random random(61);
        for (int trial = 0; trial < 20; ++trial) {
            const Polyhedron shape =
                moved(randomPolyhedron(random, 10), random.rotation(), random.inBox(100));
            for (std::size_t f = 0; f < shape.faces.size(); ++f) {
                const FaceFrame frame = faceFrame(shape, f);
                Mat3 axes;
                axes << frame.e1, frame.e2, frame.e3;
                CHECK((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-12);
                CHECK(axes.determinant() > 0);
                CHECK((frame.e3 - shape.faceNormal(f)).norm() == 0);
                const auto& outline = shape.faces[f];
                const Vec3 edge = shape.vertices[outline[1]] - shape.vertices[outline[0]];
                CHECK(frame.e1.dot(edge) == within(1e-9, edge.norm()));
                CHECK((frame.toWorld(frame.toPlane(shape.vertices[outline[2]])) - shape.vertices[outline[2]])
                          .norm() < 1e-5);
                CHECK(frame.height(frame.origin + 2 * frame.e3) == within(1e-13, 2));
            }
        }
    }

    TEST_CASE("two bricks, one on the other: one pair, the whole face, no gap") {
        const Polyhedron upper = shifted(kBrick, 0, 0, 0.1);
        const auto pairs = facePairs(kBrick, upper);
        REQUIRE(pairs.size() == 1);
        CHECK(pairs[0].face_a == kTop);
        CHECK(pairs[0].face_b == kBottom);
        CHECK(pairs[0].patch.size() == 4);
        CHECK(area(pairs[0].patch) == within(1e-13, 0.02));
        CHECK(std::abs(pairs[0].gap) < 1e-15);
        CHECK((patchCentroid(pairs[0], kBrick) - Vec3(0.1, 0.05, 0.1)).norm() < 1e-15);
    }

    TEST_CASE("half a block further") {
        const Polyhedron upper = shifted(kBrick, 0.1, 0, 0.1);
        const auto pairs = facePairs(kBrick, upper);
        REQUIRE(pairs.size() == 1);
        CHECK(pairs[0].patch.size() == 4);
        CHECK(area(pairs[0].patch) == within(1e-13, 0.01));
        CHECK((patchCentroid(pairs[0], kBrick) - Vec3(0.15, 0.05, 0.1)).norm() < 1e-15);
    }

    TEST_CASE("crossed at right angles: the square they share") {
        const Mat3 quarter = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
        const Polyhedron crossed = moved(kBrick, quarter, {0.15, -0.05, 0.1});
        const auto pairs = facePairs(kBrick, crossed);
        REQUIRE(pairs.size() == 1);
        CHECK(pairs[0].patch.size() == 4);
        CHECK(area(pairs[0].patch) == within(1e-12, 0.01));
        CHECK((patchCentroid(pairs[0], kBrick) - Vec3(0.1, 0.05, 0.1)).norm() < 1e-14);
    }

    TEST_CASE("crossed at 45 degrees: six or eight corners, the area of the clipped outlines") {
        const Mat3 turn = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitZ()).toRotationMatrix();
        const Polyhedron square = box({-1, -1, -1}, {1, 1, 0});
        const auto pairs = facePairs(square, moved(box({-1, -1, 0}, {1, 1, 1}), turn, Vec3::Zero()));
        REQUIRE(pairs.size() == 1);
        CHECK(pairs[0].patch.size() == 8);
        CHECK(area(pairs[0].patch) == within(1e-12, 8 * std::tan(std::numbers::pi / 8)));
    }

    TEST_CASE("T: a beam across a column, then beside it") {
        const Polyhedron column = box({0, 0, 0}, {0.1, 0.1, 0.5}),
                         beam = box({-0.3, 0, 0.5}, {0.4, 0.1, 0.6});
        const auto on = facePairs(column, beam);
        REQUIRE(on.size() == 1);
        CHECK(area(on[0].patch) == within(1e-12, 0.01));
        const Polyhedron wall = box({0.1, -0.4, -0.2}, {0.2, 0.5, 0.3});
        const auto beside = facePairs(column, wall);
        REQUIRE(beside.size() == 1);
        CHECK(beside[0].face_a == 1);
        CHECK(beside[0].face_b == 0);
        CHECK(area(beside[0].patch) == within(1e-12, 0.1 * 0.3));
    }

    TEST_CASE("the patch is the same place whichever face gives it its frame") {
        const Polyhedron floor = box({-1, -1, -0.1}, {1, 1, 0});
        const auto pairs = facePairs(kBrick, floor), swapped = facePairs(floor, kBrick);
        REQUIRE(pairs.size() == 1);
        REQUIRE(swapped.size() == 1);
        for (const double found : {area(pairs[0].patch), area(swapped[0].patch)})
            CHECK(found == within(1e-12, 0.02));
        CHECK((patchCentroid(pairs[0], kBrick) - Vec3(0.1, 0.05, 0)).norm() < 1e-14);
        CHECK((patchCentroid(swapped[0], floor) - Vec3(0.1, 0.05, 0)).norm() < 1e-14);
    }

    TEST_CASE("gap and overlap limits, with the sign of the gap") {
        for (const double gap : {-0.9e-3, -1e-4, 0.0, 1e-4, 0.9e-3}) {
            const auto pairs = facePairs(kBrick, shifted(kBrick, 0.02, 0.01, 0.1 + gap));
            REQUIRE(pairs.size() == 1);
            CHECK(pairs[0].gap == within(1e-10, gap));
            const auto swapped = facePairs(shifted(kBrick, 0, 0, 0.1 + gap), kBrick);
            REQUIRE(swapped.size() == 1);
            CHECK(swapped[0].gap == within(1e-10, gap));
        }
        CHECK(facePairs(kBrick, shifted(kBrick, 0, 0, 0.1 + 1.1e-3)).empty());
        CHECK(facePairs(kBrick, shifted(kBrick, 0, 0, 0.1 - 1.1e-3)).empty());
    }

    TEST_CASE("a wedge of a gap: its middle, its least and its most; the least one counts") {
        // Turned about the edge x = 0 of the lower brick's top, then lifted.
        const double angle = 5e-4, lift = 2e-4;
        const Mat3 turn = Eigen::AngleAxisd(-angle, Vec3::UnitY()).toRotationMatrix();
        const Polyhedron upper = moved(kBrick, turn, {0, 0, 0.1 + lift});
        const auto pairs = facePairs(kBrick, upper);
        REQUIRE(pairs.size() == 1);
        CHECK(pairs[0].gap == within(1e-6, lift + 0.1 * std::tan(angle)));
        CHECK(pairs[0].least_gap == within(1e-6, lift));
        CHECK(pairs[0].most_gap == within(1e-6, lift + 0.2 * std::tan(angle)));

        const auto count = [&](double max_gap, double max_overlap, double max_angle) {
            const FacePairLimits limits{
                .max_gap = max_gap, .max_overlap = max_overlap, .max_angle = max_angle};
            return facePairs(kBrick, upper, limits).size();
        };
        CHECK(count(1.01 * lift, 0, 1e-3) == 1);
        CHECK(count(0.99 * lift, 0, 1e-3) == 0);
        CHECK(count(1e-3, 0, 1.01 * angle) == 1);
        CHECK(count(1e-3, 0, 0.99 * angle) == 0);

        const Polyhedron sunk = shifted(upper, 0, 0, -2 * lift);
        const auto overlap = [&](double max_overlap) {
            const FacePairLimits limits{.max_gap = 1e-3, .max_overlap = max_overlap, .max_angle = 1e-3};
            return facePairs(kBrick, sunk, limits).size();
        };
        CHECK(overlap(1.01 * lift) == 1);
        CHECK(overlap(0.99 * lift) == 0);
    }

    TEST_CASE("blocks that touch along an edge or at a corner only have no pair") {
        CHECK(facePairs(kBrick, shifted(kBrick, 0.2, 0, 0.1)).empty());
        CHECK(facePairs(kBrick, shifted(kBrick, 0.2, 0.1, 0.1)).empty());
        CHECK(facePairs(kBrick, shifted(kBrick, 0.2 * (1 - 0.9e-6), 0, 0.1)).empty());
        CHECK(facePairs(kBrick, shifted(kBrick, 0.2 * (1 - 1e-4), 0, 0.1)).size() == 1);
        CHECK(facePairs(kBrick, shifted(kBrick, 0.5, 0, 0)).empty());
    }

    TEST_CASE("hexagonal prisms: full faces at their sides, shared outlines on their tops") {
        const double radius = 0.1, apothem = radius * std::sqrt(0.75);
        const Polyhedron hexagon = prism(6, radius, 0.3);
        const double hexagon_area = 1.5 * std::sqrt(3.0) * radius * radius;
        for (int side = 0; side < 6; ++side) {
            const double angle = std::numbers::pi * (2 * side + 1) / 6;
            const Polyhedron next =
                shifted(hexagon, 2 * apothem * std::cos(angle), 2 * apothem * std::sin(angle), 0);
            const auto pairs = facePairs(hexagon, next);
            REQUIRE(pairs.size() == 1);
            CHECK(pairs[0].patch.size() == 4);
            CHECK(area(pairs[0].patch) == within(1e-9, radius * 0.3));
        }
        const auto on = facePairs(hexagon, shifted(hexagon, 0, 0, 0.3));
        REQUIRE(on.size() == 1);
        CHECK(on[0].patch.size() == 6);
        CHECK(area(on[0].patch) == within(1e-9, hexagon_area));
        const Mat3 turn = Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitZ()).toRotationMatrix();
        const auto turned = facePairs(hexagon, moved(hexagon, turn, {0, 0, 0.3}));
        REQUIRE(turned.size() == 1);
        CHECK(turned[0].patch.size() == 12);
        CHECK(area(turned[0].patch) ==
              within(1e-9, 12 * apothem * apothem * std::tan(std::numbers::pi / 12)));
    }

    TEST_CASE("the same pairs in every orientation and far from the origin") {
        Random random(63);
        const Polyhedron upper = shifted(kBrick, 0.07, 0.03, 0.1);
        for (int trial = 0; trial < 100; ++trial) {
            const Mat3 r = random.rotation();
            const Vec3 shift = random.inBox(1000);
            const auto pairs = facePairs(moved(kBrick, r, shift), moved(upper, r, shift));
            REQUIRE(pairs.size() == 1);
            CHECK(pairs[0].patch.size() == 4);
            CHECK(area(pairs[0].patch) == within(1e-10, 0.13 * 0.07));
            CHECK(std::abs(pairs[0].gap) < 1e-12);
        }
    }

    TEST_CASE("faces farther from parallel than their overlap allows are left out, and no others") {
        Random random(68);
        std::size_t kept = 0, left_out = 0;
        for (int trial = 0; trial < 60; ++trial) {
            CAPTURE(trial);
            const Polyhedron a = moved(randomPolyhedron(random, 9), random.rotation(), random.inBox(0.6)),
                             b = moved(randomPolyhedron(random, 9), random.rotation(), random.inBox(0.6));
            FacePairLimits limits{.max_gap = 0.1, .max_overlap = 0.5, .max_angle = 0.8};
            std::vector<FacePair> expected = facePairs(a, b, limits);
            limits.touching_angle = 0.2;
            limits.angle_per_depth = 1.5;
            limits.size = 0.9;
            const std::size_t all = expected.size();
            std::erase_if(expected, [&](const FacePair& pair) {
                const double chord = (a.faceNormal(static_cast<std::size_t>(pair.face_a)) +
                                      b.faceNormal(static_cast<std::size_t>(pair.face_b)))
                                         .norm();
                const double angle = 0.2 + 1.5 * std::max(0.0, -pair.least_gap) / 0.9;
                return chord > 2 * std::sin(0.5 * std::min(angle, 0.8));
            });
            const std::vector<FacePair> found = facePairs(a, b, limits);
            REQUIRE(found.size() == expected.size());
            for (std::size_t k = 0; k < found.size(); ++k) {
                CHECK(found[k].face_a == expected[k].face_a);
                CHECK(found[k].face_b == expected[k].face_b);
                CHECK(found[k].least_gap == expected[k].least_gap);
            }
            kept += expected.size();
            left_out += all - expected.size();
        }
        CHECK(kept > 20);
        CHECK(left_out > 30);
    }
}
