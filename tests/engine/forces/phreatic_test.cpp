#include "forces/phreatic.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "build/build.h"
#include "forces/sum.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Turned and pushed together, so that no face is along an axis.
Model underWater(std::vector<PhreaticSurface::Point> line, double factor = 1) {
    Model model = floorModel(30);
    model.blocks[0].shape = *makeBox({-5, -5, -9}, {20, 5, -8});
    addTurnedCube(model, "cube", turnAbout({1, 2, 3}, 40), 1, 0, 0.0, 1.0);
    addTurnedCube(model, "other", turnAbout({-1, 1, 2}, 70), 4, 1, 0.0, 1.5);
    model.phreatic = PhreaticSurface{.line = std::move(line), .factor = factor, .field = "water[0]"};
    return model;
}

/// A line extruded along y, as triangles.
TriangleSurface over(const std::vector<PhreaticSurface::Point>& line) {
    TriangleSurface mesh;
    for (const auto& point : line)
        for (const double y : {-30.0, 1.3, 30.0}) mesh.vertices.emplace_back(point.x, y, point.z);
    for (std::int32_t k = 0; k + 1 < static_cast<std::int32_t>(line.size()); ++k)
        for (const std::int32_t row : {0, 1}) {
            const std::int32_t a = 3 * k + row, b = a + 1, c = a + 3, d = a + 4;
            mesh.triangles.push_back({a, c, d});
            mesh.triangles.push_back({a, d, b});
        }
    return mesh;
}

Wrench on(const State& state, std::size_t block) { return outsideForcesOn(state, block); }

