// Faults of surfaces, and surfaces from profiles; regions of any shape keep their volume.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "talus/rock_mass.h"

namespace talus {

namespace {

TriangleSurface cube() { return *boxSurface(Vec3::Zero(), Vec3::Ones()); }

void checkFault(const TriangleSurface& surface, const std::string& field, const std::string& fragment) {
    const auto errors = checkSurface(surface);
    REQUIRE_FALSE(errors.empty());
    CHECK(errors[0].field.find(field) == 0);
    CHECK_MESSAGE(errors[0].message.find(fragment) != std::string::npos, errors[0].message, " lacks ",
                  fragment);
}

/// A ground that goes up and down over n x n squares, and its mirror below: many reflex edges.
TriangleSurface terrain(int n, double roughness, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<> height(2 - roughness, 2 + roughness);
    TriangleSurface surface;
    for (const int top : {0, 1})
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j) surface.vertices.emplace_back(i, j, top ? height(random) : 0.0);
    const auto id = [&](int top, int i, int j) { return (top * (n + 1) + i) * (n + 1) + j; };
    const auto quad = [&](int a, int b, int c, int d) {
        surface.triangles.push_back({a, b, c});
        surface.triangles.push_back({a, c, d});
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            quad(id(1, i, j), id(1, i + 1, j), id(1, i + 1, j + 1), id(1, i, j + 1));
            quad(id(0, i, j), id(0, i, j + 1), id(0, i + 1, j + 1), id(0, i + 1, j));
        }
        quad(id(0, i, 0), id(0, i + 1, 0), id(1, i + 1, 0), id(1, i, 0));
        quad(id(0, i + 1, n), id(0, i, n), id(1, i, n), id(1, i + 1, n));
        quad(id(0, 0, i + 1), id(0, 0, i), id(1, 0, i), id(1, 0, i + 1));
        quad(id(0, n, i), id(0, n, i + 1), id(1, n, i + 1), id(1, n, i));
    }
    return surface;
}

RockMass jointed(TriangleSurface region, double spacing) {
    RockMass rock;
    rock.region = std::move(region);
    const double degree = 3.14159265358979323846 / 180;
    for (const auto& [dip, direction] :
         {std::pair(20.0, 270.0), std::pair(75.0, 80.0), std::pair(85.0, 0.0)}) {
        JointSet set;
        set.dip = dip * degree;
        set.dip_direction = direction * degree;
        set.spacing = spacing;
        rock.sets.push_back(set);
    }
    return rock;
}

}  // namespace

TEST_CASE("surfaces: closed ones are good, and have their volume") {
    CHECK(checkSurface(cube()).empty());
    CHECK(surfaceVolume(cube()) == doctest::Approx(1).epsilon(1e-15));
    CHECK(checkSurface(terrain(4, 0.5, 1)).empty());
}

