// Shapes of several convex parts: what is inside, what is surface, and integrals over the whole.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geometry/parts.h"
#include "support/bodies.h"

using namespace talus;
using namespace talus::test;

namespace {

/// About the origin, of a box: closed form [m^5].
Mat3 inertiaOfBox(const Vec3& min, const Vec3& max) {
    const Vec3 size = max - min, centre = 0.5 * (min + max);
    const double volume = size.prod();
    const Vec3 second = volume / 12.0 * size.cwiseProduct(size);
    Mat3 moments = second.asDiagonal();
    moments += volume * centre * centre.transpose();
    return moments.trace() * Mat3::Identity() - moments;
}

/// Against the sum over boxes, by the parallel axis theorem.
void checkProperties(const std::vector<Corners>& boxes) {
    const Polyhedron shape = bodyOf(boxes);
    double volume = 0;
    Vec3 first = Vec3::Zero();
    Mat3 about_origin = Mat3::Zero();
    for (const auto& [min, max] : boxes) {
        const double own = (max - min).prod();
        volume += own;
        first += own * 0.5 * (min + max);
        about_origin += inertiaOfBox(min, max);
    }
    const Vec3 centroid = first / volume;
    const Mat3 inertia =
        about_origin - volume * (centroid.squaredNorm() * Mat3::Identity() - centroid * centroid.transpose());
    const MassProperties found = massProperties(shape);
    CHECK(found.volume == doctest::Approx(volume).epsilon(1e-13));
    CHECK((found.centroid - centroid).norm() < 1e-13);
    CHECK((found.inertia - inertia).norm() < 1e-12 * inertia.norm());
}

std::size_t count(const Polyhedron& shape, Cover cover) {
    const auto& covers = shape.faces.covers();
    return static_cast<std::size_t>(std::count(covers.begin(), covers.end(), cover));
}

double surfaceOf(const Polyhedron& shape) {
    double sum = 0;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        sum += shape.faceArea(f);
        for (const Polygon& cover : coversOf(shape, f)) sum -= area(cover);
    }
    return sum;
}

}  // namespace

TEST_CASE("parts: mass, centroid and inertia of an angle, a channel and a cross in closed form") {
    for (const auto& boxes : {angle(), channel(), cross()}) checkProperties(boxes);
}

TEST_CASE("parts: faces that lie on other parts wholly are inside, others are covered as far as they do") {
    const Polyhedron shape = bodyOf(angle());  // an upright on one end of a foot
    CHECK(shape.partCount() == 2);
    CHECK(count(shape, Cover::wholly) == 1);  // the upright's base
    CHECK(count(shape, Cover::partly) == 1);  // the foot's top
    // Of 1.0 x 0.4 x 0.2 and 0.2 x 0.4 x 0.6, less twice what they share.
    CHECK(surfaceOf(shape) == doctest::Approx(2 * (0.4 + 0.08 + 0.2) + 2 * (0.08 + 0.24 + 0.12) - 2 * 0.08));
    const Polyhedron five = bodyOf(cross());
    CHECK(five.partCount() == 5);
    CHECK(count(five, Cover::wholly) == 8);
    CHECK(surfaceOf(five) == doctest::Approx(2 * 5 * 0.04 + 12 * 0.04));
}

TEST_CASE("parts: a box in eight parts is the box") {
    const Polyhedron whole = *makeBox({0, 0, 0}, {1, 0.6, 0.4}), eight = inEight({0, 0, 0}, {1, 0.6, 0.4});
    const MassProperties a = massProperties(whole), b = massProperties(eight);
    CHECK(b.volume == doctest::Approx(a.volume).epsilon(1e-14));
    CHECK((a.centroid - b.centroid).norm() < 1e-14);
    CHECK((a.inertia - b.inertia).norm() < 1e-14);
    CHECK(smallestExtent(eight) == doctest::Approx(0.4).epsilon(1e-14));
    CHECK(count(eight, Cover::wholly) == 24);
    CHECK(count(eight, Cover::partly) == 0);
    CHECK(sideTowards(eight, Vec3::UnitZ()).size() == 4);
    CHECK(sideTowards(whole, Vec3::UnitZ()).size() == 1);
    for (const std::int32_t face : sideTowards(eight, Vec3::UnitX()))
        CHECK(eight.faceCentroid(static_cast<std::size_t>(face)).x() == doctest::Approx(1));
}

TEST_CASE("parts: an angle of thin plates is as thin as they are, a thick one as its box") {
    const double t = 0.01;
    CHECK(smallestExtent(bodyOf({{{0, 0, 0}, {1, 1, t}}, {{0, 0, t}, {t, 1, 1}}})) < 3.1 * t);
    CHECK(smallestExtent(bodyOf(angle())) <= 0.4);
}