State wet(const Model& model) {
    State state = *buildState(model, false);
    updateBlockForces(state);
    return state;
}

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE(
        "below a level surface the net force is buoyancy, at the centroid, however it is split into strips") {
        for (const double factor : {1.0, 0.6})
            for (const auto& line : {std::vector<PhreaticSurface::Point>{{-10, 5}, {20, 5}},
                                     {{-10, 5}, {0.7, 5}, {1.1, 5}, {4.2, 5}, {20, 5}},
                                     {{1.0, 5}, {1.2, 5}}}) {
                const State state = wet(underWater(line, factor));
                for (const std::size_t block : {1U, 2U}) {
                    const double buoyancy = factor * 1000 * 9.81 * (block == 1 ? 1.0 : 1.5 * 1.5 * 1.5);
                    CHECK((on(state, block).force - Vec3(0, 0, buoyancy)).norm() < 1e-9 * buoyancy);
                    CHECK(on(state, block).torque.norm() < 1e-9 * buoyancy);
                }
            }
    }

    TEST_CASE(
        "a sloping surface pushes the submerged downhill: minus the gradient of pressure times volume") {
        const State state = wet(underWater({{-10, 3}, {20, 9}}));
        const double slope = 6.0 / 30;
        CHECK((on(state, 1).force - 9810 * Vec3(-slope, 0, 1)).norm() < 1e-6);
        CHECK(on(state, 1).torque.norm() < 1e-6);
    }

    TEST_CASE("cubes anywhere below, across and above a bent surface: the pressure's sum over their faces") {
        const std::vector<PhreaticSurface::Point> line{{-4, 1}, {-1, 2.5}, {0.5, 1.8}, {3, 4}};
        const auto depth = [&](const Vec3& x) {
            if (x.x() <= line.front().x) return line.front().z - x.z();
            std::size_t k = 1;
            while (k < line.size() && x.x() > line[k].x) ++k;
            if (k == line.size()) return line.back().z - x.z();
            const double share = (x.x() - line[k - 1].x) / (line[k].x - line[k - 1].x);
            return std::lerp(line[k - 1].z, line[k].z, share) - x.z();
        };
        std::mt19937 random(7);
        std::uniform_real_distribution<double> any(-1, 1);
        Model model = floorModel(30);
        model.blocks[0].shape = *makeBox({-99, -5, -19}, {99, 5, -18});
        for (int k = 0; k < 20; ++k) {
            const Vec3 axis{any(random), any(random), any(random)};
            const double angle = 180 * any(random), x = 6 * any(random), height = 6 * any(random) - 1;
            addTurnedCube(model, "cube" + std::to_string(k), turnAbout(axis, angle), x, 8 * k, height,
                          std::pow(10, 0.5 * any(random)));
        }
        model.phreatic = PhreaticSurface{.line = line, .field = "water[0]"};
        const State state = wet(model);
        int dry = 0, below = 0, across = 0;
        for (std::size_t b = 1; b < state.blocks.size(); ++b) {
            CAPTURE(b);
            const Polyhedron& shape = state.geometry->shape[b];
            const Mat3 turn = state.blocks.orientation.matrix(b);
            const Vec3 centre = state.blocks.position.get(b);
            Wrench sum;
            double most = 0, least = kInfinity;
            for (std::size_t f = 0; f < shape.faces.size(); ++f) {
                const auto corner = [&](std::size_t k) -> Vec3 {
                    return centre + turn * shape.vertices[static_cast<std::size_t>(shape.faces[f][k])];
                };
                const Vec3 along = corner(1) - corner(0), up = corner(3) - corner(0);
                constexpr int kParts = 60;
                const Vec3 inwards = -along.cross(up) / (kParts * kParts);
                for (int part = 0; part < kParts * kParts; ++part) {
                    const int row = part / kParts, column = part % kParts;
                    const Vec3 x = corner(0) + (column + 0.5) / kParts * along + (row + 0.5) / kParts * up;
                    const double p = 9810 * depth(x + state.geometry->origin);
                    most = std::max(most, p);
                    least = std::min(least, p);
                    if (p <= 0) continue;
                    sum.force += p * inwards;
                    sum.torque += (x - centre).cross(p * inwards);
                }
            }
            ++(most <= 0 ? dry : least >= 0 ? below : across);
            const double side = std::cbrt(massProperties(shape).volume),
                         scale = std::max(most, 1.0) * side * side;
            CHECK((on(state, b).force - sum.force).norm() < 1e-3 * scale);
            CHECK((on(state, b).torque - sum.torque).norm() < 1e-3 * scale * side);
            CHECK((most > 0 || on(state, b).force == Vec3::Zero()));
        }
        CHECK(std::min({dry, below, across}) >= 3);
    }

    TEST_CASE(
        "depth is measured along gravity: tilted, a submerged block feels g turned, from the same line") {
        Model model = underWater({{-10, 4}, {20, 4}});
        State state = wet(model);
        state.load.tilt = radians(15);
        updateBlockForces(state);
        // The line stays level in the model, so the gradient is along its normal: unit weight over cos(tilt),
        // up.
        CHECK((on(state, 1).force - 9810 / std::cos(radians(15)) * Vec3::UnitZ()).norm() < 1e-6);
    }

    TEST_CASE(
        "a body of several parts is pressed as one: an L below a sloping surface, and half out of a level "
        "one") {
        const Polyhedron foot = *makeBox({0, 0, 0}, {3, 1, 1}), leg = *makeBox({0, 0, 1}, {1, 1, 4});
        for (const bool is_turned : {false, true}) {
            Model model = floorModel(30);
            model.blocks[0].shape = *makeBox({-5, -5, -9}, {20, 5, -8});
            Block& body = model.blocks.emplace_back(box("L", {0, 0, 0}, {1, 1, 1}));
            body.shape = *joinParts({foot, leg});
            const Eigen::Quaterniond turn =
                is_turned ? turnAbout({1, 2, 3}, 40) : Eigen::Quaterniond::Identity();
            for (Vec3& v : body.shape.vertices) v = turn * v;
            body.face_joint.assign(body.shape.faces.size(), 0);
            model.phreatic = PhreaticSurface{.line = {{-20, 18}, {20, 26}}, .field = "water[0]"};
            CHECK((on(wet(model), 1).force - 6 * 9810 * Vec3(-0.2, 0, 1)).norm() < 1e-5);
            CHECK(on(wet(model), 1).torque.norm() < 1e-5);
            if (is_turned) continue;
            model.phreatic->line = {{-20, 2}, {20, 2}};  // 3 m3 of the foot and 1 m3 of the leg
            CHECK((on(wet(model), 1).force - 4 * 9810 * Vec3::UnitZ()).norm() < 1e-5);
        }
    }

    TEST_CASE("a box half below: thrust of each face, exactly; dry above") {
        Model model = floorModel(30);
        addBox(model, "box", {0, 0, 0}, {2, 1, 3});
        addBox(model, "dry", {3, 0, 2.5}, {1, 1, 1});
        model.phreatic = PhreaticSurface{.line = {{-1, 2}, {1, 2}, {1.5, 1}, {9, 1}}, .field = "water[0]"};
        const State state = wet(model);
        CHECK(on(state, 2).force == Vec3::Zero());
        // Left 2 m deep, right 1 m; uplift on the base: depths 2 to x = 1, falling to 1 at 1.5, 1 to x = 2.
        // The two other faces are each other's mirror image.
        const double g = 9810, uplift = g * (2.0 * 1.0 + 1.5 * 0.5 + 1.0 * 0.5);
        CHECK((on(state, 1).force - Vec3(g * (0.5 * 4 - 0.5 * 1), 0, uplift)).norm() < 1e-6);
        const double about_edge = g * (1.0 + 11.0 / 12 + 0.875);  // of the uplift, of its three parts
        const Vec3 centroid(1, 0.5, 1.5);
        const Vec3 torque = on(state, 1).torque + centroid.cross(on(state, 1).force);
        // About y: thrusts at a third of their depths turn by z F, uplift by -x F.
        const double expected = g * (0.5 * 4 * 2.0 / 3 - 0.5 / 3) - about_edge;
        CHECK(torque.y() == doctest::Approx(expected).epsilon(1e-9));
    }

    TEST_CASE("a joint that opens wider than the surface allows runs dry on both sides, for good") {
        Model model = floorModel(30);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1});
        model.phreatic =
            PhreaticSurface{.line = {{-9, 5}, {9, 5}}, .drains_at_aperture = 1e-3, .field = "water[0]"};
        State state = wet(model);
        CHECK(on(state, 1).force.z() == doctest::Approx(9810));
        state.blocks.position.set(1, state.blocks.position.get(1) + Vec3(0, 0, 2e-3));
        lookAtBlockForces(state);
        updateBlockForces(state);
        CHECK(on(state, 1).force.z() == doctest::Approx(-9810 * (4 - 2e-3)));  // its top alone
        state.blocks.position.set(1, state.blocks.position.get(1) - Vec3(0, 0, 2e-3));
        lookAtBlockForces(state);
        updateBlockForces(state);
        CHECK(on(state, 1).force.z() == doctest::Approx(-9810 * 4));
    }

    TEST_CASE("another water acts in place of the water table where it stands") {
        Model model = floorModel(30);
        addBox(model, "box", {0, 0, 0}, {2, 1, 3});
        model.phreatic = PhreaticSurface{.line = {{-9, 2}, {9, 2}}, .field = "water[0]"};
        CHECK((on(wet(model), 1).force - 9810 * Vec3(0, 0, 4)).norm() < 1e-6);
        // Uplift of its own below the box: heads of 1 m at +x and 0.5 m at -x.
        Water uplift;
        uplift.kind = Water::Level::head;
        uplift.head = {1.0, 0.5};
        uplift.pair = std::pair{0, 1};
        uplift.field = "water[1]";
        model.waters = {uplift};
        const State state = wet(model);
        CHECK((on(state, 1).force - 9810 * Vec3(0, 0, 0.75 * 2)).norm() < 1e-6);
        // And in place of 2 m on its +x face a depth of 1 m.
        Water side;
        side.level = {{0, 1.0}};
        side.walls = {{1, 0}};
        side.field = "water[2]";
        const Polyhedron& shape = model.blocks[1].shape;
        for (std::size_t f = 0; f < shape.faces.size(); ++f)
            if (shape.faceNormal(f).x() > 0.9) side.walls[0].face = static_cast<std::int32_t>(f);
        model.waters.push_back(side);
        CHECK((on(wet(model), 1).force - 9810 * Vec3(0.5 * 4 - 0.5, 0, 1.5)).norm() < 1e-6);
    }

    TEST_CASE("a mesh: buoyancy below a level one, and what a line gives below the same ridge extruded") {
        const std::vector<PhreaticSurface::Point> ridge{
            {-20, 2.5}, {0.6, 4.2}, {1.3, 5.0}, {4.4, 3.1}, {30, 6}};
        for (const bool level : {true, false})
            for (const double tilt : {0.0, 12.0}) {
                CAPTURE(level);
                CAPTURE(tilt);
                const auto line = level ? std::vector<PhreaticSurface::Point>{{-20, 5}, {30, 5}} : ridge;
                Model by_line = underWater(line, 0.7), by_mesh = by_line;
                by_line.gravity.tilt = by_mesh.gravity.tilt = radians(tilt);
                by_mesh.phreatic->line.clear();
                by_mesh.phreatic->mesh = over(line);
                const State a = wet(by_line), b = wet(by_mesh);
                for (const std::size_t block : {1U, 2U}) {
                    const double size = on(a, block).force.norm();
                    CHECK(size > 1000);
                    CHECK((on(a, block).force - on(b, block).force).norm() < 1e-9 * size);
                    CHECK((on(a, block).torque - on(b, block).torque).norm() < 1e-9 * size);
                }
            }
    }

    TEST_CASE("faces in the planes of a mesh's edges, and below its rim, are pressed once") {
        Model model = floorModel(30);
        model.blocks[0].shape = *makeBox({-5, -5, -9}, {20, 5, -8});
        addBox(model, "box", {0, 0, 0},
               {1, 1, 1});  // as wide as the mesh, and cut by its diagonal and middle
        model.phreatic = PhreaticSurface{.line = {}, .field = "water[0]"};
        TriangleSurface& mesh = model.phreatic->mesh;
        for (const double y : {0.0, 1.0})
            for (const double x : {0.0, 0.5, 1.0}) mesh.vertices.emplace_back(x, y, 3.0);
        mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
        CHECK((on(wet(model), 1).force - Vec3(0, 0, 9810)).norm() < 1e-6);
        CHECK(on(wet(model), 1).torque.norm() < 1e-6);
        // Two boxes side by side, their faces in the plane of the middle edge.
        model.blocks.pop_back();
        addBox(model, "left", {0, 0, 0}, {0.5, 1, 1});
        addBox(model, "right", {0.5, 0, 0}, {0.5, 1, 1});
        for (const std::size_t block : {1U, 2U})
            CHECK((on(wet(model), block).force - Vec3(0, 0, 4905)).norm() < 1e-6);
    }

    TEST_CASE("a mesh that does not reach over all free blocks, or folds back along gravity, is refused") {
        Model model = underWater({});
        model.phreatic->mesh = over({{-20, 5}, {4.0, 5}});
        const auto small = buildState(model, false).errors();
        REQUIRE(small.size() == 1);
        CHECK(small[0].field == "water[0].obj");
        CHECK(small[0].message.find("does not cover block \"other\"") == 0);
        model.phreatic->mesh = over({{-20, 5}, {0, 5}, {0.5, 30}, {30, 30}});
        CHECK(buildState(model, false).ok());
        model.gravity.tilt = radians(60);
        const auto folded = buildState(model, false).errors();
        REQUIRE(folded.size() == 1);
        CHECK(folded[0].message.find("folds back") != std::string::npos);
    }

    TEST_CASE("a line that folds back when it is seen along gravity is refused") {
        Model model = underWater({{0, 0}, {1, 4}, {5, 4}});
        model.gravity.tilt = radians(60);
        const auto errors = buildState(model, false).errors();
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == "water[0].surface");
    }
}
