// Surfaces with faults of one kind each: mended they are what they were before.

#include "talus/mend_surface.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/terrains.h"

namespace talus {

namespace {

using namespace talus::test;

TriangleSurface box() { return *boxSurface({0, 0, 0}, {2, 1, 1}); }

MendLimits closingHolesUpTo(double width) {
    MendLimits limits;
    limits.largest_hole = width;
    return limits;
}

}  // namespace

TEST_CASE("mend: a sound surface stays as it is") {
    const MendedSurface mended = mendSurface(box(), closingHolesUpTo(10));
    CHECK_FALSE(mended.changed());
    CHECK(mended.surface.triangles == box().triangles);
    for (std::size_t t = 0; t < mended.source.size(); ++t) CHECK(mended.source[t] == t);
}

TEST_CASE("mend: any one triangle of a box that lacks, is doubled or turned over") {
    for (std::size_t t = 0; t < 12; ++t) {
        TriangleSurface lacks = box(), doubled = box(), turned = box();
        lacks.triangles.erase(lacks.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        doubled.triangles.push_back(doubled.triangles[t]);
        std::swap(doubled.triangles.back()[1], doubled.triangles.back()[2]);
        std::swap(turned.triangles[t][0], turned.triangles[t][1]);
        const MendedSurface closed = mendSurface(lacks, closingHolesUpTo(2));
        CHECK(closed.closed.size() == 1);
        CHECK(closed.closed[0].edges == 3);
        CHECK(closed.source.back() == MendedSurface::kMade);
        CHECK(mendSurface(doubled, {}).doubled.size() == 1);
        CHECK(mendSurface(turned, {}).turned.size() == 1);
        for (const MendedSurface& mended : {closed, mendSurface(doubled, {}), mendSurface(turned, {})}) {
            CHECK(checkSurface(mended.surface).empty());
            CHECK(surfaceVolume(mended.surface) == doctest::Approx(2).epsilon(1e-14));
        }
        const MendedSurface open = mendSurface(lacks, closingHolesUpTo(0.5));
        CHECK(open.closed.empty());
        REQUIRE(open.too_wide.size() == 1);
        CHECK(open.too_wide[0].width >= 1);
    }
}

TEST_CASE("mend: a box that faces inwards, and one whose lid is missing") {
    TriangleSurface inverted = box();
    for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
    const MendedSurface outwards = mendSurface(inverted, {});
    CHECK(outwards.turned.size() == 12);
    CHECK(surfaceVolume(outwards.surface) == doctest::Approx(2).epsilon(1e-14));

    TriangleSurface open = box();
    std::erase_if(open.triangles, [&](const auto& t) {
        return std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
            return open.vertices[static_cast<std::size_t>(v)].z() == 1;
        });
    });
    REQUIRE(open.triangles.size() == 10);
    const MendedSurface closed = mendSurface(open, closingHolesUpTo(2));
    REQUIRE(closed.closed.size() == 1);
    CHECK(closed.closed[0].edges == 4);
    CHECK(closed.closed[0].width == 2);
    CHECK(closed.closed[0].middle == Vec3(1, 0.5, 1));
    CHECK(checkSurface(closed.surface).empty());
}

TEST_CASE("mend: a terrain keeps its rim; two holes that meet in a point are two") {
    constexpr int kN = 8;
    TriangleSurface s = terrainOf(Ground::hill, kN);
    const std::size_t whole = s.triangles.size();
    for (const std::size_t square : {4 * kN + 4, 3 * kN + 3}) {  // from the back
        const auto first = s.triangles.begin() + static_cast<std::ptrdiff_t>(2 * square);
        s.triangles.erase(first, first + 2);
    }
    MendLimits limits = closingHolesUpTo(3);
    limits.keeps_rim = true;
    const MendedSurface mended = mendSurface(s, limits);
    CHECK(mended.closed.size() == 2);
    CHECK(mended.too_wide.empty());
    CHECK(mended.surface.triangles.size() == whole);
    CHECK(closeTerrain(mended.surface, -5).ok());
    limits.keeps_rim = false;
    CHECK(mendSurface(s, limits).too_wide.size() == 1);  // the rim
}

TEST_CASE("mend: a T-junction behind a doubled triangle is divided, too") {
    // On the diagonal of a square the upper right side has a corner more than the doubled lower left one.
    const TriangleSurface s{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}},
                            {{0, 1, 3}, {0, 1, 3}, {1, 2, 4}, {4, 2, 3}}};
    MendLimits limits;
    limits.tolerance = 1e-6;
    limits.keeps_rim = true;
    const MendedSurface mended = mendSurface(s, limits);
    CHECK(mended.doubled.size() == 1);
    CHECK(mended.surface.triangles.size() == 4);
    CHECK(closeTerrain(mended.surface, -1).ok());
}

}  // namespace talus
