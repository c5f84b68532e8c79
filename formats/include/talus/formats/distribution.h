#pragma once
// Distributions of random variables, by their quantile functions. All of it is +, -, *, / and sqrt, so a seed
// gives the same samples, to the last bit, on every machine.

#include <cstdint>

namespace talus::formats {

struct Distribution {
    enum class Kind : std::uint8_t {
        uniform,           ///< min, max
        normal,            ///< mean, sd
        truncated_normal,  ///< mean, sd of the normal it is cut from; min, max
        lognormal,         ///< mean, sd of the variable itself, not of its logarithm
        triangular,        ///< min, mode, max
        beta               ///< alpha, beta; min, max
    };
    Kind kind = Kind::uniform;
    double min = 0, max = 1;
    double mean = 0, sd = 1;
    double mode = 0.5;
    double alpha = 1, beta = 1;
};

const char* toString(Distribution::Kind kind);

/// The value below which a share `u` of the distribution lies. Relative accuracy, of the distance to the
/// nearer end where there is one: 1e-15 uniform and triangular, 1e-14 normal and lognormal, 1e-12 truncated
/// normal and beta.
/// \pre 0 < u < 1, and the parameters are in range: sd > 0, min < max, min <= mode <= max, alpha, beta > 0;
/// mean > 0 of a lognormal
double quantile(const Distribution& distribution, double u);

/// Quantile of the standard normal distribution: Wichura's algorithm AS 241 (Applied Statistics 37, 1988),
/// relative accuracy 1e-15.
double normalQuantile(double u);

/// P(X < x) of the standard normal distribution.
double normalProbability(double x);

/// Quantile of the beta distribution on (0, 1). Also gives Clopper and Pearson's confidence limits of a
/// share.
double betaQuantile(double alpha, double beta, double u);

}  // namespace talus::formats
