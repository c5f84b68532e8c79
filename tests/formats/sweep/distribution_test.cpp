// Quantile functions against tabulated values, against the C library's erfc, and by their moments.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "sweep/portable_math.h"
#include "talus/formats/distribution.h"

namespace talus::formats {

namespace {

using Kind = Distribution::Kind;

double relative(double value, double exact) { return std::abs(value / exact - 1); }

struct Moments {
    double mean = 0, sd = 0;
};

/// By the midpoint rule over the probability, which stands for all samples at once.
Moments momentsOf(const Distribution& distribution) {
    constexpr int kCells = 40000;
    double sum = 0, squares = 0;
    const double middle = quantile(distribution, 0.5);
    for (int i = 0; i < kCells; ++i) {
        const double value = quantile(distribution, (i + 0.5) / kCells) - middle;
        sum += value;
        squares += value * value;
    }
    const double mean = sum / kCells;
    return {middle + mean, std::sqrt(squares / kCells - mean * mean)};
}

}  // namespace

TEST_CASE("exp, log and the gamma function agree with the C library's to their stated accuracy") {
    double exp_error = 0, log_error = 0, gamma_error = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = -700 + 0.0699 * i;
        exp_error = std::max(exp_error, relative(sweep::portableExp(x), std::exp(x)));
        const double y = std::exp(0.01 * (x + 0.003));
        log_error = std::max(log_error, relative(sweep::portableLog(y), std::log(y)));
        const double g = 0.01 + 0.01 * i;
        gamma_error = std::max(gamma_error, std::abs(sweep::portableLogGamma(g) - std::lgamma(g)) /
                                                (1 + std::abs(std::lgamma(g))));
    }
    CHECK(exp_error < 1e-15);
    CHECK(log_error < 2e-15);
    CHECK(gamma_error < 2e-14);
}

TEST_CASE("the normal quantile has the tabulated values and inverts erfc") {
    CHECK(normalQuantile(0.975) == doctest::Approx(1.959963984540054).epsilon(1e-15));
    CHECK(normalQuantile(0.9) == doctest::Approx(1.281551565544600).epsilon(1e-15));
    CHECK(normalQuantile(0.999) == doctest::Approx(3.090232306167813).epsilon(1e-15));
    CHECK(normalQuantile(1e-20) == doctest::Approx(-9.262340089798408).epsilon(1e-15));
    CHECK(normalQuantile(0.5) == 0);
    double quantile_error = 0, cdf_error = 0;
    for (int i = 1; i < 20000; ++i) {
        const double u = i / 20000.0, z = -8 + 8e-4 * i;
        quantile_error =
            std::max(quantile_error, relative(0.5 * std::erfc(-normalQuantile(u) / std::sqrt(2.0)), u));
        cdf_error = std::max(cdf_error, relative(normalProbability(z), 0.5 * std::erfc(-z / std::sqrt(2.0))));
    }
    CHECK(quantile_error < 2e-14);
    CHECK(cdf_error < 1e-13);
}

TEST_CASE("the beta quantile has the tabulated values and inverts the distribution function") {
    CHECK(betaQuantile(2, 3, 0.5) == doctest::Approx(0.385727568132390).epsilon(1e-12));
    CHECK(betaQuantile(0.5, 0.5, 0.1) == doctest::Approx(std::pow(std::sin(0.05 * M_PI), 2)).epsilon(1e-12));
    CHECK(betaQuantile(1, 1, 0.3) == doctest::Approx(0.3).epsilon(1e-13));
    CHECK(betaQuantile(5, 1, 0.2) == doctest::Approx(std::pow(0.2, 0.2)).epsilon(1e-12));
    // Two failures in ten: the textbook interval of Clopper and Pearson.
    CHECK(betaQuantile(2, 9, 0.025) == doctest::Approx(0.02521073).epsilon(1e-6));
    CHECK(betaQuantile(3, 8, 0.975) == doctest::Approx(0.55609546).epsilon(1e-6));
    for (const double a : {0.3, 1.0, 2.5, 40.0, 900.0})
        for (const double b : {0.4, 1.0, 7.0, 120.0})
            for (const double u : {1e-6, 0.01, 0.3, 0.7, 0.999}) {
                CAPTURE(a);
                CAPTURE(b);
                CAPTURE(u);
                CHECK(sweep::betaCdf(a, b, betaQuantile(a, b, u)) == doctest::Approx(u).epsilon(1e-9));
            }
}

