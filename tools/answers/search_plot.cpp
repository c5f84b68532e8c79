#include "answers/search_plot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "report/numbers.h"
#include "report/svg.h"

namespace talus::tools {

namespace {

constexpr int kSteps = 8;             // of each axis, about
constexpr double kHeadroom = 0.06;    // of the loads, above the highest: for the words at the answer
constexpr double kToTheRight = 0.02;  // of the displacements
constexpr double kMuchFarther = 3;    // a failure displacement beyond that many times the curve is left out

struct LengthUnit {
    const char* name;
    double metres;
};

/// The unit in which the largest displacement has few digits.
LengthUnit unitFor(double metres) {
    if (metres >= 0.5) return {"m", 1};
    if (metres >= 5e-6) return {"mm", 1e-3};
    return {"\u00b5m", 1e-6};
}

class SearchPlot {
 public:
    SearchPlot(const LoadSearch& search, const SearchResult& result, double failure)
        : search_(search),
          result_(result),
          scale_(search.load->scale),
          failure_(failure),
          farthest_(farthest()),
          unit_(unitFor(farthest_)) {
        if (failure_ > kMuchFarther * farthest_) failure_ = 0;
    }

    Plot plot(const std::string& scenario) const {
        Plot plot{"load-displacement", title(scenario),
                  "The load against the largest displacement of a block.", xAxis(), yAxis()};
        addInterval(plot);
        addFailureDisplacement(plot);
        addAnswer(plot);
        addCurve(plot);
        addBracket(plot);
        return plot;
    }

 private:
    double x(std::size_t k) const { return result_.path[k].displacement / unit_.metres; }
    double y(std::size_t k) const { return result_.path[k].load / scale_; }

    double farthest() const {
        double most = 0;
        for (const PathPoint& point : result_.path) most = std::max(most, point.displacement);
        return most;
    }

    bool isFound() const { return result_.status == SearchStatus::found; }
    std::string figure(double load) const { return loadFigure(search_, load, search_.load->decimals); }
    std::string unit() const {
        return *search_.load->unit == '\0' ? "" : std::string(" ") + search_.load->unit;
    }

    std::string title(const std::string& scenario) const {
        const std::string name = std::filesystem::path(scenario).filename().string();
        if (isFound()) return name + ": " + search_.answer + " " + figure(result_.answer) + unit();
        return name + ": " + search_.answer + ", none found";
    }

    PlotAxis xAxis() const {
        const double most = std::max(farthest_, failure_) / unit_.metres;
        return axisOver(std::string("largest displacement of a block (") + unit_.name + ")", 0,
                        (1 + kToTheRight) * most, kSteps);
    }

    PlotAxis yAxis() const {
        double low = y(0), high = low;
        const auto add = [&](double load) {
            if (!std::isfinite(load)) return;
            low = std::min(low, load / scale_);
            high = std::max(high, load / scale_);
        };
        for (const PathPoint& point : result_.path) add(point.load);
        if (isFound()) add(result_.high);
        if (result_.answer_interval)
            add(result_.answer_interval->first), add(result_.answer_interval->second);
        const std::string of = *search_.load->unit == '\0' ? "" : " (\u00b0)";
        return axisOver(search_.load->text + of, low, high + kHeadroom * (high - low), kSteps);
    }

    /// Successive equilibria; a new line where the displacement is reset.
    void addCurve(Plot& plot) const {
        const std::size_t last_leg = lastLeg();
        Series before{"line", "rule", "loading path from a greater strength", {}},
            curve{"line", "path", "loading path", {}}, dots{"points", "dem", "", {}, {}, "circle", 1.6};
        for (std::size_t k = 0; k < result_.path.size(); ++k) {
            (k < last_leg ? before : curve).add({x(k), y(k)});
            dots.add({x(k), y(k)}, figure(result_.path[k].load) + unit());
        }
        if (!before.rows.empty()) plot.series.push_back(std::move(before));
        plot.series.push_back(std::move(curve));
        plot.series.push_back(std::move(dots));
    }

    /// The last reset of the displacements.
    std::size_t lastLeg() const {
        std::size_t begin = 0;
        for (std::size_t k = 1; k < result_.path.size(); ++k)
            if (result_.path[k].displacement == 0 && result_.path[k - 1].displacement > 0) begin = k;
        return begin;
    }

    void addInterval(Plot& plot) const {
        if (!result_.answer_interval) return;
        const auto [low, high] = *result_.answer_interval;
        if (!(low < high)) return;
        plot.references.push_back({'y', low / scale_, high / scale_, "band",
                                   "interval " + figure(low) + " to " + figure(high) + unit()});
    }

    void addAnswer(Plot& plot) const {
        if (!isFound()) return;
        plot.references.push_back({'y',
                                   result_.answer / scale_,
                                   {},
                                   "answer",
                                   "",
                                   std::string(search_.answer) + " " + figure(result_.answer) + unit() +
                                       ": stands at " + figure(result_.low) + ", fails at " +
                                       figure(result_.high)});
    }

    void addFailureDisplacement(Plot& plot) const {
        if (!(failure_ > 0)) return;
        char text[48];
        std::snprintf(text, sizeof text, "failure displacement %.3g %s", failure_ / unit_.metres, unit_.name);
        plot.references.push_back({'x', failure_ / unit_.metres, {}, "dots", "", text});
    }

    /// The first failing point, and before it the equilibrium at the largest load.
    void addBracket(Plot& plot) const {
        const auto& probes = result_.probes;
        const auto left = std::find_if(probes.begin(), probes.end(),
                                       [](const Probe& probe) { return probe.verdict == Verdict::failing; });
        if (left == probes.end() || probes.size() != result_.path.size()) return;
        const auto fails = static_cast<std::size_t>(left - probes.begin());
        std::optional<std::size_t> highest;
        for (std::size_t k = lastLeg(); k < fails; ++k)
            if (!highest || result_.path[k].load >= result_.path[*highest].load) highest = k;
        Series stands{"points", "dem", "largest load at which the slope stands", {}, {}, "circle", 4.5};
        Series leaves{"points", "dem-open", "failure", {}, {}, "circle", 4.5};
        if (highest) stands.add({x(*highest), y(*highest)});
        leaves.add({x(fails), y(fails)});
        if (highest) plot.series.push_back(std::move(stands));
        plot.series.push_back(std::move(leaves));
    }

    const LoadSearch& search_;
    const SearchResult& result_;
    double scale_;
    double failure_;   ///< displacement [m]; 0: not drawn
    double farthest_;  ///< [m]
    LengthUnit unit_;
};

}  // namespace

Plot searchPlot(const LoadSearch& search, const SearchResult& result, const std::string& scenario,
                double failure) {
    return SearchPlot(search, result, failure).plot(scenario);
}

double failureDisplacement(const SearchResult& result, const Model& model) {
    std::vector<double> sizes;
    for (const Block& block : model.blocks) sizes.push_back(smallestExtent(block.shape));
    if (sizes.empty()) return 0;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return result.failure_displacement * *middle;
}

}  // namespace talus::tools
