// Terrains are closed whatever their form; each kind of damage is refused with its place, or repaired as far
// as it may be.

#include <doctest/doctest.h>

#include <algorithm>

#include "support/properties.h"
#include "support/terrains.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr int kN = 8;  // 16 x 16 m

/// Exactly one fault, at this triangle, with all of these words.
void checkRefused(const TriangleSurface& terrain, const std::string& field,
                  const std::vector<std::string>& words, double base = -5) {
    const auto closed = closeTerrain(terrain, base);
    REQUIRE_FALSE(closed.ok());
    CHECK(closed.errors().size() == 1);
    const Error& error = closed.errors()[0];
    CHECK(error.field == field);
    for (const std::string& word : words)
        CHECK_MESSAGE(error.message.find(word) != std::string::npos, error.message, " lacks ", word);
}

std::string place(const Vec3& v) {
    const auto text = [](double value) {
        std::string all = std::to_string(value);
        while (all.back() == '0') all.pop_back();
        if (all.back() == '.') all.pop_back();
        return all;
    };
    return "(" + text(v.x()) + ", " + text(v.y()) + ", ";
}

std::string field(std::size_t triangle) { return "triangles[" + std::to_string(triangle) + "]"; }

/// Triangle around the point 0.3 m beside a grid point.
std::size_t triangleNear(const TriangleSurface& surface, std::size_t vertex) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        if (surface.triangles[t][0] == static_cast<std::int32_t>(vertex)) return t;
    return surface.triangles.size();
}

}  // namespace

TEST_CASE("terrains: closed by sides and base, their volume that of the columns below") {
    for (const Ground ground : kGrounds) {
        const TriangleSurface terrain = terrainOf(ground, kN);
        double columns = 0;
        for (const auto& t : terrain.triangles)
            for (const std::int32_t v : t)  // every triangle is 2 m2 in plan
                columns += 2.0 / 3 * (terrain.vertices[static_cast<std::size_t>(v)].z() + 5);
        TriangleSurface turned = terrain;
        for (auto& t : turned.triangles) std::swap(t[1], t[2]);
        for (const TriangleSurface& each : {terrain, turned}) {
            const auto closed = closeTerrain(each, -5);
            REQUIRE(closed.ok());
            CHECK(closed->turned == (&each != &terrain && each.triangles[0] == turned.triangles[0]));
            CHECK(checkSurface(closed->surface).empty());
            CHECK(surfaceVolume(closed->surface) == doctest::Approx(columns).epsilon(1e-13));
        }
    }
}

