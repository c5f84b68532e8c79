// Mean, Fisher's constant and its confidence, sets, weights, densities.

#include "talus/pole_statistics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "rock_mass/random.h"
#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::kinematics;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Vec3 plane(double dip, double dip_direction) { return upwardNormal(dip * kDeg, dip_direction * kDeg); }

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

std::vector<Vec3> drawn(const Vec3& mean, double fisher, std::size_t count, std::uint64_t seed) {
    rock_mass::Random random(seed);
    std::vector<Vec3> normals;
    for (std::size_t k = 0; k < count; ++k) normals.push_back(rock_mass::scattered(mean, fisher, random));
    return normals;
}

}  // namespace

TEST_CASE("Fisher: four planes about an axis by hand") {
    // Four normals at 10 degrees about the vertical: R = 4 cos 10, K = 3 / (4 - R).
    const std::vector<Vec3> normals{plane(10, 0), plane(10, 90), plane(10, 180), plane(10, 270)};
    const FisherStatistics found = fisherStatistics(normals);
    const double r = 4 * std::cos(10 * kDeg);
    CHECK(angle(found.mean, Vec3::UnitZ()) < 1e-12);
    CHECK(found.resultant == doctest::Approx(r).epsilon(1e-14));
    CHECK(*found.k == doctest::Approx(3 / (4 - r)).epsilon(1e-12));
    // chi-squared of 6 degrees of freedom: 1.237 and 14.449 are its 2.5 and 97.5 % quantiles (tables).
    CHECK(*found.k_low == doctest::Approx(1.2373 / (2 * (4 - r))).epsilon(1e-4));
    CHECK(*found.k_high == doctest::Approx(14.4494 / (2 * (4 - r))).epsilon(1e-4));
    CHECK(std::cos(*found.cone_95) ==
          doctest::Approx(1 - (4 - r) / r * (std::pow(20, 1.0 / 3) - 1)).epsilon(1e-12));
}

TEST_CASE("Fisher: one plane, parallel planes, and planes on both sides of vertical") {
    CHECK_FALSE(fisherStatistics({plane(30, 40)}).k);
    const FisherStatistics parallel = fisherStatistics({plane(30, 40), plane(30, 40), plane(30, 40)});
    CHECK_FALSE(parallel.k);
    CHECK_FALSE(parallel.cone_95);
    CHECK(angle(parallel.mean, plane(30, 40)) < 1e-12);
    // 85/090 and 85/270 are 10 degrees apart; their mean is vertical, not horizontal.
    const FisherStatistics steep = fisherStatistics({plane(85, 90), plane(85, 270)});
    CHECK(angle(steep.mean, plane(90, 90)) < 1e-12);
    CHECK(steep.resultant == doctest::Approx(2 * std::cos(5 * kDeg)).epsilon(1e-14));
}

TEST_CASE("Fisher: weights move the mean as so many planes would") {
    const std::vector<Vec3> twice{plane(40, 90), plane(40, 90), plane(60, 100)};
    const FisherStatistics counted = fisherStatistics(twice);
    const FisherStatistics weighed = fisherStatistics({plane(40, 90), plane(60, 100)}, {2, 1});
    CHECK((counted.mean - weighed.mean).norm() < 1e-12);
    CHECK(counted.resultant / 3 == doctest::Approx(weighed.resultant / 2).epsilon(1e-14));
}

TEST_CASE("Fisher: K of drawn planes lies within its confidence, and so does the mean, 95 times in 100") {
    for (const double k : {12.0, 60.0, 400.0}) {
        int k_inside = 0, mean_inside = 0;
        const Vec3 mean = plane(55, 310);
        for (std::uint64_t seed = 1; seed <= 400; ++seed) {
            const FisherStatistics found = fisherStatistics(drawn(mean, k, 40, seed));
            k_inside += *found.k_low <= k && k <= *found.k_high;
            mean_inside += angle(found.mean, mean) <= *found.cone_95;
        }
        CAPTURE(k);
        // 380 of 400, with a standard deviation of 4.4
        CHECK(k_inside >= 364);
        CHECK(k_inside <= 396);
        CHECK(mean_inside >= 364);
        CHECK(mean_inside <= 396);
    }
}

