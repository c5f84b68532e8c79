// The face of a slope in cells, and where a failure lies on it.

#include "batch/face_cells.h"

#include <doctest/doctest.h>

#include "batch/failure_on_face.h"
#include "support/models.h"

namespace talus::tools::batch {

using namespace talus::test;

namespace {

/// 10 m wide along y. A face of 45 degrees from (0, 0) to (6, 6), ground before it, level ground above it.
TriangleSurface slope() {
    return *extrudeProfile({{-4, -2}, {12, -2}, {12, 6}, {6, 6}, {0, 0}, {-4, 0}}, 0, 10);
}

double areaLooking(const Face& face, const Vec3& way) {
    double area = 0;
    for (const FaceCell& cell : face.cells)
        if (cell.normal.dot(way.normalized()) > 1 - 1e-9) area += cell.area;
    return area;
}

std::vector<std::size_t> allFree(const Model& model) {
    std::vector<std::size_t> blocks;
    for (std::size_t b = 0; b < model.blocks.size(); ++b)
        if (model.blocks[b].motion == Motion::free) blocks.push_back(b);
    return blocks;
}

double integral(const FailureOnFace& failure, const Face& face) {
    double sum = 0;
    for (const auto& share : failure.cells) sum += share.volume_per_area * face.cells[share.cell].area;
    return sum;
}

}  // namespace

TEST_CASE("the face of a profile: face and level ground, without base and the sides it was cut off at") {
    const auto face = divideFace(slope(), 0.5);
    REQUIRE(face.has_value());
    CHECK(areaLooking(*face, {-1, 0, 1}) == doctest::Approx(10 * 6 * std::sqrt(2)).epsilon(1e-12));
    CHECK(areaLooking(*face, {0, 0, 1}) == doctest::Approx(10 * (4 + 6)).epsilon(1e-12));
    CHECK(areaLooking(*face, {-1, 0, 0}) == doctest::Approx(10 * 2).epsilon(1e-12));  // looks the slope's way
    for (const Vec3& way : {Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
        CHECK(areaLooking(*face, way) == 0);
    CHECK(face->area == doctest::Approx(60 * std::sqrt(2) + 120).epsilon(1e-12));
    REQUIRE(face->outlook.has_value());
    CHECK((*face->outlook - Vec3(-1, 0, 0)).norm() < 1e-12);
}

TEST_CASE("cells are as large as asked, whole at the ends, and each centre lies in its cell") {
    const auto face = divideFace(slope(), 1.0);
    REQUIRE(face.has_value());
    for (const FaceCell& cell : face->cells) CHECK(cell.pieces.size() == 1);  // whole rectangles
    std::size_t on_face = 0;
    for (const FaceCell& cell : face->cells) {
        double area = 0;
        for (const auto& piece : cell.pieces)
            for (std::size_t k = 2; k < piece.size(); ++k)
                area += 0.5 * (piece[k - 1] - piece[0]).cross(piece[k] - piece[0]).dot(cell.normal);
        CHECK(area == doctest::Approx(cell.area).epsilon(1e-9));
        if (cell.normal.x() > -0.5) continue;
        if (cell.normal.z() < 0.5) continue;
        ++on_face;
        CHECK(cell.area == doctest::Approx(6 * std::sqrt(2) / 8).epsilon(1e-9));  // 8 rows of 8.49 m
        CHECK(std::abs(cell.centre.x() - cell.centre.z()) < 1e-12);
    }
    CHECK(on_face == 8 * 10);
}

TEST_CASE("a box has no slope: all its sides are faces, and its base is none") {
    const auto face = divideFace(*boxSurface({0, 0, 0}, {2, 3, 4}), 1.0);
    REQUIRE(face.has_value());
    CHECK(!face->outlook.has_value());
    CHECK(face->area == doctest::Approx(2 * 3 + 2 * 4 * (2 + 3)));
}

TEST_CASE("a vertical face with ground before it stays a face") {
    const auto face =
        divideFace(*extrudeProfile({{-4, -2}, {12, -2}, {12, 6}, {0, 5}, {0, 0}, {-4, 0}}, 0, 10), 1.0);
    REQUIRE(face.has_value());
    CHECK(areaLooking(*face, {-1, 0, 0}) == doctest::Approx(10 * 5 + 10 * 2));
}

TEST_CASE("the default makes some 2,000 cells of a round size, and too many are refused") {
    const auto face = divideFace(slope(), std::nullopt);
    REQUIRE(face.has_value());
    CHECK(face->cell_size == 0.5);
    CHECK(face->cells.size() > 800);
    CHECK(face->cells.size() < 5000);
    CHECK(!divideFace(slope(), 1e-3).has_value());
}

TEST_CASE("the volume of a failure is that of its cells; blocks behind others show on the face before them") {
    // Two slabs of 2 m x 10 m x 6 m, one behind the other, and a floor; what is free is 2 sides and the top.
    Model model = floorModel(30);
    addBox(model, "front", {0, 0, 0}, {2, 10, 6});
    addBox(model, "back", {2, 0, 0}, {2, 10, 6});
    TriangleSurface region = *boxSurface({0, 0, 0}, {4, 10, 6});
    const auto face = divideFace(region, 1.0);
    REQUIRE(face.has_value());
    const FaceIndex index(*face);
    const FailureOnFace both = index.failureOf(model, allFree(model));
    CHECK(both.cells.size() == face->cells.size());
    CHECK(both.volume == doctest::Approx(240));
    CHECK(both.hidden_volume == 0);
    CHECK(integral(both, *face) == doctest::Approx(240).epsilon(1e-12));
    const FailureOnFace front = index.failureOf(model, {1});
    CHECK(integral(front, *face) == doctest::Approx(120).epsilon(1e-12));
    for (const auto& share : front.cells) {
        CHECK(face->cells[share.cell].centre.x() < 2);
        // Its free area: front, half of the top, half of both ends.
        CHECK(share.volume_per_area == doctest::Approx(120.0 / (60 + 20 + 2 * 12)).epsilon(1e-12));
    }
}

TEST_CASE("blocks without a cell share their volume with those of the failure, or are counted apart") {
    Model model = floorModel(30);
    addBox(model, "seen", {0, 0, 0}, {1, 1, 1});
    addBox(model, "inside", {10, 10, -10}, {1, 1, 1});  // nowhere near the face
    const auto face = divideFace(*boxSurface({0, 0, 0}, {2, 2, 1}), 0.25);
    REQUIRE(face.has_value());
    const FaceIndex index(*face);
    const FailureOnFace both = index.failureOf(model, {1, 2});
    CHECK(both.volume == doctest::Approx(2));
    CHECK(both.hidden_volume == 0);
    CHECK(integral(both, *face) == doctest::Approx(2).epsilon(1e-12));
    const FailureOnFace hidden = index.failureOf(model, {2});
    CHECK(hidden.cells.empty());
    CHECK(hidden.hidden_volume == doctest::Approx(1));
}

}  // namespace talus::tools::batch
