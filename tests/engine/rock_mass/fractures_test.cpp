// Fracture networks: areas inside regions by closed forms and by counting, orientations and radii by their
// laws, P32 as wanted.

#include "talus/fractures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rock_mass/radius_law.h"
#include "support/properties.h"
#include "support/terrains.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kPi = std::numbers::pi;

TriangleSurface box(double side) { return *boxSurface(Vec3::Zero(), Vec3::Constant(side)); }

/// A notch in a box: not convex.
TriangleSurface angle() { return *extrudeProfile({{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}}, 0, 5); }

bool isInAngle(const Vec3& p) {
    return p.y() > 0 && p.y() < 5 && p.x() > 0 && p.z() > 0 &&
           ((p.x() < 6 && p.z() < 2) || (p.x() < 2 && p.z() < 6));
}

FractureSet set(RadiusLaw law, double size = 1) {
    FractureSet set;
    set.field = "fracture_set[0]";
    set.dip = 0.4;
    set.dip_direction = 1.1;
    set.fisher = 30;
    set.law = law;
    set.radius = size;
    set.deviation = 0.4 * size;
    set.exponent = 2.5;
    set.least = law == RadiusLaw::constant ? 0 : 0.3 * size;
    set.most = 4 * size;
    set.count = 2000;
    return set;
}

/// Largest difference between the drawn distribution and the law, times sqrt(n) (Kolmogorov, Smirnov): 1.63
/// in one of a hundred.
template <class Law>
double distance(std::vector<double> drawn, const Law& share) {
    std::sort(drawn.begin(), drawn.end());
    const auto n = static_cast<double>(drawn.size());
    double largest = 0;
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        const double law = share(drawn[k]);
        largest = std::max({largest, law - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - law});
    }
    return largest * std::sqrt(n);
}

std::vector<double> radii(const FractureSet& set) {
    const auto discs = drawFractures(set, box(10), 7, 0);
    REQUIRE(discs.ok());
    std::vector<double> all;
    for (const Fracture& disc : *discs) all.push_back(disc.radius);
    return all;
}

}  // namespace

TEST_CASE("fractures: area inside a region, by closed forms") {
    const TriangleSurface ten = box(10);
    CHECK(areaInside({{5, 5, 5}, 0.7, 0.3, 2}, ten) == doctest::Approx(4 * kPi).epsilon(1e-12));
    CHECK(areaInside({{5, 5, 5}, 0, 0, 100}, ten) == doctest::Approx(100).epsilon(1e-12));
    CHECK(areaInside({{0, 5, 5}, 0, 0, 2}, ten) == doctest::Approx(2 * kPi).epsilon(1e-12));
    CHECK(areaInside({{0, 0, 5}, 0, 0, 2}, ten) == doctest::Approx(kPi).epsilon(1e-12));
    CHECK(areaInside({{5, 5, 12}, 0, 0, 3}, ten) == 0);
    // Ellipses: pi a b inside; half of it where the face goes through the centre; a strip of one far larger.
    CHECK(areaInside({{5, 5, 5}, 0.7, 0.3, 3, 1, 0.4}, ten) == doctest::Approx(3 * kPi).epsilon(1e-12));
    CHECK(areaInside({{0, 5, 5}, 0, 0, 3, 2, 0.4}, ten) == doctest::Approx(3 * kPi).epsilon(1e-12));
    CHECK(areaInside({{5, 5, 5}, 0, 0, 1e6, 2, kPi / 2}, ten) == doctest::Approx(40).epsilon(1e-6));
    CHECK(areaInside({{-4, 5, 5}, 0, 0, 3}, ten) == 0);
    CHECK(areaInside({{5, 5, 5}, kPi / 4, kPi / 2, 100}, ten) ==
          doctest::Approx(100 * std::sqrt(2)).epsilon(1e-12));
    const double far = 5e6;  // survey coordinates
    TriangleSurface moved = ten;
    for (Vec3& v : moved.vertices) v += Vec3::Constant(far);
    CHECK(areaInside({Vec3(5, 5, 5) + Vec3::Constant(far), 0.7, 0.3, 2}, moved) == doctest::Approx(4 * kPi));
}

TEST_CASE("property: area inside a region that is not convex is what counting points of the disc says") {
    const TriangleSurface region = angle();
    checkProperty("disc area", 60, [&] {
        const Fracture disc{{*numberIn(-1, 7), *numberIn(-1, 6), *numberIn(-1, 7)},
                            *numberIn(0, 1.57),
                            *numberIn(0, 6.28),
                            *numberIn(0.5, 5)};
        const Vec3 normal = upwardNormal(disc.dip, disc.dip_direction);
        const Vec3 e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
        const int n = 300;
        int inside = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double u = 2 * (i + 0.5) / n - 1, v = 2 * (j + 0.5) / n - 1;
                inside += u * u + v * v < 1 && isInAngle(disc.centre + disc.radius * (u * e1 + v * e2));
            }
        const double counted = 4.0 * inside / (n * n);
        RC_ASSERT(std::abs(areaInside(disc, region) / (disc.radius * disc.radius) - counted) < 0.02);
    });
}

