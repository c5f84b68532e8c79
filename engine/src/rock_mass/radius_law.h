#pragma once
// Radii of discs: their moments, and radii drawn by the law times a power of the radius.
//
// Discs are uniform in space. So the number of radius r that may reach into a box of sides a, b, c is
// proportional to (a + 2r)(b + 2r)(c + 2r), a sum of powers of r. A law times r^k is a law of the same kind:
// r^-e becomes r^(k-e), a lognormal one with the mean mu of its logarithm one with mu + k sigma^2. So radii
// are drawn for discs near the box only, and none that is too far away.

#include <algorithm>
#include <cmath>
#include <utility>

#include "talus/fractures.h"

namespace talus::rock_mass {

/// Mean and deviation of the logarithm of a lognormal radius.
struct LogNormal {
    double mu = 0, sigma = 0;

    explicit LogNormal(const FractureSet& set) {
        const double variance = std::log1p(std::pow(set.deviation / set.radius, 2));
        mu = std::log(set.radius) - 0.5 * variance;
        sigma = std::sqrt(variance);
    }
    /// Where the law times r^k is cut off, in deviations from its mean.
    std::pair<double, double> ends(const FractureSet& set, int k) const {
        const double mean = mu + k * sigma * sigma;
        const auto deviations = [&](double r) { return r > 0 ? (std::log(r) - mean) / sigma : -kFarthest; };
        return {deviations(set.least), deviations(set.most)};
    }
    static constexpr double kFarthest = 40;  // erfc is 0 there
};

/// Share of a normal law between two numbers of deviations, without loss in its tails.
inline double normalShare(double low, double high) {
    if (low > 0) return normalShare(-high, -low);
    return 0.5 * (std::erfc(-high * M_SQRT1_2) - std::erfc(-low * M_SQRT1_2));
}

/// The number of deviations below which a share u of what lies between two of them is.
inline double normalQuantile(double low, double high, double u) {
    if (low > 0) return -normalQuantile(-high, -low, 1 - u);
    const double wanted = u * normalShare(low, high), from = low;
    for (int k = 0; k < 100 && low < high; ++k) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (normalShare(from, middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Integral of x^-e from 1 to `end`.
inline double powerIntegral(double e, double end) {
    return std::abs(1 - e) < 1e-12 ? std::log(end) : std::expm1((1 - e) * std::log(end)) / (1 - e);
}

/// Mean of r^k [m^k]; 0 where the law leaves nothing between its ends.
inline double radiusMoment(const FractureSet& set, int k) {
    if (set.law == RadiusLaw::constant) return std::pow(set.radius, k);
    if (set.law == RadiusLaw::power) {
        const double end = set.most / set.least;
        return std::pow(set.least, k) * powerIntegral(set.exponent - k, end) /
               powerIntegral(set.exponent, end);
    }
    const LogNormal law(set);
    const auto [low, high] = law.ends(set, 0);
    const auto [low_k, high_k] = law.ends(set, k);
    const double all = normalShare(low, high);
    return all > 0
               ? std::exp(k * law.mu + 0.5 * k * k * law.sigma * law.sigma) * normalShare(low_k, high_k) / all
               : 0;
}

/// A radius by the law times r^k. \param u  in [0, 1)
inline double drawnRadius(const FractureSet& set, int k, double u) {
    if (set.law == RadiusLaw::constant) return set.radius;
    if (set.law == RadiusLaw::power) {
        const double e = set.exponent - k, end = set.most / set.least;
        const double ratio = std::abs(1 - e) < 1e-12
                                 ? std::pow(end, u)
                                 : std::exp(std::log1p(u * std::expm1((1 - e) * std::log(end))) / (1 - e));
        return std::clamp(set.least * ratio, set.least, set.most);
    }
    const LogNormal law(set);
    const auto [low, high] = law.ends(set, k);
    const double z = normalQuantile(std::max(low, -LogNormal::kFarthest), high, u);
    return std::clamp(std::exp(law.mu + k * law.sigma * law.sigma + law.sigma * z), set.least, set.most);
}

}  // namespace talus::rock_mass
