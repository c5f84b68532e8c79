#include "batch/plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/text.h"

namespace talus::tools::batch {

namespace {

constexpr std::size_t kFewValues = 30;   // of a column: drawn as a curve of means
constexpr std::size_t kMostDots = 2000;  // in one plot; more is a blot and a large file
constexpr std::size_t kMostSteps = 400;  // of a curve over the runs
constexpr std::size_t kMostCorrelations = 20;
constexpr std::size_t kFewestForMean = 5;

std::vector<double> finite(const std::vector<double>& values) {
    std::vector<double> kept;
    std::copy_if(values.begin(), values.end(), std::back_inserter(kept),
                 [](double v) { return std::isfinite(v); });
    return kept;
}

std::string columnTitle(const Summary& summary, std::size_t value) {
    const Column& column = summary.info.columns[summary.value_columns[value]];
    return column.name + (column.unit.empty() ? "" : " (" + column.unit + ")");
}

std::string confidenceText(const Summary& summary) {
    return text(100 * summary.info.confidence, 0) + " % confidence";
}

/// Those between the smallest and the largest answer; the others would stretch the axis.
void addThresholds(Plot& plot, const Summary& summary) {
    const auto answers = finite(summary.all.sorted);
    for (const double threshold : summary.info.thresholds)
        if (threshold >= answers.front() && threshold <= answers.back())
            plot.references.push_back({'x', threshold, {}, "dots", "", csvNumber(threshold)});
}

Series histogramBars(const std::vector<double>& sorted) {
    const Histogram histogram = histogramOf(sorted);
    Series bars{"bars", "bar", "", {}};
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double left = histogram.low + histogram.width * static_cast<double>(i);
        bars.add({left, left + histogram.width, static_cast<double>(histogram.counts[i])});
    }
    return bars;
}

struct Mean {
    double sum = 0, low = 0, high = 0;
    std::uint64_t count = 0;
    void add(double value) {
        low = count ? std::min(low, value) : value;
        high = count ? std::max(high, value) : value;
        sum += value;
        ++count;
    }
    double mean() const { return sum / static_cast<double>(count); }
};

std::map<double, Mean> meansOver(const Summary& summary, std::size_t value) {
    std::map<double, Mean> means;
    for (const Observation& seen : summary.observations)
        if (std::isfinite(seen.answer) && !std::isnan(seen.values[value]))
            means[seen.values[value]].add(seen.answer);
    return means;
}

void addMeans(Plot& plot, const std::map<double, Mean>& means) {
    Series band{"band", "band", "smallest to largest", {}}, line{"line", "theory", "mean", {}},
        dots{"points", "dem", "", {}, {}, "circle", 3.5};
    for (const auto& [value, mean] : means) {
        band.add({value, mean.low, mean.high});
        line.add({value, mean.mean()});
        dots.add({value, mean.mean()}, csvNumber(value) + ": " + text(mean.mean(), 4) + ", " +
                                           std::to_string(mean.count) + " runs");
    }
    plot.series = {std::move(band), std::move(line), std::move(dots)};
}

}  // namespace

std::vector<double> valuesOf(const Summary& summary, std::size_t value) {
    std::vector<double> values;
    for (const auto& entry : meansOver(summary, value)) values.push_back(entry.first);
    return values;
}

std::string thresholdText(const BatchInfo& info, double threshold) {
    return std::string(info.search() ? info.search()->answer : "") + " below " + csvNumber(threshold) +
           info.unitSymbol();
}

Plot plotHistogram(const Summary& summary) {
    Plot plot{"histogram", "Histogram of the " + summary.info.answerTitle(),
              "Number of runs in bins of equal width.", PlotAxis{summary.info.answerTitle()},
              PlotAxis{"runs"}};
    plot.series.push_back(histogramBars(finite(summary.all.sorted)));
    addThresholds(plot, summary);
    return plot;
}

Plot plotDistribution(const Summary& summary) {
    const std::vector<double>& sorted = summary.all.sorted;
    Plot plot{
        "share", "Share of the runs that have failed",
        "Empirical distribution of the " + summary.info.answerTitle() + " with its confidence band.",
        PlotAxis{summary.info.answerTitle()},
        PlotAxis{summary.info.search() ? "probability of failure" : "share of the runs", {0, 1}, 0.2, 1}};
    Series steps{"steps", "theory", "runs", {}};
    Series band{"band", "band", confidenceText(summary) + ", point by point", {}};
    const std::size_t stride = std::max<std::size_t>(1, sorted.size() / kMostSteps);
    for (std::size_t i = 0; i < sorted.size(); i += stride) {
        if (!std::isfinite(sorted[i])) continue;
        const Interval interval = shareInterval(i + 1, sorted.size(), summary.info.confidence);
        steps.add({sorted[i], static_cast<double>(i + 1) / static_cast<double>(sorted.size())});
        band.add({sorted[i], interval.low, interval.high});
    }
    plot.series = {std::move(band), std::move(steps)};
    addThresholds(plot, summary);
    return plot;
}

Plot plotConvergence(const Summary& summary, std::size_t threshold) {
    const double value = summary.info.thresholds[threshold];
    Plot plot{
        "convergence-" + std::to_string(threshold),
        "Probability of a " + thresholdText(summary.info, value) + ", with the number of runs",
        "The share of the first runs, in the order in which they were drawn, and its confidence interval.",
        PlotAxis{"decided runs"}, PlotAxis{"probability of failure"}};
    Series share{"line", "theory", "share that failed", {}};
    Series band{"band", "band", confidenceText(summary), {}};
    const std::uint64_t all = summary.all.failure[threshold].count;
    const std::uint64_t stride = 1 + all / kMostSteps;
    std::uint64_t count = 0, failed = 0;
    for (const Observation& seen : summary.observations) {
        const auto has_failed = hasFailed(seen, seen.answer, value);
        if (!has_failed) continue;
        ++count;
        failed += *has_failed;
        if (count % stride != 0 && count != all) continue;
        const auto n = static_cast<double>(count);
        const Interval interval = shareInterval(failed, count, summary.info.confidence);
        share.add({n, static_cast<double>(failed) / n});
        band.add({n, interval.low, interval.high});
    }
    plot.series = {std::move(band), std::move(share)};
    return plot;
}