TEST_CASE("terrains: each kind of damage is refused with its place, on every ground") {
    for (const Ground ground : kGrounds) {
        const TriangleSurface good = terrainOf(ground, kN);
        const std::size_t v = vertexAt(good, 6, 10), t = triangleNear(good, v);
        CAPTURE(static_cast<int>(ground));

        TriangleSurface hole = good;
        hole.triangles.erase(hole.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        const auto closed = closeTerrain(hole, -5);
        REQUIRE_FALSE(closed.ok());
        CHECK(closed.errors()[0].message.find("found a hole with 3 edges about (") == 0);
        CHECK(closed.errors()[0].message.find("from " + place(good.vertices[v])) != std::string::npos);

        TriangleSurface flipped = good;
        std::swap(flipped.triangles[t][1], flipped.triangles[t][2]);
        TriangleSurface beside = good;  // a point pulled out through the side
        beside.vertices[v] = Vec3(-3, 10.3, -4.5);
        const auto outside = closeTerrain(beside, -5);
        REQUIRE_FALSE(outside.ok());
        CHECK(std::any_of(outside.errors().begin(), outside.errors().end(), [](const Error& error) {
            return error.message.find("the side or base below the terrain's rim") != std::string::npos;
        }));

        checkRefused(flipped, field(t), {"opposite ways along the edge from ", place(good.vertices[v])});

        TriangleSurface three = good;  // a fin on an inner edge
        three.vertices.push_back(good.vertices[v] + Vec3(1, 0.2, 3));
        three.triangles.push_back(
            {good.triangles[t][0], good.triangles[t][1], static_cast<std::int32_t>(good.vertices.size())});
        const auto fin = closeTerrain(three, -5);
        REQUIRE_FALSE(fin.ok());
        CHECK(fin.errors()[0].message.find("found a non-manifold surface: the edge from ") == 0);
        CHECK(fin.errors()[0].message.find("has 3 triangles") != std::string::npos);

        TriangleSurface through = good;  // one point pulled down through base
        through.vertices[v].z() = -9;
        checkRefused(
            through, "base",
            {"found -5, allowed: below the terrain, whose lowest point is ", place(good.vertices[v])});

        TriangleSurface crossing = good;  // a pocket below the ground, and a pit that goes down into it
        crossing.vertices[v] += Vec3(5.2, 0.3, -0.9);
        crossing.vertices[vertexAt(good, 12, 10)].z() -= 6;
        const auto crossed = closeTerrain(crossing, -5);
        REQUIRE_FALSE(crossed.ok());
        CHECK(crossed.errors()[0].message.find(
                  "found a surface that crosses itself: this triangle and triangles[") == 0);
        CHECK(crossed.errors()[0].message.find("meet near (") != std::string::npos);

        TriangleSurface island = good;
        const auto first = static_cast<std::int32_t>(island.vertices.size());
        for (const Vec3& corner : {Vec3(30, 1, 1), Vec3(31, 1, 1), Vec3(30, 2, 1)})
            island.vertices.push_back(corner);
        island.triangles.push_back({first, first + 1, first + 2});
        checkRefused(island, field(good.triangles.size()),
                     {"found a second piece of terrain", "near (30, 1, 1)"});

        TriangleSurface pinched = good;  // two triangles of a corner's square gone, and the next but one
        const std::size_t corner = vertexAt(good, 2, 2);
        std::erase_if(pinched.triangles, [&](const auto& each) {
            const auto& x = [&](std::size_t k) -> const Vec3& {
                return good.vertices[static_cast<std::size_t>(each[k])];
            };
            const Vec3 middle = (x(0) + x(1) + x(2)) / 3;
            return (middle.x() < 2) != (middle.y() < 2) && middle.x() < 4 && middle.y() < 4;
        });
        const auto pinch = closeTerrain(pinched, -5);
        REQUIRE_FALSE(pinch.ok());
        CHECK(pinch.errors()[0].message.find("connected only by a point, at " +
                                             place(good.vertices[corner])) != std::string::npos);
    }
    checkRefused(*boxSurface(Vec3::Zero(), Vec3::Ones()), "", {"found a closed surface with a base"});
    checkRefused({}, "", {"found no triangles"});
}

TEST_CASE(
    "repair: duplicates and T-junctions within the tolerance give the volume of the sound surface, others "
    "are refused") {
    for (const Ground ground : kGrounds) {
        const TriangleSurface good = terrainOf(ground, kN);
        const double volume = surfaceVolume(closeTerrain(good, -5)->surface);
        // Every triangle with corners of its own, each moved by less than half the tolerance.
        TriangleSurface soup;
        std::mt19937_64 random(5);
        std::uniform_real_distribution<> little(-2e-4, 2e-4);
        for (const auto& t : good.triangles) {
            const auto first = static_cast<std::int32_t>(soup.vertices.size());
            for (const std::int32_t v : t)
                soup.vertices.push_back(good.vertices[static_cast<std::size_t>(v)] +
                                        Vec3(little(random), little(random), little(random)));
            soup.triangles.push_back({first, first + 1, first + 2});
        }
        CHECK_FALSE(closeTerrain(soup, -5).ok());
        const SurfaceRepair repaired = repairSurface(soup, 1e-3);
        CHECK(repaired.merged == soup.vertices.size() - good.vertices.size());
        CHECK(repaired.split + repaired.dropped == 0);
        CHECK(repaired.surface.vertices.size() == good.vertices.size());
        const auto closed = closeTerrain(repaired.surface, -5);
        REQUIRE(closed.ok());
        CHECK(surfaceVolume(closed->surface) == doctest::Approx(volume).epsilon(1e-4));
        CHECK_FALSE(closeTerrain(repairSurface(soup, 1e-5).surface, -5).ok());

        // One triangle's edge divided, 3e-4 beside its line: its neighbour knows nothing of it.
        TriangleSurface divided = good;
        const std::size_t t = triangleNear(good, vertexAt(good, 6, 10));
        const auto [a, b, c] = good.triangles[t];
        const auto middle = static_cast<std::int32_t>(good.vertices.size());
        divided.vertices.push_back(
            0.5 * (good.vertices[static_cast<std::size_t>(a)] + good.vertices[static_cast<std::size_t>(b)]) +
            Vec3(0, 0, 3e-4));
        divided.triangles[t] = {a, middle, c};
        divided.triangles.push_back({middle, b, c});
        CHECK_FALSE(closeTerrain(divided, -5).ok());
        const SurfaceRepair split = repairSurface(divided, 1e-3);
        CHECK(split.split == 1);
        CHECK(split.source.size() == split.surface.triangles.size());
        CHECK((split.place - divided.vertices.back()).norm() < 1e-12);
        CHECK(closeTerrain(split.surface, -5).ok());
        CHECK(repairSurface(divided, 1e-4).split == 0);
        // The same with a triangle without a width in between.
        divided.triangles.push_back({a, b, middle});
        const SurfaceRepair narrow = repairSurface(divided, 1e-3);
        CHECK(narrow.dropped == 1);
        CHECK(closeTerrain(narrow.surface, -5).ok());
        CHECK_FALSE(repairSurface(good, 1e-3).changed());
    }
}

TEST_CASE(
    "property: a sound closed surface crosses itself nowhere, one pulled through itself somewhere near the "
    "pull") {
    checkProperty("crossing", 40, [] {
        const int n = 6;
        TriangleSurface terrain =
            terrainOf(*rc::gen::elementOf(std::vector<Ground>(std::begin(kGrounds), std::end(kGrounds))), n);
        const double angle = *numberIn(0, 6.28);
        for (Vec3& v : terrain.vertices)
            v.head<2>() = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(v.head<2>());
        auto closed = closeTerrain(terrain, -5);
        RC_ASSERT(closed.ok());
        const auto v =
            static_cast<std::size_t>((n + 1) * *rc::gen::inRange(2, n - 1) + *rc::gen::inRange(2, n - 1));
        const double down = *numberIn(5.5, 12);  // through the base
        closed->surface.vertices[v].z() = -down;
        const auto errors = checkSurface(closed->surface);
        RC_ASSERT(!errors.empty());
        RC_ASSERT(errors[0].message.find("crosses itself") != std::string::npos);
    });
}
