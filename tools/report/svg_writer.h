#pragma once
// The one writer of SVG files: elements with a class each, whose look is the style given with the file.

#include <string>
#include <string_view>
#include <vector>

#include "report/figures.h"

namespace talus::tools {

/// Places are pixels, y downwards.
class SvgWriter {
 public:
    /// A polygon, or a line. \param role its class; \param fill a colour of its own; `outlined`: also around
    /// it; \param tip shown over it
    void shape(const std::vector<Spot>& spots, bool open, const std::string& role,
               const std::string& tip = "", const std::string& fill = "", bool outlined = false);
    /// An area with holes: the points inside an odd number of rings.
    void area(const std::vector<std::vector<Spot>>& rings, const std::string& role);
    /// Clips to a circle until `endClip`. One circle per file.
    void beginClip(Spot middle, double r);
    void endClip() { body_ += "</g>\n"; }
    void line(Spot from, Spot to, const std::string& role) { shape({from, to}, true, role); }
    void box(Spot a, Spot b, const std::string& role, const std::string& tip = "") {
        shape({a, {b.x, a.y}, b, {a.x, b.y}}, false, role, tip);
    }
    /// circle, triangle, square
    void symbol(const std::string& kind, Spot at, double r, const std::string& role,
                const std::string& tip = "");
    /// \param turn [deg]
    void label(Spot at, const std::string& words, const char* anchor = "start", const char* look = "text",
               const std::string& turn = "");

    /// \param style CSS of the classes; `page` is the ground
    std::string file(double width, double height, std::string_view title, std::string_view description,
                     std::string_view style) const;

 private:
    void element(const std::string& name, const std::string& attributes, const std::string& role,
                 const std::string& tip);

    std::string body_;
};

}  // namespace talus::tools
