#include "batch/plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/command.h"

namespace talus::tools::batch {

namespace {

using Symbol = LegendEntry::Symbol;

constexpr std::size_t kFewValues = 30;   // of a column: drawn as a curve of means
constexpr std::size_t kMostDots = 2000;  // in one plot; more is a blot and a large file
constexpr int kHeatLevels = 8;

int decimalsOf(double step) { return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))); }

/// An axis over lo..hi and a little more, ends on round numbers.
Axis axisOver(double lo, double hi, double from, double to, std::string title) {
    if (!(hi > lo)) {
        const double half = lo == 0 ? 0.5 : 0.05 * std::abs(lo);
        lo -= half;
        hi += half;
    }
    const double step = niceStep(hi - lo, 6);
    return {std::floor(lo / step + 1e-9) * step,
            std::ceil(hi / step - 1e-9) * step,
            from,
            to,
            std::move(title),
            step,
            decimalsOf(step)};
}

std::vector<double> finiteAnswers(const Summary& summary) {
    std::vector<double> answers;
    for (const double answer : summary.all.sorted)
        if (std::isfinite(answer)) answers.push_back(answer);
    return answers;
}

Axis answerAxis(const Summary& summary, double from, double to) {
    const auto answers = finiteAnswers(summary);
    return axisOver(answers.front(), answers.back(), from, to, summary.info.answerTitle());
}

std::string columnTitle(const Summary& summary, std::size_t value) {
    const Column& column = summary.info.columns[summary.value_columns[value]];
    return column.name + (column.unit.empty() ? "" : " (" + column.unit + ")");
}

void drawThresholds(Svg& svg, const Summary& summary, const Axis& x, const Axis& y) {
    for (const double threshold : summary.info.thresholds)
        if (threshold >= x.lo && threshold <= x.hi)
            svg.line({x.at(threshold), y.from}, {x.at(threshold), y.to}, "dots");
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

void drawMeans(Svg& svg, const std::map<double, Mean>& means, const Axis& x, const Axis& y) {
    std::vector<Spot> band, back, line;
    for (const auto& [value, mean] : means) {
        band.push_back({x.at(value), y.at(mean.low)});
        back.push_back({x.at(value), y.at(mean.high)});
        line.push_back({x.at(value), y.at(mean.mean())});
    }
    band.insert(band.end(), back.rbegin(), back.rend());
    svg.polygon(band, "band");
    svg.path(line, "theory");
    for (const auto& [value, mean] : means)
        svg.circle(
            {x.at(value), y.at(mean.mean())}, 3.5, "dem",
            csvNumber(value) + ": " + text(mean.mean(), 4) + ", " + std::to_string(mean.count) + " runs");
}

std::string heatClass(double share) {
    return "heat" + std::to_string(std::clamp(static_cast<int>(share * kHeatLevels), 0, kHeatLevels - 1));
}

}  // namespace

std::vector<double> valuesOf(const Summary& summary, std::size_t value) {
    std::vector<double> values;
    for (const auto& entry : meansOver(summary, value)) values.push_back(entry.first);
    return values;
}

Svg plotHistogram(const Summary& summary) {
    const auto answers = finiteAnswers(summary);
    const Histogram histogram = histogramOf(answers);
    const double end = histogram.low + histogram.width * static_cast<double>(histogram.counts.size());
    const auto highest = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    Svg svg(720, 340, "Histogram of the " + summary.info.answerTitle(),
            "Number of runs in each of " + std::to_string(histogram.counts.size()) + " equal cells.");
    const Axis x = axisOver(histogram.low, end, 64, 704, summary.info.answerTitle());
    const double step = std::max(1.0, niceStep(static_cast<double>(highest), 5));
    const Axis y{0, std::ceil(static_cast<double>(highest) / step) * step, 285, 16, "runs", step, 0};
    drawAxes(svg, x, y);
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double left = histogram.low + histogram.width * static_cast<double>(i);
        const double right = left + histogram.width, top = static_cast<double>(histogram.counts[i]);
        svg.polygon({{x.at(left), y.at(0)},
                     {x.at(left), y.at(top)},
                     {x.at(right), y.at(top)},
                     {x.at(right), y.at(0)}},
                    "bar",
                    csvNumber(left) + " to " + csvNumber(right) + ": " + std::to_string(histogram.counts[i]) +
                        " runs");
    }
    drawThresholds(svg, summary, x, y);
    return svg;
}