TEST_CASE("sets: three drawn sets are found again, also one across the edge of the net, whatever the order") {
    const std::vector<Vec3> means{plane(35, 120), plane(88, 45), plane(70, 300)};
    const std::vector<std::size_t> sizes{90, 60, 40};
    std::vector<Vec3> normals;
    std::vector<std::size_t> truth;
    for (std::size_t s = 0; s < 3; ++s)
        for (const Vec3& normal : drawn(means[s], 60, sizes[s], 5 + s)) {
            normals.push_back(normal);
            truth.push_back(s);
        }
    const auto found = findSets(normals, 3);
    REQUIRE(found);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) wrong += (*found)[i] != truth[i];
    CHECK(wrong <= 2);  // sets are numbered by their size
    for (std::size_t s = 0; s < 3; ++s) {
        std::vector<Vec3> own;
        for (std::size_t i = 0; i < normals.size(); ++i)
            if ((*found)[i] == s) own.push_back(normals[i]);
        CHECK(angle(fisherStatistics(own).mean, means[s]) < 4 * kDeg);
    }
    std::vector<Vec3> backwards(normals.rbegin(), normals.rend());
    auto again = *findSets(backwards, 3);
    std::reverse(again.begin(), again.end());
    CHECK(again == *found);
}

TEST_CASE("sets: one, as many as planes, and more than there are") {
    const std::vector<Vec3> normals{plane(10, 0), plane(80, 0), plane(80, 90), plane(80, 90)};
    CHECK(*findSets(normals, 1) == std::vector<std::size_t>{0, 0, 0, 0});
    CHECK(*findSets(normals, 3) == std::vector<std::size_t>{1, 2, 0, 0});
    const auto more = findSets(normals, 4);
    REQUIRE_FALSE(more.ok());
    CHECK(more.errors()[0].message.find("found 4, allowed: 1 to 3") != std::string::npos);
    CHECK_FALSE(findSets(normals, 0).ok());
}

TEST_CASE(
    "Terzaghi: a line along the normal meets every plane, one nearly in the plane few, and the weight has a "
    "limit") {
    CHECK(terzaghiWeight(plane(0, 0), Vec3(0, 0, -1), 15 * kDeg) == doctest::Approx(1));
    CHECK(terzaghiWeight(plane(60, 90), Vec3(0, 0, -1), 15 * kDeg) == doctest::Approx(2));
    CHECK(terzaghiWeight(plane(80, 90), Vec3(0, 0, -1), 5 * kDeg) ==
          doctest::Approx(1 / std::cos(80 * kDeg)));
    CHECK(terzaghiWeight(plane(90, 90), Vec3(0, 0, -1), 15 * kDeg) ==
          doctest::Approx(1 / std::sin(15 * kDeg)));
}

TEST_CASE(
    "densities: one pole counts all of itself where it lies, and the mean over the hemisphere is the "
    "circle's area") {
    const std::vector<Vec3> normals{plane(30, 40), plane(70, 250), plane(90, 10)};
    for (const bool fisher : {true, false})
        for (const double area : {0.01, 0.05}) {
            const Counting counting{fisher, area};
            CHECK(poleDensity(plane(30, 40), {plane(30, 40)}, {}, counting) == doctest::Approx(1));
            CHECK(poleDensity(-plane(30, 40), {plane(30, 40)}, {}, counting) == doctest::Approx(1));
            double sum = 0;
            const int bands = 400, turns = 800;  // of equal area
            for (int b = 0; b < bands; ++b)
                for (int t = 0; t < turns; ++t) {
                    const double z = (b + 0.5) / bands, turn = 2 * std::numbers::pi * (t + 0.5) / turns;
                    const double across = std::sqrt(1 - z * z);
                    sum += poleDensity({across * std::cos(turn), across * std::sin(turn), z}, normals,
                                       {1, 2, 3}, counting);
                }
            CHECK(sum / (bands * turns) == doctest::Approx(area).epsilon(0.01));
        }
    const double edge = std::acos(1 - 0.01);
    CHECK(poleDensity(plane(0.99 * edge / kDeg, 0), {plane(0, 0)}, {}, {false, 0.01}) == 1);
    CHECK(poleDensity(plane(1.01 * edge / kDeg, 0), {plane(0, 0)}, {}, {false, 0.01}) == 0);
}