TEST_CASE("fractures: directions have Fisher's resultant about the mean") {
    for (const double kappa : {20.0, 60.0, 300.0}) {
        FractureSet fisher = set(RadiusLaw::constant);
        fisher.fisher = kappa;
        fisher.count = 20000;
        const auto discs = drawFractures(fisher, box(10), 3, 1);
        REQUIRE(discs.ok());
        Vec3 sum = Vec3::Zero();
        for (const Fracture& disc : *discs) sum += upwardNormal(disc.dip, disc.dip_direction);
        const double n = 20000, mean = 1 / std::tanh(kappa) - 1 / kappa;
        // cos of the angle from the mean: variance 1/k^2 - 1/sinh^2 k.
        const double error = std::sqrt(1 / (kappa * kappa) / n);
        CHECK(std::abs(sum.dot(upwardNormal(fisher.dip, fisher.dip_direction)) / n - mean) < 4 * error);
        CHECK(std::abs(sum.norm() / n - mean) < 5 * error);
    }
    FractureSet parallel = set(RadiusLaw::constant);
    parallel.fisher.reset();
    for (const Fracture& disc : *drawFractures(parallel, box(10), 3, 1)) CHECK(disc.dip == parallel.dip);
}

TEST_CASE("fractures: radii have their law") {
    const FractureSet power = set(RadiusLaw::power);
    const double k = 1 - power.exponent;
    CHECK(distance(radii(power), [&](double r) {
              return (std::pow(r, k) - std::pow(power.least, k)) /
                     (std::pow(power.most, k) - std::pow(power.least, k));
          }) < 1.63);
    FractureSet inverse = power;
    inverse.exponent = 1;
    CHECK(distance(radii(inverse), [&](double r) {
              return std::log(r / power.least) / std::log(power.most / power.least);
          }) < 1.63);
    FractureSet lognormal = set(RadiusLaw::lognormal);
    lognormal.least = 0;
    lognormal.most = 1e6;
    const double variance = std::log(1 + 0.4 * 0.4), mu = -0.5 * variance;
    const auto normal = [&](double r) {
        return 0.5 * std::erfc((mu - std::log(r)) / std::sqrt(2 * variance));
    };
    CHECK(distance(radii(lognormal), normal) < 1.63);
    lognormal.least = 0.6;
    lognormal.most = 1.5;
    CHECK(distance(radii(lognormal),
                   [&](double r) { return (normal(r) - normal(0.6)) / (normal(1.5) - normal(0.6)); }) < 1.63);
    CHECK(distance(radii(lognormal), normal) > 3);  // the test tells laws apart
    for (const double r : radii(set(RadiusLaw::constant, 1.7))) CHECK(r == 1.7);
}

