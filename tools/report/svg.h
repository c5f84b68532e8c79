#pragma once
// A small SVG writer: shapes with CSS classes, so that one drawing serves as a file (light colours built in)
// and inside the page (light or dark, as the reader's screen is).

#include <string>
#include <string_view>
#include <vector>

namespace talus::tools {

/// Text made safe for XML and HTML, attributes included.
std::string escaped(std::string_view text);

/// A number with a true minus sign.
std::string typeset(std::string number);

struct Spot {
    double x = 0, y = 0;  ///< pixels, y down
};

/// Colours by role; colour-blind safe (Okabe and Ito) and apart in grey as well.
struct Palette {
    std::string page, ink, muted, grid;
    std::string water, band, laboratory, dem, theory;
    std::string stable, fixed, sliding, mixed, toppling;
};
Palette lightPalette();
Palette darkPalette();

/// CSS rules for the classes the drawings use; `scope` is put before each selector (".figure ").
std::string drawingStyle(const Palette& palette, std::string_view scope);

class Svg {
 public:
    /// `title` and `description` are what a screen reader reads.
    Svg(double width, double height, std::string title, std::string description);

    // `classes` are CSS classes; `tip` is shown when the pointer rests on the shape.
    void line(Spot from, Spot to, std::string_view classes);
    void path(const std::vector<Spot>& spots, std::string_view classes);  ///< open
    void polygon(const std::vector<Spot>& spots, std::string_view classes, std::string_view tip = "");
    void circle(Spot centre, double radius, std::string_view classes, std::string_view tip = "");
    void triangle(Spot centre, double radius, std::string_view classes, std::string_view tip = "");
    void square(Spot centre, double radius, std::string_view classes, std::string_view tip = "");
    /// `anchor`: start, middle or end; `turn`: degrees, clockwise.
    void label(Spot at, std::string_view text, std::string_view anchor = "start",
               std::string_view classes = "text", double turn = 0);

    std::string inlined() const;     ///< an element for a page
    std::string standalone() const;  ///< a file of its own

 private:
    std::string element(std::string_view attributes) const;
    void shape(std::string_view start, std::string_view classes, std::string_view tip);

    double width_, height_;
    std::string title_, description_, body_;
};

/// One axis of a plot: values lo..hi onto pixels from..to, with ticks at round numbers.
struct Axis {
    double lo = 0, hi = 1;
    double from = 0, to = 1;  ///< [px]
    std::string title;
    double step = 1;   ///< between ticks; 0: none
    int decimals = 0;  ///< of tick labels

    double at(double value) const { return from + (value - lo) / (hi - lo) * (to - from); }
    std::vector<double> ticks() const;
};

/// A step of 1, 2 or 5 times a power of ten that cuts the span into about `count` parts.
double niceStep(double span, int count);

/// Frame, grid, ticks and titles.
void drawAxes(Svg& svg, const Axis& x, const Axis& y);

/// One entry of a legend: draws its symbol about the given spot.
struct LegendEntry {
    std::string text;
    enum class Symbol { line, circle, triangle, square, patch } symbol = Symbol::line;
    std::string classes;
    double radius = 5;
};
void drawLegend(Svg& svg, Spot top_left, const std::vector<LegendEntry>& entries);

}  // namespace talus::tools
