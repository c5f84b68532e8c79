#include "report/svg.h"

#include <algorithm>
#include <cmath>

#include "cli/text.h"
#include "report/numbers.h"
#include "report/svg_writer.h"

namespace talus::tools {
namespace {

constexpr double kLetter = 7;  ///< width of a letter, about [px]

/// The classes' looks; colours colour-blind safe (Okabe and Ito) and apart in grey as well, those of
/// page/page.css.
constexpr std::string_view kStyle = R"css(
.text{fill:#1a1a1a;font:13px system-ui,sans-serif}
.small{fill:#595959;font:12px system-ui,sans-serif;paint-order:stroke;stroke:#fff;stroke-opacity:.8;stroke-width:3px}
.caption{fill:#1a1a1a;font:600 14px system-ui,sans-serif}
.page{fill:#fff}
.frame{stroke:#1a1a1a;stroke-width:1;fill:none}
.grid{stroke:#ddd;stroke-width:1}
.band{fill:#cfe3ef;stroke:none}
.theory{stroke:#0072b2;stroke-width:2;fill:none}
.path{stroke:#b34700;stroke-width:2;fill:none;stroke-linejoin:round}
.answer{stroke:#009e73;stroke-width:1.6;fill:none}
.rule{stroke:#595959;stroke-width:1.2;stroke-dasharray:7 4;fill:none}
.dots{stroke:#595959;stroke-width:1.2;stroke-dasharray:2 3;fill:none}
.dem{fill:#b34700;stroke:#b34700;stroke-width:1.5}
.dem-open{fill:#fff;stroke:#b34700;stroke-width:1.8}
.dem-ring{fill:none;stroke:#b34700;stroke-width:1.8}
.laboratory{fill:none;stroke:#1a1a1a;stroke-width:1.8}
.repeat{fill:#1a1a1a;stroke:none}
.water{fill:#0072b2;stroke:#0072b2;stroke-width:1}
.water-line{fill:none;stroke:#0072b2;stroke-width:1.6}
.stable,.fixed,.sliding,.mixed,.toppling{stroke:#1a1a1a;stroke-width:.7;stroke-linejoin:round}
.stable{fill:#ececec}
.fixed{fill:#b4b4b4}
.sliding{fill:#e69f00}
.mixed{fill:#009e73}
.toppling{fill:#7a2f6b}
)css";

// --- plots
// ----------------------------------------------------------------------------------------------------------

/// Values of an axis onto pixels from..to.
struct Scale {
    const PlotAxis& axis;
    double from, to;

    double low() const { return axis.categories.empty() ? axis.domain.at(0) : -0.5; }
    double high() const {
        return axis.categories.empty() ? axis.domain.at(1)
                                       : static_cast<double>(axis.categories.size()) - 0.5;
    }
    double at(double value) const {
        if (axis.logarithmic) return from + std::log(value / low()) / std::log(high() / low()) * (to - from);
        return from + (value - low()) / (high() - low()) * (to - from);
    }

    /// Places and labels of ticks.
    std::vector<std::pair<double, std::string>> ticks() const {
        if (axis.logarithmic) return decades();
        std::vector<std::pair<double, std::string>> ticks;
        for (std::size_t i = 0; i < axis.categories.size(); ++i)
            ticks.emplace_back(static_cast<double>(i), axis.categories[i]);
        if (axis.categories.empty() && axis.step > 0)
            for (double i = std::ceil(low() / axis.step - 1e-9); i * axis.step <= high() + 1e-9 * axis.step;
                 ++i)
                ticks.emplace_back(i * axis.step,
                                   typeset(text(i * axis.step + 0.0, std::max(0, axis.decimals))));
        return ticks;
    }

    /// 1, 2 and 5 times powers of ten; over many decades the powers alone.
    std::vector<std::pair<double, std::string>> decades() const {
        constexpr double kFew = 3.2;
        const bool few = std::log10(high() / low()) < kFew;
        std::vector<std::pair<double, std::string>> ticks;
        for (double power = std::floor(std::log10(low())); std::pow(10, power) <= high(); ++power) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double value = digit * std::pow(10, power);
                if ((digit > 1 && !few) || value < low() || value > high()) continue;
                ticks.emplace_back(value, typeset(text(value, std::max(0, static_cast<int>(-power)))));
            }
        }
        return ticks;
    }
};

class PlotFile {
 public:
    PlotFile(const Plot& plot, bool titled) : plot_(plot), titled_(titled) {}

    std::string write() {
        if (titled_) svg_.label({kLeft, 24}, plot_.title, "start", "caption");
        for (const Reference& reference : plot_.references)
            if (reference.to) draw(reference);
        for (const Series& series : plot_.series)
            if (series.type == "band") drawBand(series);
        drawAxes();
        for (const Reference& reference : plot_.references)
            if (!reference.to) draw(reference);
        for (const Series& series : plot_.series) draw(series);
        const double bottom = drawLegend();
        return svg_.file(kWidth, bottom, plot_.title, plot_.description, kStyle);
    }

 private:
    static constexpr double kWidth = 720, kLeft = 64, kRight = 704, kBase = 400;
    static constexpr double kNarrow = 110;  ///< words in lines of about 14 letters

    Spot at(double x, double y) const { return {x_.at(x), y_.at(y)}; }

    void drawAxes() {
        for (const auto& [value, words] : x_.ticks()) {
            if (plot_.x.categories.empty()) svg_.line({x_.at(value), kBase}, {x_.at(value), top_}, "grid");
            svg_.label({x_.at(value), kBase + 18}, words, "middle");
        }
        for (const auto& [value, words] : y_.ticks()) {
            svg_.line({kLeft, y_.at(value)}, {kRight, y_.at(value)}, "grid");
            svg_.label({kLeft - 8, y_.at(value) + 4}, words, "end");
        }
        svg_.box({kLeft, top_}, {kRight, kBase}, "frame");
        svg_.label({0.5 * (kLeft + kRight), kBase + 40}, plot_.x.title, "middle");
        svg_.label({14, 0.5 * (top_ + kBase)}, plot_.y.title, "middle", "text", "-90");
    }

    void draw(const Reference& one) {
        const bool upright = one.axis == 'x';
        const auto across = [&](double value) {
            return upright ? std::pair{Spot{x_.at(value), kBase}, Spot{x_.at(value), top_}}
                           : std::pair{Spot{kLeft, y_.at(value)}, Spot{kRight, y_.at(value)}};
        };
        const auto [from, to] = across(one.at);
        if (one.to) return svg_.box(from, across(*one.to).second, one.role);
        svg_.line(from, to, one.role);
        const bool at_end = from.x + kNarrow > kRight;
        if (upright)
            drawNarrow({from.x + (at_end ? -8 : 8), kBase - 46}, one.text, at_end ? "end" : "start");
        else
            svg_.label({kLeft + 6, from.y + (one.below ? 15 : -6)}, one.text, "start", "small");
    }

    /// Words in lines of about 14 letters.
    void drawNarrow(Spot at, const std::string& words, const char* anchor) {
        std::string line;
        for (std::size_t begin = 0; begin < words.size();) {
            const std::size_t end = std::min(words.find(' ', begin), words.size());
            const std::string word = words.substr(begin, end - begin);
            if (!line.empty() && line.size() + word.size() > 13) {
                svg_.label(at, line, anchor, "small");
                at.y += 16;
                line.clear();
            }
            line += (line.empty() ? "" : " ") + word;
            begin = end + 1;
        }
        svg_.label(at, line, anchor, "small");
    }

    void drawBand(const Series& series) {
        std::vector<Spot> outline;
        for (const auto& row : series.rows) outline.push_back(at(row[0], row[1]));
        for (auto row = series.rows.rbegin(); row != series.rows.rend(); ++row)
            outline.push_back(at((*row)[0], (*row)[2]));
        if (!outline.empty()) svg_.shape(outline, false, series.role);
    }

    void draw(const Series& series) {
        std::vector<Spot> path;
        for (std::size_t i = 0; i < series.rows.size(); ++i) {
            const auto& row = series.rows[i];
            const std::string tip = i < series.tips.size() ? series.tips[i] : "";
            if (series.type == "line") path.push_back(at(row[0], row[1]));
            if (series.type == "box") drawBox(row, tip);
            if (series.type == "labels")
                svg_.label({x_.at(row[0]), y_.at(row[1]) - 7}, tip, "middle", "small");
            if (series.type == "points")
                svg_.symbol(series.symbol, {x_.at(row[0]) + series.shift, y_.at(row[1])}, series.size,
                            series.role, tip);
        }
        if (!path.empty()) svg_.shape(path, true, series.role);
    }

    /// Row: x, then the 5, 25, 50, 75 and 95 % quantiles.
    void drawBox(const std::vector<double>& row, const std::string& tip) {
        const double half = 0.16;
        svg_.line(at(row[0], row[1]), at(row[0], row[2]), "frame");
        svg_.line(at(row[0], row[4]), at(row[0], row[5]), "frame");
        svg_.box(at(row[0] - half, row[2]), at(row[0] + half, row[4]), "band", tip);
        svg_.line(at(row[0] - half, row[3]), at(row[0] + half, row[3]), "theory");
        for (const std::size_t end : {1, 5})
            svg_.line(at(row[0] - 0.5 * half, row[end]), at(row[0] + 0.5 * half, row[end]), "frame");
    }

    /// In rows under the plot. Returns the file's height.
    double drawLegend() {
        Spot at{kLeft, kBase + 66};
        const auto entry = [&](const std::string& name, const std::string& type, const std::string& role,
                               const Series* points) {
            if (name.empty()) return;
            const double needs = 44 + kLetter * static_cast<double>(name.size());
            if (at.x > kLeft && at.x + needs > kRight) at = {kLeft, at.y + 22};
            const Spot middle{at.x + 12, at.y};
            if (points)
                svg_.symbol(points->symbol, middle, points->size, role);
            else if (type == "line")
                svg_.line({at.x, at.y}, {at.x + 24, at.y}, role);
            else
                svg_.box({at.x, at.y - 6}, {at.x + 24, at.y + 6}, role);
            svg_.label({at.x + 32, at.y + 4}, name);
            at.x += needs;
        };
        for (const auto* list : {&plot_.series, &plot_.key})
            for (const Series& one : *list)
                entry(one.name, one.type, one.role, one.type == "points" ? &one : nullptr);
        for (const Reference& one : plot_.references)
            entry(one.name, one.to ? "band" : "line", one.role, nullptr);
        return at.x > kLeft ? at.y + 18 : kBase + 52;
    }

    const Plot& plot_;
    const bool titled_;
    const double top_ = titled_ ? 42 : 26;
    const Scale x_{plot_.x, kLeft, kRight}, y_{plot_.y, kBase, top_};
    SvgWriter svg_;
};

}  // namespace

std::string svgFile(const Plot& plot, bool titled) { return PlotFile(plot, titled).write(); }

std::string svgFile(const Drawing& drawing) {
    constexpr double kWidth = 340, kMargin = 10;
    Spot low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const Shape& shape : drawing.shapes)
        for (const Spot& spot : shape.spots) {
            low = {std::min(low.x, spot.x), std::min(low.y, spot.y)};
            high = {std::max(high.x, spot.x), std::max(high.y, spot.y)};
        }
    const double scale = (kWidth - 2 * kMargin) / std::max(high.x - low.x, 1e-12);
    const auto pixel = [&](Spot spot) {
        return Spot{kMargin + scale * (spot.x - low.x), kMargin + scale * (high.y - spot.y)};
    };
    SvgWriter svg;
    for (const Shape& shape : drawing.shapes) {
        std::vector<Spot> spots = shape.spots;
        std::transform(spots.begin(), spots.end(), spots.begin(), pixel);
        svg.shape(spots, shape.open, shape.role, shape.tip);
    }
    if (drawing.label) svg.label(pixel(drawing.label->first), drawing.label->second, "start", "caption");
    return svg.file(kWidth, scale * (high.y - low.y) + 2 * kMargin, drawing.title, drawing.description,
                    kStyle);
}

double niceStep(double span, int count) {
    const double rough = span / count;
    const double unit = std::pow(10.0, std::floor(std::log10(rough)));
    const double ratio = rough / unit;
    return unit * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

PlotAxis axisOver(std::string title, double low, double high, int count) {
    const double step = niceStep(high > low ? high - low : std::max(std::abs(high), 1e-12), count);
    const double from = step * std::floor(low / step + 1e-9), to = step * std::ceil(high / step - 1e-9);
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return {std::move(title), {from, std::max(to, from + step)}, step, decimals};
}

}  // namespace talus::tools
