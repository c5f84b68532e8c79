#include "report/svg.h"

#include <cmath>

#include "cli/command.h"

namespace talus::tools {
namespace {

std::string px(double value) { return text(value, 1); }

std::string attribute(std::string_view name, std::string_view value) {
    return " " + std::string(name) + "=\"" + escaped(value) + '"';
}

std::string spotsText(const std::vector<Spot>& spots) {
    std::string list;
    for (const Spot& spot : spots) list += (list.empty() ? "" : " ") + px(spot.x) + "," + px(spot.y);
    return list;
}

void symbol(Svg& svg, Spot at, const LegendEntry& entry) {
    switch (entry.symbol) {
        case LegendEntry::Symbol::line:
            svg.line({at.x - 12, at.y}, {at.x + 12, at.y}, entry.classes);
            break;
        case LegendEntry::Symbol::circle:
            svg.circle(at, entry.radius, entry.classes);
            break;
        case LegendEntry::Symbol::triangle:
            svg.triangle(at, entry.radius, entry.classes);
            break;
        case LegendEntry::Symbol::square:
            svg.square(at, entry.radius, entry.classes);
            break;
        case LegendEntry::Symbol::patch:
            svg.polygon(
                {{at.x - 12, at.y - 6}, {at.x + 12, at.y - 6}, {at.x + 12, at.y + 6}, {at.x - 12, at.y + 6}},
                entry.classes);
            break;
    }
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            case '\'':
                safe += "&#39;";
                break;
            default:
                safe += letter;
        }
    }
    return safe;
}

std::string typeset(std::string number) {
    if (number.starts_with('-')) number.replace(0, 1, "\u2212");
    return number;
}

Palette lightPalette() {
    return {"#ffffff", "#1a1a1a", "#595959", "#dddddd", "#0072b2", "#cfe3ef", "#1a1a1a",
            "#b34700", "#0072b2", "#ececec", "#b4b4b4", "#e69f00", "#009e73", "#7a2f6b"};
}

Palette darkPalette() {
    return {"#16181b", "#ececec", "#b0b4b8", "#3a3f44", "#56b4e9", "#24455a", "#ececec",
            "#ff9a52", "#56b4e9", "#43484e", "#777c82", "#e69f00", "#00b386", "#d58bc5"};
}

std::string drawingStyle(const Palette& p, std::string_view scope) {
    std::string css;
    const auto rule = [&](std::string_view selector, const std::string& body) {
        css += std::string(scope) + std::string(selector) + "{" + body + "}\n";
    };
    rule(".text", "fill:" + p.ink + ";font:13px system-ui,sans-serif");
    rule(".small", "fill:" + p.muted + ";font:12px system-ui,sans-serif");
    rule(".caption", "fill:" + p.ink + ";font:600 14px system-ui,sans-serif");
    rule(".page", "fill:" + p.page);
    rule(".frame", "stroke:" + p.ink + ";stroke-width:1;fill:none");
    rule(".grid", "stroke:" + p.grid + ";stroke-width:1");
    rule(".band", "fill:" + p.band + ";stroke:none");
    rule(".theory", "stroke:" + p.theory + ";stroke-width:2;fill:none");
    rule(".rule", "stroke:" + p.muted + ";stroke-width:1.2;stroke-dasharray:7 4;fill:none");
    rule(".dots", "stroke:" + p.muted + ";stroke-width:1.2;stroke-dasharray:2 3;fill:none");
    rule(".dem", "fill:" + p.dem + ";stroke:" + p.dem + ";stroke-width:1.5");
    rule(".dem-open", "fill:" + p.page + ";stroke:" + p.dem + ";stroke-width:1.8");
    rule(".dem-ring", "fill:none;stroke:" + p.dem + ";stroke-width:1.8");
    rule(".laboratory", "fill:none;stroke:" + p.laboratory + ";stroke-width:1.8");
    rule(".repeat", "fill:" + p.laboratory + ";stroke:none");
    rule(".water", "fill:" + p.water + ";stroke:" + p.water + ";stroke-width:1");
    rule(".water-line", "fill:none;stroke:" + p.water + ";stroke-width:1.6");
    const auto block = [&](std::string_view selector, const std::string& fill) {
        rule(selector, "fill:" + fill + ";stroke:" + p.ink + ";stroke-width:.7;stroke-linejoin:round");
    };
    block(".stable", p.stable);
    block(".fixed", p.fixed);
    block(".sliding", p.sliding);
    block(".mixed", p.mixed);
    block(".toppling", p.toppling);
    return css;
}

Svg::Svg(double width, double height, std::string title, std::string description)
    : width_(width), height_(height), title_(std::move(title)), description_(std::move(description)) {}