Svg plotDistribution(const Summary& summary) {
    const std::vector<double>& sorted = summary.all.sorted;
    Svg svg(720, 400, "Share of the runs that have failed",
            "Empirical distribution of the " + summary.info.answerTitle() + " with its confidence band.");
    const Axis x = answerAxis(summary, 64, 704);
    const Axis y{0,   1, 345, 16, summary.info.search() ? "probability of failure" : "share of the runs",
                 0.2, 1};
    std::vector<Spot> steps, low, high;
    const std::size_t stride = std::max<std::size_t>(1, sorted.size() / 400);
    for (std::size_t i = 0; i < sorted.size(); i += stride) {
        if (!std::isfinite(sorted[i])) continue;
        const Interval interval = shareInterval(i + 1, sorted.size(), summary.info.confidence);
        const double at = x.at(sorted[i]);
        if (!steps.empty()) steps.push_back({at, steps.back().y});
        steps.push_back({at, y.at(static_cast<double>(i + 1) / static_cast<double>(sorted.size()))});
        low.push_back({at, y.at(interval.low)});
        high.push_back({at, y.at(interval.high)});
    }
    low.insert(low.end(), high.rbegin(), high.rend());
    svg.polygon(low, "band");
    drawAxes(svg, x, y);
    svg.path(steps, "theory");
    drawThresholds(svg, summary, x, y);
    drawLegend(svg, {x.from + 16, y.to + 18},
               {{"runs", Symbol::line, "theory", 5},
                {text(100 * summary.info.confidence, 0) + " % confidence, point by point", Symbol::patch,
                 "band", 5}});
    return svg;
}

Svg plotTornado(const Summary& summary) {
    const std::size_t count = std::min<std::size_t>(summary.sensitivities.size(), 20);
    const double height = 28.0 * static_cast<double>(count);
    Svg svg(720, height + 70, "Sensitivity", "Rank correlation of the answer with each column that varies.");
    const Axis x{-1, 1, 300, 704, "Spearman's rank correlation with the answer", 0.5, 1};
    const Axis y{0, 1, height + 16, 16, "", 0, 0};
    drawAxes(svg, x, y);
    for (std::size_t i = 0; i < count; ++i) {
        const Sensitivity& one = summary.sensitivities[i];
        const double top = 21 + 28.0 * static_cast<double>(i), middle = top + 9;
        const Interval& interval = one.correlation.interval;
        const double end = x.at(one.correlation.rho);
        svg.polygon({{x.at(0), top}, {end, top}, {end, top + 18}, {x.at(0), top + 18}}, "bar",
                    one.column + ": " + text(one.correlation.rho, 3) + " (" + text(interval.low, 3) + " to " +
                        text(interval.high, 3) + ")");
        svg.line({x.at(interval.low), middle}, {x.at(interval.high), middle}, "frame");
        svg.label({x.from - 10, middle + 4}, one.column, "end");
    }
    svg.line({x.at(0), y.from}, {x.at(0), y.to}, "frame");
    return svg;
}