TEST_CASE("surfaces: open, non-manifold, turned and inverted ones are distinguished") {
    TriangleSurface open = cube();
    open.triangles.erase(open.triangles.begin() + 3);
    checkFault(open, "triangles[", "open surface");

    TriangleSurface doubled = cube();
    doubled.triangles.push_back(doubled.triangles[0]);
    checkFault(doubled, "triangles[", "non-manifold");

    TriangleSurface turned = cube();
    std::swap(turned.triangles[5][0], turned.triangles[5][1]);
    checkFault(turned, "triangles[", "opposite ways");

    TriangleSurface inverted = cube();
    for (auto& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
    checkFault(inverted, "", "faces inwards (volume -1");

    TriangleSurface flat = cube();
    flat.vertices.push_back({0.5, 0, 0});
    flat.triangles.push_back({0, 4, 8});
    checkFault(flat, "triangles[12]", "without area");

    TriangleSurface beyond = cube();
    beyond.triangles[2][1] = 8;
    checkFault(beyond, "triangles[2]", "found vertex 8, allowed: 0 to 7");
    checkFault({}, "", "no triangles");
}

TEST_CASE("surfaces: a surface that crosses itself is refused") {
    // Two boxes through each other: each is closed, together they are no region.
    TriangleSurface crossing = cube();
    const TriangleSurface other = *boxSurface({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
    for (const auto& triangle : other.triangles)
        crossing.triangles.push_back({triangle[0] + 8, triangle[1] + 8, triangle[2] + 8});
    crossing.vertices.insert(crossing.vertices.end(), other.vertices.begin(), other.vertices.end());
    RockMass rock;
    rock.region = crossing;
    const auto cut = cutRockMass(rock);
    REQUIRE_FALSE(cut.ok());
    CHECK(cut.errors()[0].field.find("rock_mass.region.triangles[") == 0);
    CHECK(cut.errors()[0].message.find("crosses itself") != std::string::npos);
}

TEST_CASE("profiles: either sense of rotation, corners on straight sides, deep notches") {
    using Profile = std::vector<Eigen::Vector2d>;
    const Profile notched = {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {2.5, 0.2},
                             {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}};
    double area = 0;
    for (std::size_t i = 0; i < notched.size(); ++i) {
        const auto &a = notched[i], &b = notched[(i + 1) % notched.size()];
        area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    Profile turned(notched.rbegin(), notched.rend());
    for (const Profile& profile : {notched, turned}) {
        const auto surface = extrudeProfile(profile, -1, 1);
        REQUIRE(surface.ok());
        CHECK(checkSurface(*surface).empty());
        CHECK(surfaceVolume(*surface) == doctest::Approx(2 * area).epsilon(1e-14));
        RockMass rock;
        rock.region = *surface;
        const auto cut = cutRockMass(rock);
        REQUIRE(cut.ok());
        CHECK(cut->blocks.size() == 1);
        CHECK(cut->volume == doctest::Approx(2 * area).epsilon(1e-13));
    }
}

TEST_CASE("profiles: faults name their point") {
    const auto fault = [](const std::vector<Eigen::Vector2d>& profile) {
        const auto surface = extrudeProfile(profile, 0, 1);
        REQUIRE_FALSE(surface.ok());
        return surface.errors()[0].field + ": " + surface.errors()[0].message;
    };
    CHECK(fault({{0, 0}, {1, 0}}).find(": found 2 points") == 0);
    CHECK(fault({{0, 0}, {1, 1}, {1, 0}, {0, 1}})
              .find("[2]: found a side that meets the one behind point [0]") == 0);
    CHECK(fault({{0, 0}, {1, 0}, {1, 0}, {0, 1}}).find("[2]: found the point of [1] again") == 0);
    CHECK(fault({{0, 0}, {2, 0}, {1, 0}, {1, 1}}).find("[1]: found a profile that turns back") == 0);
    CHECK(extrudeProfile({{0, 0}, {1, 0}, {0, 1}}, 1, 1).errors()[0].field == "y");
}

TEST_CASE("regions: any ground, cut or not, keeps its volume to 1e-12, in bodies of several parts") {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        CAPTURE(seed);
        const TriangleSurface ground = terrain(5, 0.8, seed);
        const double volume = surfaceVolume(ground);
        RockMass whole;
        whole.region = ground;
        const auto uncut = cutRockMass(whole);
        REQUIRE(uncut.ok());
        CHECK(uncut->blocks.size() == 1);
        CHECK(std::abs(uncut->volume - volume) < 1e-12 * volume);
        const auto cut = cutRockMass(jointed(ground, 0.7));
        REQUIRE(cut.ok());
        CHECK(std::abs(cut->volume - volume) < 1e-12 * volume);
        CHECK(cut->blocks.size() > 200);
        std::size_t parts = 0;
        for (const CutBlock& block : cut->blocks) parts += block.shape.partCount();
        CHECK(cut->blocks.size() < parts);
    }
}

TEST_CASE("regions: coordinates rounded to seven digits still make plane faces") {
    TriangleSurface turned = *extrudeProfile({{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, 0, 1);
    const double c = std::cos(0.3), s = std::sin(0.3);
    for (Vec3& v : turned.vertices) {
        const Vec3 x(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z() + 0.37 * v.x());
        for (Eigen::Index i = 0; i < 3; ++i) v[i] = static_cast<double>(static_cast<float>(x[i] + 1.1));
    }
    RockMass rock;
    rock.region = turned;
    const auto cut = cutRockMass(rock);
    REQUIRE(cut.ok());
    REQUIRE(cut->blocks.size() == 1);
    CHECK(cut->blocks[0].shape.partCount() == 2);
    CHECK(cut->volume == doctest::Approx(surfaceVolume(turned)).epsilon(1e-5));
}

}  // namespace talus
