#include "sweep/portable_math.h"

#include <cmath>
#include <limits>

namespace talus::formats::sweep {

namespace {

// ln 2 in two parts; the first has 20 zero bits at its end, so that a small integer times it is exact.
constexpr double kLn2High = 6.93147180369123816490e-01;
constexpr double kLn2Low = 1.90821492927058770002e-10;
constexpr double kSqrtHalf = 0.70710678118654752440;
constexpr double kHalfLogTwoPi = 0.91893853320467274178;
constexpr double kInvSqrtTwoPi = 0.39894228040143267794;
constexpr double kTiny = 1e-300;

/// Continued fraction of I_x(a, b) (Abramowitz and Stegun 26.5.8), by Lentz's method. Converges fast for
/// x < (a + 1) / (a + b + 2).
double betaFraction(double a, double b, double x) {
    constexpr int kMaxTerms = 10000;
    const auto away = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
    double c = 1, d = 1 / away(1 - (a + b) * x / (a + 1)), fraction = d;
    for (int m = 1; m <= kMaxTerms; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / away(1 + even * d);
        c = away(1 + even / c);
        fraction *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / away(1 + odd * d);
        c = away(1 + odd / c);
        const double factor = d * c;
        fraction *= factor;
        if (std::abs(factor - 1) < 1e-16) break;
    }
    return fraction;
}

/// The upper tail P(X > x) for x > 0 from the continued fraction of Mills' ratio, evaluated from its far end.
double upperTail(double x) {
    double fraction = x;
    for (int k = 200; k >= 1; --k) fraction = x + k / fraction;
    return kInvSqrtTwoPi * portableExp(-0.5 * x * x) / fraction;
}

/// P(0 < X < x) by the series x + x^3/3 + x^5/(3 5) + ..., all terms of one sign.
double centralPart(double x) {
    double term = x, sum = x;
    for (int k = 3; std::abs(term) > 1e-17 * std::abs(sum); k += 2) sum += term *= x * x / k;
    return kInvSqrtTwoPi * portableExp(-0.5 * x * x) * sum;
}

}  // namespace

double portableExp(double x) {
    if (std::isnan(x)) return x;
    if (x > 709.79) return std::numeric_limits<double>::infinity();
    if (x < -745.2) return 0;
    // x = k ln 2 + r, |r| <= ln 2 / 2, then the Taylor series of exp(r) to r^14 (remainder below 1e-18).
    const double k = std::floor(x * 1.44269504088896340736 + 0.5);
    const double r = (x - k * kLn2High) - k * kLn2Low;
    double series = 1;
    for (int n = 14; n >= 1; --n) series = 1 + r * series / n;
    return std::ldexp(series, static_cast<int>(k));
}

double portableLog(double x) {
    // x = m 2^k with m near 1, log m = 2 artanh(s) = 2 (s + s^3/3 + ...), |s| <= 0.1716.
    int k = 0;
    double m = std::frexp(x, &k);
    if (m < kSqrtHalf) {
        m *= 2;
        --k;
    }
    const double s = (m - 1) / (m + 1), square = s * s;
    double series = 0;
    for (int n = 23; n >= 3; n -= 2) series = square * (1.0 / n + series);
    return k * kLn2High + (2 * s + (2 * s * series + k * kLn2Low));
}

double portableLogGamma(double x) {
    // Stirling's series from 10 up (error below 1e-16 there); below, Gamma(x) = Gamma(x + n) / (x ... (x + n
    // - 1)).
    double product = 1;
    for (; x < 10; x += 1) product *= x;
    const double inverse = 1 / x, square = inverse * inverse;
    constexpr double kStirling[] = {1.0 / 12,   -1.0 / 360,        1.0 / 1260, -1.0 / 1680,
                                    1.0 / 1188, -691.0 / 360360.0, 1.0 / 156,  -3617.0 / 122400};
    double series = 0;
    for (int i = 7; i >= 0; --i) series = kStirling[i] + square * series;
    return (x - 0.5) * portableLog(x) - x + kHalfLogTwoPi + inverse * series - portableLog(product);
}

double normalCdf(double x) {
    constexpr double kTail = 2;
    if (x < -kTail) return upperTail(-x);
    if (x > kTail) return 1 - upperTail(x);
    return 0.5 + centralPart(x);
}

/// By the continued fraction.
static double lowerBetaCdf(double a, double b, double x) {
    const double front = a * portableLog(x) + b * portableLog(1 - x) + portableLogGamma(a + b) -
                         portableLogGamma(a) - portableLogGamma(b);
    return portableExp(front) * betaFraction(a, b, x) / a;
}

double betaCdf(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    // The fraction is quick below the mean; on it either side will do, so the two never hand each other the
    // same question.
    return x > (a + 1) / (a + b + 2) ? 1 - lowerBetaCdf(b, a, 1 - x) : lowerBetaCdf(a, b, x);
}

}  // namespace talus::formats::sweep
