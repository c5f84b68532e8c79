#pragma once
// Estimates from samples, with their confidence. Pure functions.

#include <cstdint>
#include <vector>

namespace talus::tools::batch {

struct Interval {
    double low = 0, high = 0;
};

/// Confidence interval of a share of which `hits` out of `count` were seen: Clopper and Pearson's, which
/// never covers less than it says. (0, 1) without observations.
Interval shareInterval(std::uint64_t hits, std::uint64_t count, double confidence);

struct Moments {
    std::uint64_t count = 0;
    double mean = 0, sd = 0;  ///< sd of the sample, with count - 1; 0 for one value
    Interval mean_interval;   ///< Student's t
};
Moments momentsOf(const std::vector<double>& values, double confidence);

/// Two-sided quantile of Student's t: P(|T| < result) = confidence. \pre freedom >= 1
double studentQuantile(double freedom, double confidence);

/// Linear between the order statistics, as most software does (Hyndman and Fan's type 7). Infinite values are
/// allowed.
/// \pre `sorted` is sorted and not empty
double quantileOf(const std::vector<double>& sorted, double share);

/// 1-based ranks, equal values share their mean rank.
std::vector<double> ranksOf(const std::vector<double>& values);

/// Spearman's rank correlation with a confidence interval by Fisher's transformation (standard error of
/// Bonett and Wright, 2000). `known` is false when one of the two does not vary or there are fewer than five
/// pairs.
struct Correlation {
    bool known = false;
    double rho = 0;
    Interval interval;
};
Correlation rankCorrelation(const std::vector<double>& x, const std::vector<double>& y, double confidence);

/// Equal cells over the values' range, their number after Freedman and Diaconis, 5 to 40. \pre not empty, all
/// finite
struct Histogram {
    double low = 0, width = 1;
    std::vector<std::uint64_t> counts;
};
Histogram histogramOf(const std::vector<double>& sorted);

}  // namespace talus::tools::batch