TEST_CASE("parts: what is in the body, and which corners another body can touch") {
    const Polyhedron shape = bodyOf(angle());
    CHECK(contains(shape, {0.1, 0.2, 0.7}));
    CHECK(contains(shape, {0.9, 0.2, 0.1}));
    CHECK_FALSE(contains(shape, {0.9, 0.2, 0.7}));
    const std::vector<FacePlane> planes = facePlanes(shape);
    const PartOfBody foot{shape, planes, 0, Mat3::Identity(), Vec3::Zero(), 1e-9},
        upright{shape, planes, 1, Mat3::Identity(), Vec3::Zero(), 1e-9};
    const Vec3 up = Vec3::UnitZ(), right = Vec3::UnitX();
    // The reflex edge, from either part, in any direction.
    for (const Vec3& direction : {up, right, Vec3((up + right).normalized()), Vec3(-up)}) {
        const bool of_foot = foot.isOutermost({0.2, 0.1, 0.2}, direction),
                   of_upright = upright.isOutermost({0.2, 0.1, 0.2}, direction);
        const bool can_be_touched = of_foot && of_upright;
        CHECK_FALSE(can_be_touched);
    }
    CHECK(foot.isOutermost({1.0, 0.1, 0.2}, (up + right).normalized()));
    CHECK(upright.isOutermost({0.2, 0.1, 0.8}, (up + right).normalized()));
    // Behind, the upright goes on flat above the foot: an edge of both parts and none of the body.
    CHECK_FALSE(foot.isOutermost({0, 0.1, 0.2}, (up - right).normalized()));
    CHECK(foot.isOutermost({0, 0.1, 0.2}, -right));
    CHECK(foot.goesOnFlat({0, 0.1, 0.2}, up, -right));
    CHECK_FALSE(foot.goesOnFlat({0.2, 0.1, 0.2}, -right, up));  // where the upright stands it rises
    CHECK_FALSE(foot.goesOnFlat({1.0, 0.1, 0.2}, right, up));
    CHECK(foot.isInOther({0.1, 0.2, 0.2}));
    CHECK_FALSE(foot.isInOther({0.5, 0.2, 0.2}));
}

TEST_CASE("parts: what is no body is refused") {
    const auto fault = [](const std::vector<Corners>& boxes) {
        std::vector<Polyhedron> parts;
        for (const auto& [min, max] : boxes) parts.push_back(*makeBox(min, max));
        const auto joined = joinParts(parts);
        REQUIRE_FALSE(joined.ok());
        return joined.errors()[0].field + ": " + joined.errors()[0].message;
    };
    CHECK(fault({}).find("found no parts") != std::string::npos);
    CHECK(fault({{{0, 0, 0}, {1, 1, 1}}, {{0.5, 0, 0}, {2, 1, 1}}})
              .find("[1]: found a part that overlaps part 0") == 0);
    CHECK(fault({{{0, 0, 0}, {1, 1, 1}}, {{1.1, 0, 0}, {2, 1, 1}}})
              .find("[1]: found a part that shares no face") == 0);
    // An edge in common is no face.
    CHECK(fault({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 1}, {2, 1, 2}}}).find("shares no face") !=
          std::string::npos);
    CHECK_FALSE(joinParts({bodyOf(angle()), *makeBox({5, 0, 0}, {6, 1, 1})}).ok());
}

TEST_CASE("parts: bodies that touch are one, with the covers between them and those that each has") {
    const Polyhedron low = bodyOf({{Vec3(0, 0, 0), Vec3(1, 1, 1)}});
    const Polyhedron high = bodyOf({{Vec3(1, 0, 0), Vec3(2, 1, 1)}, {Vec3(1, 0, 1), Vec3(2, 1, 2)}});
    const auto both = unionOf({low, high});
    REQUIRE(both.has_value());
    REQUIRE(both->partCount() == 3);
    const auto& parts = both->faces.parts();
    CHECK((parts[0].beside == std::vector<std::int32_t>{1, 2}));
    CHECK((parts[1].beside == std::vector<std::int32_t>{0, 2}));
    CHECK((parts[2].beside == std::vector<std::int32_t>{0, 1}));
    CHECK(count(*both, Cover::wholly) == 4);  // two of each of the faces that are shared
    CHECK(surfaceOf(*both) == doctest::Approx(14.0).epsilon(1e-12));
    // The shape that the same parts have when they are joined.
    const auto joined = joinParts({partsOf(low)[0], partsOf(high)[0], partsOf(high)[1]});
    REQUIRE(joined.ok());
    CHECK((joined->faces.covers() == both->faces.covers()));
}

TEST_CASE("parts: bodies apart are not one, and those that overlap are no error") {
    const auto unit = [](double x) { return bodyOf({{Vec3(x, 0, 0), Vec3(x + 1, 1, 1)}}); };
    CHECK_FALSE(unionOf({unit(0)}).has_value());
    CHECK_FALSE(unionOf({unit(0), unit(1.5)}).has_value());
    CHECK(unionOf({unit(0), unit(0.5)}).has_value());
    const auto three = unionOf({unit(0), unit(1), unit(5)});
    REQUIRE(three.has_value());
    CHECK(three->faces.parts()[2].beside.empty());
}
