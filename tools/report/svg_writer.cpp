#include "report/svg_writer.h"

#include <utility>

#include "cli/text.h"
#include "report/markup.h"

namespace talus::tools {
namespace {

std::string px(double value) { return text(value, 1); }

}  // namespace

void SvgWriter::shape(const std::vector<Spot>& spots, bool open, const std::string& role,
                      const std::string& tip, const std::string& fill, bool outlined) {
    std::string list;
    for (const Spot& spot : spots) list += (list.empty() ? "" : " ") + px(spot.x) + "," + px(spot.y);
    element(open ? "polyline" : "polygon",
            (fill.empty() ? "" : "fill=\"" + fill + "\" ") + (outlined ? "stroke=\"" + fill + "\" " : "") +
                "points=\"" + list + '"',
            role, tip);
}

void SvgWriter::area(const std::vector<std::vector<Spot>>& rings, const std::string& role) {
    std::string path;
    for (const std::vector<Spot>& ring : rings) {
        char command = 'M';
        for (const Spot& spot : ring) path += std::exchange(command, 'L') + px(spot.x) + "," + px(spot.y);
        path += 'Z';
    }
    if (!path.empty()) element("path", "fill-rule=\"evenodd\" d=\"" + path + '"', role, "");
}

void SvgWriter::beginClip(Spot middle, double r) {
    body_ += "<clipPath id=\"clip\"><circle cx=\"" + px(middle.x) + "\" cy=\"" + px(middle.y) + "\" r=\"" +
             px(r) + "\"/></clipPath>\n<g clip-path=\"url(#clip)\">\n";
}

void SvgWriter::symbol(const std::string& kind, Spot at, double r, const std::string& role,
                       const std::string& tip) {
    if (kind == "triangle")
        shape({{at.x, at.y - 1.15 * r}, {at.x + r, at.y + 0.6 * r}, {at.x - r, at.y + 0.6 * r}}, false, role,
              tip);
    else if (kind == "square")
        box({at.x - 0.9 * r, at.y - 0.9 * r}, {at.x + 0.9 * r, at.y + 0.9 * r}, role, tip);
    else
        element("circle", "cx=\"" + px(at.x) + "\" cy=\"" + px(at.y) + "\" r=\"" + px(r) + '"', role, tip);
}

void SvgWriter::label(Spot at, const std::string& words, const char* anchor, const char* look,
                      const std::string& turn) {
    body_ += "<text x=\"" + px(at.x) + "\" y=\"" + px(at.y) + "\" text-anchor=\"" + anchor + "\" class=\"" +
             look + '"' +
             (turn.empty() ? "" : " transform=\"rotate(" + turn + " " + px(at.x) + " " + px(at.y) + ")\"") +
             ">" + escapedMarkup(words) + "</text>\n";
}

std::string SvgWriter::file(double width, double height, std::string_view title, std::string_view description,
                            std::string_view style) const {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "role=\"img\" width=\"" +
           px(width) + "\" height=\"" + px(height) + "\" viewBox=\"0 0 " + px(width) + " " + px(height) +
           "\">\n<title>" + escapedMarkup(title) + "</title>\n" +
           (description.empty() ? "" : "<desc>" + escapedMarkup(description) + "</desc>\n") + "<style>" +
           std::string(style) + "</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n" + body_ +
           "</svg>\n";
}

void SvgWriter::element(const std::string& name, const std::string& attributes, const std::string& role,
                        const std::string& tip) {
    body_ += "<" + name + " " + attributes + " class=\"" + escapedMarkup(role) + '"' +
             (tip.empty() ? "/>\n" : "><title>" + escapedMarkup(tip) + "</title></" + name + ">\n");
}

}  // namespace talus::tools