void Svg::shape(std::string_view start, std::string_view classes, std::string_view tip) {
    body_ += std::string(start) + attribute("class", classes);
    const std::string name(start.substr(1, start.find(' ') - 1));
    body_ += tip.empty() ? "/>\n" : "><title>" + escaped(tip) + "</title></" + name + ">\n";
}

void Svg::line(Spot from, Spot to, std::string_view classes) {
    shape("<line x1=\"" + px(from.x) + "\" y1=\"" + px(from.y) + "\" x2=\"" + px(to.x) + "\" y2=\"" +
              px(to.y) + '"',
          classes, "");
}

void Svg::path(const std::vector<Spot>& spots, std::string_view classes) {
    shape("<polyline points=\"" + spotsText(spots) + '"', classes, "");
}

void Svg::polygon(const std::vector<Spot>& spots, std::string_view classes, std::string_view tip) {
    shape("<polygon points=\"" + spotsText(spots) + '"', classes, tip);
}

void Svg::circle(Spot centre, double radius, std::string_view classes, std::string_view tip) {
    shape("<circle cx=\"" + px(centre.x) + "\" cy=\"" + px(centre.y) + "\" r=\"" + px(radius) + '"', classes,
          tip);
}

void Svg::triangle(Spot centre, double radius, std::string_view classes, std::string_view tip) {
    polygon({{centre.x, centre.y - 1.15 * radius},
             {centre.x + radius, centre.y + 0.6 * radius},
             {centre.x - radius, centre.y + 0.6 * radius}},
            classes, tip);
}

void Svg::square(Spot centre, double radius, std::string_view classes, std::string_view tip) {
    const double r = 0.9 * radius;
    polygon({{centre.x - r, centre.y - r},
             {centre.x + r, centre.y - r},
             {centre.x + r, centre.y + r},
             {centre.x - r, centre.y + r}},
            classes, tip);
}

void Svg::label(Spot at, std::string_view text, std::string_view anchor, std::string_view classes,
                double turn) {
    body_ += "<text x=\"" + px(at.x) + "\" y=\"" + px(at.y) + '"' + attribute("text-anchor", anchor) +
             attribute("class", classes);
    if (turn != 0) body_ += " transform=\"rotate(" + px(turn) + " " + px(at.x) + " " + px(at.y) + ")\"";
    body_ += ">" + escaped(text) + "</text>\n";
}

std::string Svg::element(std::string_view attributes) const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"" + std::string(attributes) +
           " viewBox=\"0 0 " + px(width_) + " " + px(height_) + "\">\n<title>" + escaped(title_) +
           "</title>\n<desc>" + escaped(description_) + "</desc>\n";
}

std::string Svg::inlined() const { return element(attribute("aria-label", title_)) + body_ + "</svg>\n"; }

std::string Svg::standalone() const {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
           element(" width=\"" + px(width_) + "\" height=\"" + px(height_) + '"') + "<style>\n" +
           drawingStyle(lightPalette(), "") +
           "</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n" + body_ + "</svg>\n";
}

double niceStep(double span, int count) {
    const double rough = span / count;
    const double unit = std::pow(10.0, std::floor(std::log10(rough)));
    const double ratio = rough / unit;
    return unit * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

std::vector<double> Axis::ticks() const {
    std::vector<double> values;
    if (step <= 0) return values;
    const double slack = 1e-9 * step;
    for (long i = std::lround(std::ceil((lo - slack) / step)); static_cast<double>(i) * step <= hi + slack;
         ++i) {
        values.push_back(static_cast<double>(i) * step);
    }
    return values;
}

void drawAxes(Svg& svg, const Axis& x, const Axis& y) {
    for (const double value : x.ticks()) {
        svg.line({x.at(value), y.from}, {x.at(value), y.to}, "grid");
        svg.label({x.at(value), y.from + 18}, text(value, x.decimals), "middle");
    }
    for (const double value : y.ticks()) {
        svg.line({x.from, y.at(value)}, {x.to, y.at(value)}, "grid");
        svg.label({x.from - 8, y.at(value) + 4}, typeset(text(value, y.decimals)), "end");
    }
    svg.path({{x.from, y.to}, {x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}}, "frame");
    svg.label({(x.from + x.to) / 2, y.from + 40}, x.title, "middle");
    // Room for the tick labels, about 7 px a letter.
    svg.label({x.from - 36 - (y.decimals > 0 ? 4.0 + 8.0 * y.decimals : 0.0), (y.from + y.to) / 2}, y.title,
              "middle", "text", -90);
}

void drawLegend(Svg& svg, Spot top_left, const std::vector<LegendEntry>& entries) {
    Spot at{top_left.x + 12, top_left.y};
    for (const LegendEntry& entry : entries) {
        symbol(svg, at, entry);
        svg.label({at.x + 20, at.y + 4}, entry.text);
        at.y += 20;
    }
}

}  // namespace talus::tools
