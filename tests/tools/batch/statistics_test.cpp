// Estimates against textbook values and by counting.

#include "batch/statistics.h"

#include <doctest/doctest.h>

#include <cmath>

namespace talus::tools::batch {

TEST_CASE("confidence intervals of a share are Clopper and Pearson's") {
    const Interval two = shareInterval(2, 10, 0.95);
    CHECK(two.low == doctest::Approx(0.02521073).epsilon(1e-6));
    CHECK(two.high == doctest::Approx(0.55609546).epsilon(1e-6));
    const Interval none = shareInterval(0, 100, 0.95);
    CHECK(none.low == 0);
    CHECK(none.high == doctest::Approx(1 - std::pow(0.025, 0.01)).epsilon(1e-9));
    const Interval all = shareInterval(7, 7, 0.9);
    CHECK(all.low == doctest::Approx(std::pow(0.05, 1.0 / 7)).epsilon(1e-9));
    CHECK(all.high == 1);
    const Interval nothing = shareInterval(0, 0, 0.95);
    CHECK(nothing.low == 0);
    CHECK(nothing.high == 1);
}

TEST_CASE("Student's t has its tabulated quantiles") {
    CHECK(studentQuantile(1, 0.95) == doctest::Approx(12.7062).epsilon(1e-5));
    CHECK(studentQuantile(4, 0.95) == doctest::Approx(2.776445).epsilon(1e-6));
    CHECK(studentQuantile(30, 0.99) == doctest::Approx(2.749996).epsilon(1e-6));
    CHECK(studentQuantile(1e5, 0.95) == doctest::Approx(1.95996).epsilon(1e-4));
}

TEST_CASE("mean and standard deviation of a few numbers") {
    const Moments moments = momentsOf({2, 4, 4, 4, 5, 5, 7, 9}, 0.95);
    CHECK(moments.mean == doctest::Approx(5));
    CHECK(moments.sd == doctest::Approx(std::sqrt(32.0 / 7)));
    CHECK(moments.mean_interval.high - 5 ==
          doctest::Approx(2.364624 * std::sqrt(32.0 / 7 / 8)).epsilon(1e-6));
    CHECK(momentsOf({3}, 0.95).sd == 0);
    CHECK(momentsOf({}, 0.95).count == 0);
}

TEST_CASE("quantiles lie between the order statistics, infinite ones too") {
    CHECK(quantileOf({1, 2, 3, 4}, 0.5) == 2.5);
    CHECK(quantileOf({1, 2, 3, 4}, 0) == 1);
    CHECK(quantileOf({1, 2, 3, 4}, 1) == 4);
    CHECK(quantileOf({7}, 0.3) == 7);
    CHECK(std::isinf(quantileOf({-INFINITY, -INFINITY, 3, 4}, 0.25)));
}

TEST_CASE("rank correlation: ties, monotone relations, infinite values") {
    CHECK(ranksOf({10, 20, 20, 5}) == std::vector<double>{2, 3.5, 3.5, 1});
    const std::vector<double> x = {1, 2, 3, 4, 5, 6};
    CHECK(rankCorrelation(x, {1, 8, 27, 64, 125, INFINITY}, 0.95).rho == doctest::Approx(1));
    CHECK(rankCorrelation(x, {6, 5, 4, 3, 2, -INFINITY}, 0.95).rho == doctest::Approx(-1));
    const Correlation some = rankCorrelation(x, {2, 1, 4, 3, 6, 5}, 0.95);
    CHECK(some.rho == doctest::Approx(1 - 6.0 * 6 / (6 * 35)));  // 1 - 6 sum d^2 / (n (n^2 - 1))
    CHECK(some.interval.low < some.rho);
    CHECK(some.interval.high > some.rho);
    CHECK_FALSE(rankCorrelation(x, {1, 1, 1, 1, 1, 1}, 0.95).known);
    CHECK_FALSE(rankCorrelation({1, 2}, {1, 2}, 0.95).known);
}

TEST_CASE("a histogram counts every value once") {
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i) values.push_back(0.001 * i);
    const Histogram histogram = histogramOf(values);
    std::uint64_t count = 0;
    for (const std::uint64_t cell : histogram.counts) count += cell;
    CHECK(count == 1000);
    CHECK(histogram.counts.size() == 11);  // a little less than 2 * 0.5 / 10 wide
    CHECK(histogramOf({3, 3, 3}).counts.size() == 5);
}

}  // namespace talus::tools::batch
