#include "batch/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "talus/formats/distribution.h"

namespace talus::tools::batch {

namespace {

/// Pearson's correlation; 0 when one of the two does not vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

}  // namespace

Interval shareInterval(std::uint64_t hits, std::uint64_t count, double confidence) {
    const double tail = 0.5 * (1 - confidence);
    const auto k = static_cast<double>(hits), n = static_cast<double>(count);
    return {hits == 0 ? 0 : formats::betaQuantile(k, n - k + 1, tail),
            hits == count ? 1 : formats::betaQuantile(k + 1, n - k, 1 - tail)};
}

double studentQuantile(double freedom, double confidence) {
    // X = nu / (nu + T^2) has the beta distribution (nu/2, 1/2).
    const double x = formats::betaQuantile(0.5 * freedom, 0.5, 1 - confidence);
    return std::sqrt(freedom * (1 - x) / x);
}

Moments momentsOf(const std::vector<double>& values, double confidence) {
    Moments moments;
    moments.count = values.size();
    if (values.empty()) return moments;
    const auto n = static_cast<double>(values.size());
    moments.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    moments.mean_interval = {moments.mean, moments.mean};
    if (values.size() < 2) return moments;
    double squares = 0;
    for (const double value : values) squares += (value - moments.mean) * (value - moments.mean);
    moments.sd = std::sqrt(squares / (n - 1));
    const double half = studentQuantile(n - 1, confidence) * moments.sd / std::sqrt(n);
    moments.mean_interval = {moments.mean - half, moments.mean + half};
    return moments;
}

double quantileOf(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(below);
    if (below + 1 >= sorted.size() || part == 0) return sorted[below];
    if (!std::isfinite(sorted[below]) || !std::isfinite(sorted[below + 1]))
        return sorted[part < 0.5 ? below : below + 1];
    return sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

std::vector<double> ranksOf(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
        while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
        for (std::size_t i = first; i < last; ++i)
            ranks[order[i]] = 0.5 * static_cast<double>(first + last + 1);
    }
    return ranks;
}

Correlation rankCorrelation(const std::vector<double>& x, const std::vector<double>& y, double confidence) {
    constexpr std::size_t kFewest = 5;
    const auto varies = [](const std::vector<double>& values) {
        return std::any_of(values.begin(), values.end(),
                           [&](double value) { return value != values.front(); });
    };
    if (x.size() < kFewest || !varies(x) || !varies(y)) return {};
    const double rho = correlation(ranksOf(x), ranksOf(y));
    const double bounded = std::clamp(rho, -1 + 1e-12, 1 - 1e-12);
    const double error = std::sqrt((1 + 0.5 * rho * rho) / (static_cast<double>(x.size()) - 3));
    const double half = formats::normalQuantile(0.5 + 0.5 * confidence) * error;
    return {true, rho, {std::tanh(std::atanh(bounded) - half), std::tanh(std::atanh(bounded) + half)}};
}

Histogram histogramOf(const std::vector<double>& sorted) {
    const double range = sorted.back() - sorted.front();
    const double spread = quantileOf(sorted, 0.75) - quantileOf(sorted, 0.25);
    const double wanted = 2 * spread / std::cbrt(static_cast<double>(sorted.size()));
    const double cells = wanted > 0 ? std::clamp(std::ceil(range / wanted), 5.0, 40.0) : 5;
    Histogram histogram;
    histogram.width = range > 0 ? range / cells : 1;
    histogram.low = range > 0 ? sorted.front() : sorted.front() - 0.5 * cells;
    histogram.counts.assign(static_cast<std::size_t>(cells), 0);
    for (const double value : sorted) {
        const auto cell = static_cast<std::size_t>((value - histogram.low) / histogram.width);
        ++histogram.counts[std::min(cell, histogram.counts.size() - 1)];
    }
    return histogram;
}

}  // namespace talus::tools::batch
