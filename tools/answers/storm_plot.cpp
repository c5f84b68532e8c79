// Factor of safety and level over a rain, one curve above the other axis each. Without water that changes,
// strength has the other axis.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "answers/storm.h"
#include "cli/text.h"
#include "report/svg.h"

namespace talus::tools {

namespace {

constexpr int kSteps = 8;                                       // ticks of an axis
constexpr double kRoom = 0.05;                                  // of the range, above and below a curve
constexpr std::array kRoles{"water-line", "theory", "answer"};  // of levels or strengths, in turn

struct TimeUnit {
    const char* name;
    double seconds;
};

TimeUnit unitFor(double seconds) {
    if (seconds > 3 * 86400.0) return {"days", 86400};
    if (seconds > 2 * 3600.0) return {"h", 3600};
    return seconds > 2 * 60.0 ? TimeUnit{"min", 60} : TimeUnit{"s", 1};
}

bool hasFactor(const StormPoint& point) { return point.status == SearchStatus::found; }

class StormPlot {
 public:
    explicit StormPlot(const StormResult& result)
        : result_(result), unit_(unitFor(result.points.empty() ? 0.0 : result.points.back().time)) {}

    Plot plot(const std::string& scenario) const {
        const std::string name = std::filesystem::path(scenario).filename().string();
        Plot plot{"storm", name + title(), "The factor of safety and the " + what() + " over time.", xAxis(),
                  factorAxis()};
        plot.right = rightAxis();
        const auto& names = hasLevels() ? result_.waters : result_.joints;
        for (std::size_t k = 0; k < names.size(); ++k) addCause(plot, names, k);
        addFactor(plot);
        plot.references.push_back({'y', 1, {}, "rule", "", "factor 1"});
        if (result_.failure_time)
            plot.references.push_back({'x', time(*result_.failure_time), {}, "dots", "factor falls below 1"});
        return plot;
    }

 private:
    double time(double seconds) const { return seconds / unit_.seconds; }

    std::string title() const {
        if (!result_.least || !hasFactor(result_.points[*result_.least]))
            return ": factor of safety over time";
        return ": least factor of safety " + text(result_.points[*result_.least].factor, 3);
    }

    PlotAxis xAxis() const {
        const double end = result_.points.empty() ? 1.0 : result_.points.back().time;
        return axisOver(std::string("time (") + unit_.name + ")", 0, time(end), kSteps);
    }

    /// Around values, and 1 where they come near it.
    PlotAxis factorAxis() const {
        double low = 1, high = 1;
        for (const StormPoint& point : result_.points)
            if (hasFactor(point)) low = std::min(low, point.factor), high = std::max(high, point.factor);
        const double room = kRoom * std::max(high - low, 0.1);
        return axisOver("factor of safety", std::max(0.0, low - room), high + room, kSteps);
    }

    bool hasLevels() const { return !result_.waters.empty(); }
    std::string what() const { return hasLevels() ? "water level" : "strength"; }
    const std::vector<double>& causes(const StormPoint& point) const {
        return hasLevels() ? point.levels : point.strengths;
    }

    PlotAxis rightAxis() const {
        double low = kInfinity, high = -kInfinity;
        for (const StormPoint& point : result_.points)
            for (const double value : causes(point)) low = std::min(low, value), high = std::max(high, value);
        if (!(low <= high)) low = high = 0;
        return axisOver(hasLevels() ? "water level (m)" : "factor of strength", low,
                        high + kRoom * (high - low), kSteps);
    }

    /// The level of one water, or the strength of joints that change alike.
    void addCause(Plot& plot, const std::vector<std::string>& names, std::size_t k) const {
        const std::string word = hasLevels() ? "level" : "strength";
        Series line{
            "line", kRoles[k % kRoles.size()], names.size() > 1 ? word + " of " + names[k] : word, {}};
        line.right = true;
        for (const StormPoint& point : result_.points) line.add({time(point.time), causes(point)[k]});
        plot.series.push_back(std::move(line));
    }

    /// A line each between times without a factor.
    void addFactor(Plot& plot) const {
        Series line{"line", "path", "factor of safety", {}};
        Series searched{"points", "dem", "search", {}, {}, "circle", 2.6};
        for (const StormPoint& point : result_.points) {
            if (!hasFactor(point)) {
                if (!line.rows.empty()) plot.series.push_back(std::exchange(line, {"line", "path", "", {}}));
                continue;
            }
            line.add({time(point.time), point.factor});
            if (!point.interpolated) searched.add({time(point.time), point.factor}, text(point.factor, 4));
        }
        plot.series.push_back(std::move(line));
        plot.series.push_back(std::move(searched));
    }

    const StormResult& result_;
    TimeUnit unit_;
};

}  // namespace

Plot stormPlot(const StormResult& result, const std::string& scenario) {
    return StormPlot(result).plot(scenario);
}

}  // namespace talus::tools