TEST_CASE("fractures: P32 is reached within one per cent, whatever region, law and target") {
    const TriangleSurface hill = closeTerrain(terrainOf(Ground::hill, 6), -5)->surface;
    for (const TriangleSurface& region : {box(10), angle(), hill})
        for (const RadiusLaw law : {RadiusLaw::constant, RadiusLaw::lognormal, RadiusLaw::power})
            for (const double target : {0.05, 0.6}) {
                FractureSet wanted = set(law, 1.5);
                wanted.p32 = target;
                const auto discs = drawFractures(wanted, region, 11, 0);
                REQUIRE(discs.ok());
                CHECK(fractureIntensity(*discs, region) == doctest::Approx(target).epsilon(0.0101));
                for (const Fracture& disc : *discs) CHECK(areaInside(disc, region) > 0);
                Vec3 low = region.vertices[0], high = low;
                for (const Vec3& v : region.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
                for (const Fracture& disc : *discs)  // it does reach into the region's box
                    CHECK((disc.centre - disc.centre.cwiseMax(low).cwiseMin(high)).norm() < disc.radius);
            }
    // Discs far larger than a region, compact or long, are planes through it.
    for (const TriangleSurface& region : {box(10), *boxSurface(Vec3::Zero(), Vec3(60, 2, 1))})
        for (const double large : {1e2, 1e4, 1e7}) {
            FractureSet wanted = set(RadiusLaw::constant, large);
            wanted.p32 = 40;
            const auto discs = drawFractures(wanted, region, 11, 0);
            CAPTURE(large);
            if (!discs) FAIL(discs.errors()[0].message);
            CHECK(fractureIntensity(*discs, region) == doctest::Approx(40).epsilon(0.0101));
        }
    // As dense beside the surface as in the middle: area in the inner cube of half the side.
    FractureSet wanted = set(RadiusLaw::constant, 1.5);
    wanted.p32 = 3;
    const auto discs = drawFractures(wanted, box(10), 5, 0);
    const TriangleSurface inner = *boxSurface(Vec3::Constant(2.5), Vec3::Constant(7.5));
    CHECK(fractureIntensity(*discs, inner) == doctest::Approx(3).epsilon(0.1));
}

TEST_CASE("fractures: a seed gives the same discs, another one others; centres by count lie inside") {
    const FractureSet drawn = set(RadiusLaw::power);
    const auto a = *drawFractures(drawn, angle(), 5, 0), b = *drawFractures(drawn, angle(), 5, 0),
               c = *drawFractures(drawn, angle(), 6, 0), d = *drawFractures(drawn, angle(), 5, 1);
    REQUIRE(a.size() == 2000);
    for (std::size_t k = 0; k < a.size(); ++k) {
        CHECK(a[k].centre == b[k].centre);
        CHECK(a[k].dip == b[k].dip);
        CHECK(a[k].radius == b[k].radius);
        CHECK(isInAngle(a[k].centre));
        CHECK(a[k].centre != c[k].centre);
        CHECK(a[k].centre != d[k].centre);
    }
}

TEST_CASE("fractures: moments of radii are those of the law, by summing over what it draws") {
    for (const RadiusLaw law : {RadiusLaw::constant, RadiusLaw::lognormal, RadiusLaw::power})
        for (const double exponent : {0.5, 1.0, 2.0, 3.7}) {
            FractureSet one = set(law, 1.5);
            one.exponent = exponent;
            for (int k = 0; k < 4; ++k)
                for (int power = 0; power < 3; ++power) {  // E[r^(k + power)] / E[r^power]
                    CAPTURE(static_cast<int>(law));
                    CAPTURE(exponent);
                    CAPTURE(k);
                    CAPTURE(power);
                    const int n = 20'000;
                    double sum = 0;
                    for (int i = 0; i < n; ++i)
                        sum += std::pow(rock_mass::drawnRadius(one, power, (i + 0.5) / n), k);
                    CHECK(sum / n == doctest::Approx(rock_mass::radiusMoment(one, k + power) /
                                                     rock_mass::radiusMoment(one, power))
                                         .epsilon(2e-4));
                }
        }
}

TEST_CASE("fractures: whatever the law, a target is reached or refused, and drawing may be stopped") {
    int reached = 0;
    for (const double least : {1e-9, 1e-3, 0.5})
        for (const double most : {0.6, 30.0, 1e6})
            for (const double shape : {0.1, 1.0, 3.0, 9.0, 100.0})
                for (const RadiusLaw law : {RadiusLaw::lognormal, RadiusLaw::power}) {
                    CAPTURE(least);
                    CAPTURE(most);
                    CAPTURE(shape);
                    CAPTURE(static_cast<int>(law));
                    FractureSet wide = set(law, 1.5);
                    wide.least = least;
                    wide.most = most;
                    wide.exponent = shape;
                    wide.deviation = shape * shape * shape;
                    wide.p32 = 0.4;
                    const auto discs = drawFractures(wide, angle(), 3, 0);
                    if (discs.ok())
                        CHECK(fractureIntensity(*discs, angle()) == doctest::Approx(0.4).epsilon(0.0101));
                    else
                        CHECK(discs.errors()[0].field.starts_with("fracture_set[0]"));
                    reached += discs.ok() ? 1 : 0;
                }
    CHECK(reached > 40);
    const std::atomic<bool> stop{true};
    for (const bool by_count : {false, true}) {
        FractureSet endless = set(RadiusLaw::power);
        if (!by_count) endless.p32 = 0.4;
        const auto discs = drawFractures(endless, angle(), 3, 0, &stop);
        REQUIRE_FALSE(discs.ok());
        CHECK(discs.errors()[0].message.find("interrupted") != std::string::npos);
    }
}

TEST_CASE("fractures: numbers out of range and targets out of reach are refused by their key") {
    const auto refused = [](const FractureSet& wrong, const std::string& field) {
        const auto discs = drawFractures(wrong, box(10), 1, 0);
        REQUIRE_FALSE(discs.ok());
        CHECK(discs.errors()[0].field == "fracture_set[0]" + field);
    };
    FractureSet wrong = set(RadiusLaw::constant, -1);
    refused(wrong, ".radius");
    wrong = set(RadiusLaw::power);
    wrong.least = 9;
    refused(wrong, ".radius_min");
    wrong = set(RadiusLaw::constant, 1e-3);
    wrong.p32 = 100;
    refused(wrong, ".p32");
    wrong = set(RadiusLaw::constant);
    wrong.count = 0;
    refused(wrong, ".count");
}