Svg plotResponse(const Summary& summary, std::size_t value) {
    const auto means = meansOver(summary, value);
    Svg svg(720, 380, summary.info.answerTitle() + " against " + columnTitle(summary, value),
            "One dot per run, or the mean and the range of the runs at each value.");
    const Axis x =
        axisOver(means.begin()->first, means.rbegin()->first, 64, 704, columnTitle(summary, value));
    const Axis y = answerAxis(summary, 325, 16);
    drawAxes(svg, x, y);
    if (means.size() <= kFewValues) {
        drawMeans(svg, means, x, y);
        return svg;
    }
    const std::size_t stride = 1 + summary.observations.size() / kMostDots;
    for (std::size_t i = 0; i < summary.observations.size(); i += stride) {
        const Observation& seen = summary.observations[i];
        if (std::isfinite(seen.answer) && !std::isnan(seen.values[value]))
            svg.circle({x.at(seen.values[value]), y.at(seen.answer)}, 2.2, "dot",
                       summary.observations.size() <= 500 ? "run " + std::to_string(seen.run) : "");
    }
    return svg;
}

Svg plotHeatMap(const Summary& summary, std::size_t x_value, std::size_t y_value) {
    std::map<std::pair<double, double>, Mean> cells;
    for (const Observation& seen : summary.observations)
        if (std::isfinite(seen.answer)) cells[{seen.values[x_value], seen.values[y_value]}].add(seen.answer);
    const auto columns = valuesOf(summary, x_value), rows = valuesOf(summary, y_value);
    double low = kInfinity, high = -kInfinity;
    for (const auto& entry : cells) {
        low = std::min(low, entry.second.mean());
        high = std::max(high, entry.second.mean());
    }
    const double height = std::min(40.0 * static_cast<double>(rows.size()), 480.0);
    Svg svg(720, height + 80, "Mean " + summary.info.answerTitle(),
            "Over " + columnTitle(summary, x_value) + " and " + columnTitle(summary, y_value) + ".");
    const Axis x{0, static_cast<double>(columns.size()), 84, 704, columnTitle(summary, x_value), 0, 0};
    const Axis y{0, static_cast<double>(rows.size()), height + 16, 16, columnTitle(summary, y_value), 0, 2};
    const bool has_labels = columns.size() <= 12;
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const auto cell = cells.find({columns[c], rows[r]});
            if (cell == cells.end()) continue;
            const double left = static_cast<double>(c), bottom = static_cast<double>(r),
                         mean = cell->second.mean();
            const double share = high > low ? (mean - low) / (high - low) : 0.5;
            svg.polygon({{x.at(left), y.at(bottom)},
                         {x.at(left), y.at(bottom + 1)},
                         {x.at(left + 1), y.at(bottom + 1)},
                         {x.at(left + 1), y.at(bottom)}},
                        heatClass(share),
                        csvNumber(columns[c]) + ", " + csvNumber(rows[r]) + ": " + text(mean, 4));
            if (has_labels)
                svg.label({x.at(left + 0.5), y.at(bottom + 0.5) + 4}, text(mean, 2), "middle",
                          share < 0.5 ? "heat-light" : "heat-dark");
        }
    drawAxes(svg, x, y);
    const std::size_t stride = 1 + columns.size() / 16;
    for (std::size_t c = 0; c < columns.size(); c += stride)
        svg.label({x.at(static_cast<double>(c) + 0.5), y.from + 18}, csvNumber(columns[c]), "middle");
    for (std::size_t r = 0; r < rows.size(); r += 1 + rows.size() / 16)
        svg.label({x.from - 8, y.at(static_cast<double>(r) + 0.5) + 4}, csvNumber(rows[r]), "end");
    return svg;
}

std::string heatStyle(const std::string& scope) {
    // Viridis in eight steps: even in lightness, so that it survives grey print and colour blindness.
    constexpr const char* kColours[kHeatLevels] = {"#440154", "#46327e", "#365c8d", "#277f8e",
                                                   "#1fa187", "#4ac16d", "#a0da39", "#fde725"};
    std::string css;
    for (int i = 0; i < kHeatLevels; ++i)
        css += scope + ".heat" + std::to_string(i) + "{fill:" + kColours[i] + "}\n";
    return css + scope + ".heat-light{fill:#fff;font:12px system-ui,sans-serif}\n" + scope +
           ".heat-dark{fill:#111;font:12px system-ui,sans-serif}\n";
}

}  // namespace talus::tools::batch