Plot plotMeanConvergence(const Summary& summary) {
    Plot plot{
        "convergence-mean", "Mean of the " + summary.info.answerTitle() + ", with the number of runs",
        "The mean of the first runs, in the order in which they were drawn, and its confidence interval.",
        PlotAxis{"runs with an answer"}, PlotAxis{summary.info.answerTitle()}};
    Series mean{"line", "theory", "mean", {}};
    Series band{"band", "band", confidenceText(summary), {}};
    std::vector<double> answers;
    const std::size_t stride = 1 + summary.all.moments.count / kMostSteps;
    for (const Observation& seen : summary.observations) {
        if (!std::isfinite(seen.answer)) continue;
        answers.push_back(seen.answer);
        const std::size_t count = answers.size();
        // The interval of the first few is so wide that it would hide the rest.
        if (count < kFewestForMean || (count % stride != 0 && count != summary.all.moments.count)) continue;
        const Moments moments = momentsOf(answers, summary.info.confidence);
        mean.add({static_cast<double>(count), moments.mean});
        band.add({static_cast<double>(count), moments.mean_interval.low, moments.mean_interval.high});
    }
    plot.series = {std::move(band), std::move(mean)};
    return plot;
}

Plot plotInput(const Summary& summary, std::size_t value) {
    std::vector<double> drawn;
    for (const Observation& seen : summary.observations)
        if (std::isfinite(seen.values[value])) drawn.push_back(seen.values[value]);
    std::sort(drawn.begin(), drawn.end());
    Plot plot{"input-" + std::to_string(value), columnTitle(summary, value), "",
              PlotAxis{columnTitle(summary, value)}, PlotAxis{"runs"}};
    if (!drawn.empty()) plot.series.push_back(histogramBars(drawn));
    return plot;
}

Plot plotCorrelations(const Summary& summary) {
    Plot plot{"correlations", "Rank correlation of the answer with each column that varies", "",
              PlotAxis{"Spearman\u2019s rank correlation with the answer", {-1, 1}, 0.5, 1}, PlotAxis{""}};
    plot.y.first_on_top = true;
    Series bars{"correlation", "bar", "", {}};
    for (std::size_t i = 0; i < std::min(summary.sensitivities.size(), kMostCorrelations); ++i) {
        const Sensitivity& one = summary.sensitivities[i];
        const auto& [rho, interval] = std::pair{one.correlation.rho, one.correlation.interval};
        plot.y.categories.push_back(one.column);
        bars.add({static_cast<double>(i), rho, interval.low, interval.high},
                 one.column + ": " + text(rho, 3) + " (" + text(interval.low, 3) + " to " +
                     text(interval.high, 3) + ")");
    }
    plot.series.push_back(std::move(bars));
    return plot;
}

Plot plotResponse(const Summary& summary, std::size_t value) {
    const auto means = meansOver(summary, value);
    Plot plot{"response-" + std::to_string(value),
              summary.info.answerTitle() + " against " + columnTitle(summary, value), "",
              PlotAxis{columnTitle(summary, value)}, PlotAxis{summary.info.answerTitle()}};
    if (means.size() <= kFewValues) {
        addMeans(plot, means);
        return plot;
    }
    Series dots{"points", "dot", "", {}, {}, "circle", 2.2};
    const bool names_runs = summary.observations.size() <= 500;
    const std::size_t stride = 1 + summary.observations.size() / kMostDots;
    for (std::size_t i = 0; i < summary.observations.size(); i += stride) {
        const Observation& seen = summary.observations[i];
        if (!std::isfinite(seen.answer) || std::isnan(seen.values[value])) continue;
        dots.add({seen.values[value], seen.answer});
        if (names_runs) dots.tips.push_back("run " + std::to_string(seen.run));
    }
    plot.series.push_back(std::move(dots));
    return plot;
}

Plot plotHeatMap(const Summary& summary, std::size_t x_value, std::size_t y_value) {
    std::map<std::pair<double, double>, Mean> cells;
    for (const Observation& seen : summary.observations)
        if (std::isfinite(seen.answer)) cells[{seen.values[x_value], seen.values[y_value]}].add(seen.answer);
    const auto columns = valuesOf(summary, x_value), rows = valuesOf(summary, y_value);
    Plot plot{"map-" + std::to_string(x_value) + "-" + std::to_string(y_value),
              "Mean " + summary.info.answerTitle(),
              "Over " + columnTitle(summary, x_value) + " and " + columnTitle(summary, y_value) + ".",
              PlotAxis{columnTitle(summary, x_value)}, PlotAxis{columnTitle(summary, y_value)}};
    for (const double column : columns) plot.x.categories.push_back(csvNumber(column));
    for (const double row : rows) plot.y.categories.push_back(csvNumber(row));
    Series means{"cells", "bar", "", {}};
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const auto cell = cells.find({columns[c], rows[r]});
            if (cell == cells.end()) continue;
            const double mean = cell->second.mean();
            means.add({static_cast<double>(c), static_cast<double>(r), mean},
                      csvNumber(columns[c]) + ", " + csvNumber(rows[r]) + ": " + text(mean, 4));
        }
    plot.series.push_back(std::move(means));
    return plot;
}

}  // namespace talus::tools::batch
