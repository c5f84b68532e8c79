#include "report/html.h"

#include "report/numbers.h"
#include "report/svg.h"

namespace talus::tools::html {
namespace {

std::string numberText(const std::string& number) { return number == "-" ? "\u2013" : typeset(number); }

}  // namespace

std::string tagged(const std::string& tag, const std::string& content, const std::string& attributes) {
    return "<" + tag + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + tag + ">\n";
}

std::string classed(const std::string& name) { return "class=\"" + escaped(name) + "\""; }

std::string words(const std::string& plain) {
    const std::string density = "\u03c1w";
    std::string safe = escaped(plain);
    for (auto at = safe.find(density); at != std::string::npos; at = safe.find(density, at + 1)) {
        safe.replace(at, density.size(), "\u03c1<sub>w</sub>");
    }
    return safe;
}

std::string paragraph(const std::string& plain, const std::string& name) {
    return tagged("p", words(plain), name.empty() ? "" : classed(name));
}

std::string heading(const std::string& id, const std::string& plain) {
    return tagged("h2", escaped(plain), "id=\"" + id + "\"");
}

std::string definition(const std::string& term, const std::string& plain) {
    return tagged("dt", escaped(term)) + tagged("dd", escaped(plain));
}

std::string wide(const std::string& content) { return tagged("div", content, classed("wide")); }

std::string table(const std::string& caption, const std::string& head_rows, const std::string& rows) {
    return wide("<table>\n<caption>" + escaped(caption) + "</caption>\n<thead>\n" + head_rows +
                "</thead>\n<tbody>\n" + rows + "</tbody>\n</table>\n");
}

std::string row(const std::string& cells) { return "<tr>" + cells + "</tr>\n"; }

std::string head(const std::string& plain, const std::string& name, int span) {
    const std::string scope =
        span > 1 ? " colspan=\"" + std::to_string(span) + "\" scope=\"colgroup\"" : " scope=\"col\"";
    return "<th" + (name.empty() ? "" : " " + classed(name)) + scope + ">" + escaped(plain) + "</th>";
}

std::string cell(const std::string& plain, const std::string& name) {
    return "<td" + (name.empty() ? "" : " " + classed(name)) + ">" + escaped(plain) + "</td>";
}

std::string numberCell(std::optional<double> value, int decimals, const std::string& name) {
    return cell(numberText(shown(value, decimals)), name);
}

std::string signedCell(std::optional<double> value, int decimals, const std::string& name) {
    return cell(numberText(shownSigned(value, decimals)), name);
}

}  // namespace talus::tools::html
