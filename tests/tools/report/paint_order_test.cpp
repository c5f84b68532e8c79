// Painting in order: what is painted last at a point is what is nearest there.

#include "report/paint_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/blocks_files.h"
#include "report/visible_faces.h"
#include "support/bodies.h"
#include "support/properties.h"
#include "support/terrains.h"
#include "talus/formats/scenario.h"
#include "talus/surface.h"

using namespace talus;
using namespace talus::tools;

namespace {

/// Height of a polygon's plane above a point of the picture, when that lies well inside it.
std::optional<double> heightAt(const PaintedPolygon& polygon, double x, double y) {
    const auto& corners = polygon.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
        const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
        if ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()) < 1e-5 * length)
            return std::nullopt;
    }
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        normal += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    return corners[0].z() -
           (normal.x() * (x - corners[0].x()) + normal.y() * (y - corners[0].y())) / normal.z();
}

PaintedPolygon drawnTriangle(double size) {
    const auto corner = [&] {
        const Vec3 middle(*test::numberIn(0, 1), *test::numberIn(0, 1), *test::numberIn(0, 1));
        return middle;
    };
    const Vec3 a = corner();
    const auto near = [&] { return Vec3(a + size * (corner() - Vec3::Constant(0.5))); };
    PaintedPolygon triangle{{a, near(), near()}, {Side::rim, Side::joint, Side::crease}, 0};
    const Vec3 normal = (triangle.corners[1] - a).cross(triangle.corners[2] - a);
    if (normal.z() < 0) std::swap(triangle.corners[1], triangle.corners[2]);
    return triangle;
}

double areaOf(const PaintedPolygon& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k)
        sum += (polygon.corners[k] - polygon.corners[0]).cross(polygon.corners[k + 1] - polygon.corners[0]);
    return 0.5 * sum.norm();
}

bool looksAtReader(const PaintedPolygon& triangle) {
    const Vec3 normal =
        (triangle.corners[1] - triangle.corners[0]).cross(triangle.corners[2] - triangle.corners[0]);
    return normal.z() > 1e-3 * normal.norm() && normal.norm() > 1e-4;
}

}  // namespace