TEST_CASE("the beta distribution has a value where its two sides meet") {
    // Each side once handed this point to the other one, for ever.
    for (const double a : {0.5, 1.0, 2.0, 3.5, 50.0, 500.5})
        CHECK(sweep::betaCdf(a, a, 0.5) == doctest::Approx(0.5));
    for (double a = 1; a < 60; a += 1.5)
        for (double b = 1; b < 60; b += 2.5) {
            const double x = (a + 1) / (a + b + 2);
            CHECK(sweep::betaCdf(a, b, x) + sweep::betaCdf(b, a, 1 - x) == doctest::Approx(1).epsilon(1e-10));
        }
}

TEST_CASE("distributions have the moments they are named by") {
    const auto check = [](const Distribution& distribution, double mean, double sd, double tolerance) {
        CAPTURE(toString(distribution.kind));
        const Moments moments = momentsOf(distribution);
        CHECK(moments.mean == doctest::Approx(mean).epsilon(tolerance));
        CHECK(moments.sd == doctest::Approx(sd).epsilon(tolerance));
    };
    check({.kind = Kind::uniform, .min = 18, .max = 21}, 19.5, 3 / std::sqrt(12.0), 1e-6);
    check({.kind = Kind::normal, .mean = 30, .sd = 2}, 30, 2, 1e-3);
    check({.kind = Kind::lognormal, .mean = 500, .sd = 200}, 500, 200, 3e-3);
    check({.kind = Kind::triangular, .min = 0, .max = 3, .mode = 2}, 5.0 / 3, std::sqrt(7.0 / 18), 1e-6);
    // alpha / (alpha + beta) and so on, on 10..20.
    check({.kind = Kind::beta, .min = 10, .max = 20, .alpha = 2, .beta = 3}, 14, 2, 1e-5);
    // Of a die: 7/2, (36 - 1) / 12.
    check({.kind = Kind::integer, .min = 1, .max = 6}, 3.5, std::sqrt(35.0 / 12), 1e-3);
    // Cut at one standard deviation on either side: sd^2 (1 - 2 phi(1) / (2 Phi(1) - 1)).
    const double density = std::exp(-0.5) / std::sqrt(2 * M_PI);
    const double share = std::erf(1 / std::sqrt(2.0));
    check({.kind = Kind::truncated_normal, .min = 28, .max = 32, .mean = 30, .sd = 2}, 30,
          2 * std::sqrt(1 - 2 * density / share), 1e-6);
}

TEST_CASE("a truncated normal stays in its range, far out in a tail as well") {
    for (const double from : {-7.0, -3.0, 0.0, 3.0, 7.0}) {
        CAPTURE(from);
        const Distribution tail{
            .kind = Kind::truncated_normal, .min = from, .max = from + 0.5, .mean = 0, .sd = 1};
        double before = from;
        for (const double u : {1e-12, 0.1, 0.5, 0.9, 1 - 1e-12}) {
            const double value = quantile(tail, u);
            CHECK(value >= before);
            CHECK(value <= from + 0.5);
            // The share of the tail below the value is u.
            const auto upper = [](double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); };
            const double sign = from > 0 ? 1 : -1;
            const double part = from > 0
                                    ? (upper(from) - upper(value)) / (upper(from) - upper(from + 0.5))
                                    : (upper(-value) - upper(-from)) / (upper(-from - 0.5) - upper(-from));
            CAPTURE(sign);
            CHECK(part == doctest::Approx(u).epsilon(1e-6));
            before = value;
        }
    }
}

}  // namespace talus::formats
