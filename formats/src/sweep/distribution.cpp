#include "talus/formats/distribution.h"

#include <algorithm>
#include <cmath>

#include "sweep/portable_math.h"

namespace talus::formats {

namespace {

using sweep::betaCdf;
using sweep::normalCdf;
using sweep::portableExp;
using sweep::portableLog;

template <int n>
double polynomial(const double (&coefficients)[n], double x) {
    double sum = 0;
    for (int i = n - 1; i >= 0; --i) sum = coefficients[i] + x * sum;
    return sum;
}

// Coefficients of AS 241, PPND16: |u - 1/2| <= 0.425, then sqrt(-log u) <= 5, then beyond.
constexpr double kA[] = {3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                         1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                         3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr double kB[] = {1.0,
                         4.2313330701600911252e+1,
                         6.8718700749205790830e+2,
                         5.3941960214247511077e+3,
                         2.1213794301586595867e+4,
                         3.9307895800092710610e+4,
                         2.8729085735721942674e+4,
                         5.2264952788528545610e+3};
constexpr double kC[] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                         3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                         2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr double kD[] = {1.0,
                         2.05319162663775882187e0,
                         1.67638483018380384940e0,
                         6.89767334985100004550e-1,
                         1.48103976427480074590e-1,
                         1.51986665636164571966e-2,
                         5.47593808499534494600e-4,
                         1.05075007164441684324e-9};
constexpr double kE[] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                         2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                         2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr double kF[] = {1.0,
                         5.99832206555887937690e-1,
                         1.36929880922735805310e-1,
                         1.48753612908506148525e-2,
                         7.86869131145613259100e-4,
                         1.84631831751005468180e-5,
                         1.42151175831644588870e-7,
                         2.04426310338993978564e-15};

/// The parent is cut in the lower half of the bell, where small probabilities keep their digits.
double truncatedNormal(const Distribution& d, double u) {
    const double low = (d.min - d.mean) / d.sd, high = (d.max - d.mean) / d.sd;
    const bool mirrored = low + high > 0;
    const double from = normalCdf(mirrored ? -high : low), to = normalCdf(mirrored ? -low : high);
    const double share = mirrored ? 1 - u : u;
    const double probability = std::clamp(from + share * (to - from), 1e-300, 1 - 0x1p-53);
    const double z = normalQuantile(probability);
    return std::clamp(d.mean + d.sd * (mirrored ? -z : z), d.min, d.max);
}

double lognormal(const Distribution& d, double u) {
    const double ratio = d.sd / d.mean;
    const double variance = portableLog(1 + ratio * ratio);  // of the logarithm
    return portableExp(portableLog(d.mean) - 0.5 * variance + std::sqrt(variance) * normalQuantile(u));
}

double triangular(const Distribution& d, double u) {
    const double width = d.max - d.min, rise = d.mode - d.min;
    if (u * width < rise) return d.min + std::sqrt(u * width * rise);
    return d.max - std::sqrt((1 - u) * width * (d.max - d.mode));
}

}  // namespace

const char* toString(Distribution::Kind kind) {
    switch (kind) {
        case Distribution::Kind::uniform:
            return "uniform";
        case Distribution::Kind::normal:
            return "normal";
        case Distribution::Kind::truncated_normal:
            return "truncated-normal";
        case Distribution::Kind::lognormal:
            return "lognormal";
        case Distribution::Kind::triangular:
            return "triangular";
        case Distribution::Kind::beta:
            return "beta";
        case Distribution::Kind::integer:
            return "integer";
    }
    return "";
}

double normalProbability(double x) { return normalCdf(x); }

double normalQuantile(double u) {
    const double q = u - 0.5;
    if (std::abs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(kA, r) / polynomial(kB, r);
    }
    const double r = std::sqrt(-portableLog(q < 0 ? u : 1 - u));
    const double tail = r <= 5 ? polynomial(kC, r - 1.6) / polynomial(kD, r - 1.6)
                               : polynomial(kE, r - 5) / polynomial(kF, r - 5);
    return q < 0 ? -tail : tail;
}

double betaQuantile(double alpha, double beta, double u) {
    // Bisection over the exponent first, so that quantiles near 0 keep their digits; those near 1 cannot.
    double low = 0, high = 1;
    for (int i = 0; i < 1100 && high - low > 0x1p-52 * low; ++i) {
        const double middle = low > 0 && high < 4 * low ? 0.5 * (low + high)
                              : low > 0                 ? std::sqrt(low) * std::sqrt(high)
                                                        : high / 1024;
        if (!(middle > low) || !(middle < high)) break;
        (betaCdf(alpha, beta, middle) < u ? low : high) = middle;
        if (high < 1e-300) return 0;
    }
    return 0.5 * (low + high);
}

double quantile(const Distribution& d, double u) {
    switch (d.kind) {
        case Distribution::Kind::uniform:
            return std::min(d.min + u * (d.max - d.min), d.max);
        case Distribution::Kind::normal:
            return d.mean + d.sd * normalQuantile(u);
        case Distribution::Kind::truncated_normal:
            return truncatedNormal(d, u);
        case Distribution::Kind::lognormal:
            return lognormal(d, u);
        case Distribution::Kind::triangular:
            return triangular(d, u);
        case Distribution::Kind::beta:
            return d.min + (d.max - d.min) * betaQuantile(d.alpha, d.beta, u);
        case Distribution::Kind::integer:
            return std::min(d.min + std::floor(u * (d.max - d.min + 1)), d.max);
    }
    return 0;
}

}  // namespace talus::formats