TEST_SUITE("paint order") {
    TEST_CASE(
        "triangles at random, which also go through each other: the nearest is painted last, and all of each "
        "is painted") {
        for (const auto& many : {std::pair{12, 1.5}, std::pair{150, 0.4}}) {
            const auto count = many.first;
            const auto size = many.second;
            CAPTURE(count);
            test::checkProperty("order of triangles", 20, [count, size] {
                std::vector<PaintedPolygon> drawn;
                std::vector<double> area;
                for (int k = 0; k < count; ++k) {
                    PaintedPolygon triangle = drawnTriangle(size);
                    if (!looksAtReader(triangle)) continue;
                    triangle.source = drawn.size();
                    area.push_back(areaOf(triangle));
                    drawn.push_back(std::move(triangle));
                }
                const auto painted = paintOrder(drawn);
                std::vector<double> painted_area(drawn.size(), 0);
                for (const PaintedPolygon& piece : painted) {
                    RC_ASSERT(piece.sides.size() == piece.corners.size());
                    painted_area[piece.source] += areaOf(piece);
                }
                for (std::size_t k = 0; k < drawn.size(); ++k)
                    RC_ASSERT(std::abs(painted_area[k] - area[k]) < 1e-4);
                for (int i = 0; i < 40; ++i) {
                    const double x = 0.013 + 0.97 * i / 40, y = 0.017 + 0.97 * ((7 * i) % 40) / 40;
                    double nearest = -1e300, last = -1e300;
                    for (const PaintedPolygon& polygon : drawn)
                        if (const auto height = heightAt(polygon, x, y)) nearest = std::max(nearest, *height);
                    for (const PaintedPolygon& piece : painted)
                        if (const auto height = heightAt(piece, x, y)) last = *height;
                    if (nearest > -1e300 && last > -1e300) RC_ASSERT(last > nearest - 1e-3);
                }
            });
        }
    }

    TEST_CASE("a picture of blocks has what explains it, and no edges between parts of one body") {
        const auto scenario = formats::parseScenario(
            "[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness "
            "= "
            "1e10\nfriction_deg = 30.0\n[[block]]\nname = \"floor\"\nfixed = true\nbox = { min = [-1, -1, "
            "-1], max = [3, "
            "3, 0] }\n[[block]]\nname = \"angle\"\nparts = [{ box = { min = [0, 0, 0], max = [2, 1, 0.5] } "
            "}, { box = { "
            "min = [0, 0, 0.5], max = [0.5, 1, 2] } }]\n[[water]]\nblock = \"angle\"\nface = \"-x\"\ndepth = "
            "0.3\n",
            "angle.toml");
        REQUIRE(scenario.ok());
        const std::string svg = blocksSvg(scenario->model, {4.1, 0.44}, "angle");
        for (const char* what : {">N</text>", ">angle</text>", ">free</text>", ">fixed</text>",
                                 "class=\"joint\"", "class=\"water\"", "class=\"bar\""})
            CHECK_MESSAGE(svg.find(what) != std::string::npos, what);
        CHECK(svg.find("nan") == std::string::npos);
        // The angle's side to the south is two rectangles in one plane that meet on a quarter of one's
        // length.
        const VisibleFaces visible = visibleFaces(scenario->model, Camera({3.14159265, 0.1}));
        double drawn = 0, left_out = 0;
        for (const PaintedPolygon& polygon : visible.polygons) {
            const VisibleFace& face = visible.faces[polygon.source];
            if (scenario->model.blocks[face.block].name != "angle" || face.normal.y() > -0.9) continue;
            for (std::size_t k = 0; k < polygon.sides.size(); ++k) {
                const Vec3& next = polygon.corners[(k + 1) % polygon.corners.size()];
                (polygon.sides[k] == Side::none ? left_out : drawn) += (next - polygon.corners[k]).norm();
            }
        }
        CHECK(drawn == doctest::Approx(8.0));     // around the L
        CHECK(left_out == doctest::Approx(1.0));  // half a metre of each
    }

    TEST_CASE("an edge that another part of its body covers is drawn as far as it comes out of it") {
        for (const double out : {0.1, 0.3, 0.7}) {  // of a beam that lies on a slab
            CAPTURE(out);
            const auto scenario = formats::parseScenario(
                "[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = "
                "1e10\nshear_stiffness = 1e10\nfriction_deg = 30.0\n[[block]]\nname = \"beam\"\nfixed = "
                "true\nparts = [{ box = { min = [0, 0, 0], max = [2, 1, 0.5] } }, { box = { min = [-" +
                    std::to_string(out) + ", 0.2, 0.5], max = [0.9, 0.8, 2] } }]\n",
                "beam.toml");
            REQUIRE(scenario.ok());
            const VisibleFaces visible =
                visibleFaces(scenario->model, Camera({3.14159265, -1.5707}));  // from below
            double drawn = 0, left_out = 0;
            for (const PaintedPolygon& polygon : visible.polygons) {
                const VisibleFace& face = visible.faces[polygon.source];
                if (face.normal.z() > -0.9 ||
                    scenario->model.blocks[0].shape.faceCentroid(face.face).z() < 0.4)
                    continue;
                for (std::size_t k = 0; k < polygon.sides.size(); ++k) {
                    const Vec3& next = polygon.corners[(k + 1) % polygon.corners.size()];
                    (polygon.sides[k] == Side::none ? left_out : drawn) += (next - polygon.corners[k]).norm();
                }
            }
            // Of the beam's underside: its end and as much of two edges as is out; the rest lies on the slab.
            CHECK(drawn == doctest::Approx(2 * out + 0.6).epsilon(0.01));
            CHECK(left_out == doctest::Approx(2 * 0.9 + 0.6).epsilon(0.01));
        }
    }

    TEST_CASE("pictures of rough ground have no holes, and no joints where none are") {
        constexpr int kSquares = 6;
        constexpr double kPlan = 4.0 * kSquares * kSquares;  // squares of 2 m
        for (const test::Ground ground : test::kGrounds)
            for (const bool jointed : {false, true}) {
                CAPTURE(static_cast<int>(ground));
                CAPTURE(jointed);
                RockMass rock;
                rock.region = closeTerrain(test::terrainOf(ground, kSquares), -4)->surface;
                if (jointed) {
                    JointSet set;
                    set.dip = 1.3;
                    set.dip_direction = 0.4;
                    set.spacing = 3;
                    rock.sets.push_back(set);
                }
                const CutRockMass cut = *cutRockMass(rock);
                Model model = test::floorModel(30);
                model.blocks.clear();
                for (const CutBlock& block : cut.blocks) test::addBody(model, "b", block.shape);
                const VisibleFaces visible = visibleFaces(model, Camera({0, 1.5707963}));  // from above
                double painted = 0;
                bool joints = false;
                for (const PaintedPolygon& polygon : visible.polygons) {
                    for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k)
                        painted += 0.5 * (polygon.corners[k] - polygon.corners[0])
                                             .cross(polygon.corners[k + 1] - polygon.corners[0])
                                             .z();
                    joints =
                        joints || std::count(polygon.sides.begin(), polygon.sides.end(), Side::joint) > 0;
                }
                CHECK(painted >= kPlan * (1 - 1e-9));
                CHECK(joints == jointed);
            }
    }
}
