#include "report/html.h"

#include "report/markup.h"

namespace talus::tools {

namespace {

constexpr std::string_view kStyle = R"css(
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:60rem;background:#fff;color:#1a1a1a;
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif;overflow-wrap:anywhere}
h1{font-size:1.7rem;line-height:1.2;margin:.5rem 0 1rem}
h2{font-size:1.25rem;margin:2.2rem 0 .75rem;padding-top:.75rem;border-top:1px solid #ccc;break-after:avoid}
h3{font-size:1rem;margin:1.4rem 0 .3rem;break-after:avoid}
p,ul{margin:.4rem 0 .8rem;max-width:48rem}
ul{padding-left:1.2rem}
.lead{font-size:1.2rem;font-weight:600}
.muted{color:#595959;font-size:.9rem}
.alert{border-left:4px solid #b34700;padding:.5rem .75rem;background:#f4f6f8}
.scroll{overflow-x:auto;margin:.8rem 0}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums;min-width:min(100%,18rem)}
caption{text-align:left;font-weight:600;padding:.25rem 0}
th,td{padding:.28rem .55rem;text-align:right;border-bottom:1px solid #ccc;vertical-align:top}
th{font-weight:600;vertical-align:bottom;border-bottom:2px solid #1a1a1a;overflow-wrap:normal}
th:first-child,td:first-child{padding-left:0}
.words{text-align:left}
td:not(.words){white-space:nowrap}
td.words{min-width:6rem}
td.words:last-child:not(:first-child){min-width:12rem}
thead{display:table-header-group}
tr{break-inside:avoid}
dl{display:grid;grid-template-columns:minmax(8rem,max-content) 1fr;gap:.25rem 1rem;margin:.6rem 0 1rem}
dt{color:#595959}
dd{margin:0}
dd.more{grid-column:2}
figure{margin:1.2rem 0 1.6rem;break-inside:avoid}
figcaption{font-size:.88rem;line-height:1.35;margin:.4rem 0}
.drawn{overflow-x:auto}
.drawn svg{display:block;max-width:100%;height:auto}
pre{font-size:.8rem;line-height:1.4;white-space:pre-wrap;background:#f4f6f8;padding:.75rem}
@media (max-width:40rem){
body{padding:1rem .75rem 3rem}
dl{grid-template-columns:1fr;gap:0}
dd,dd.more{grid-column:1;margin-bottom:.4rem}
.drawn svg{max-width:none;width:38rem}}
@page{size:A4;margin:17mm 16mm}
@media print{
body{font-size:10pt;padding:0;max-width:none}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}
.scroll,.drawn{overflow:visible}
.drawn svg{max-height:110mm}
.short{break-inside:avoid}
h2{margin-top:1.4rem}
h2+p{break-after:avoid}
details{display:none}}
)css";

std::string element(const std::string& name, std::string_view text, std::string_view look = "") {
    return "<" + name + (look.empty() ? "" : " class=\"" + std::string(look) + '"') + ">" +
           escapedMarkup(text) + "</" + name + ">";
}

std::string row(const std::string& cell, const std::vector<HtmlColumn>& columns,
                const std::vector<std::string>& texts) {
    std::string cells;
    for (std::size_t c = 0; c < columns.size(); ++c)
        cells += element(cell, texts[c], columns[c].words ? "words" : "");
    return "<tr>" + cells + "</tr>\n";
}

void replaceAll(std::string& text, std::string_view from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Each rule of a style sheet for what is inside an element only. \pre rules of classes, no at-rules
std::string styleInside(const std::string& id, std::string_view style) {
    std::string out;
    bool in_selectors = true, at_start = true;
    for (const char letter : style) {
        if (in_selectors && at_start && letter == '.') out += "#" + id + " ";
        if (letter == '{') in_selectors = false;
        at_start = letter == '}' || (in_selectors && (letter == ',' || letter == '\n'));
        if (letter == '}') in_selectors = true;
        out += letter;
    }
    return out;
}

}  // namespace

std::string svgElement(std::string_view svg, const std::string& id) {
    constexpr std::string_view kStyleBegin = "<style>", kStyleEnd = "</style>";
    std::string file(svg.substr(svg.find("<svg")));
    const std::size_t begin = file.find(kStyleBegin), end = file.find(kStyleEnd);
    if (begin != std::string::npos && end != std::string::npos) {
        const std::size_t from = begin + kStyleBegin.size();
        file.replace(from, end - from, styleInside(id, file.substr(from, end - from)));
    }
    replaceAll(file, "id=\"clip\"", "id=\"" + id + "-clip\"");
    replaceAll(file, "url(#clip)", "url(#" + id + "-clip)");
    return file.insert(std::string_view("<svg").size(), " id=\"" + id + '"');
}

void HtmlPage::section(const std::string& id, std::string_view title) {
    body_ += "<h2 id=\"" + id + "\">" + escapedMarkup(title) + "</h2>\n";
}

void HtmlPage::heading(std::string_view title) { body_ += element("h3", title) + "\n"; }

void HtmlPage::paragraph(std::string_view text, std::string_view look) {
    body_ += element("p", text, look) + "\n";
}

void HtmlPage::facts(const std::vector<std::pair<std::string, std::string>>& items) {
    if (items.empty()) return;
    body_ += "<dl>\n";
    for (const auto& [term, text] : items) {
        body_ += term.empty() ? element("dd", text, "more") + "\n"
                              : element("dt", term) + element("dd", text) + "\n";
    }
    body_ += "</dl>\n";
}

void HtmlPage::list(const std::vector<std::string>& items) {
    body_ += "<ul>\n";
    for (const std::string& item : items) body_ += element("li", item) + "\n";
    body_ += "</ul>\n";
}

void HtmlPage::table(std::string_view caption, const std::vector<HtmlColumn>& columns,
                     const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::string> titles;
    for (const HtmlColumn& column : columns) titles.push_back(column.title);
    constexpr std::size_t kShort = 14;  // rows that a sheet has room for: not cut in two
    body_ += std::string("<div class=\"scroll") + (rows.size() <= kShort ? " short" : "") + "\"><table>" +
             element("caption", caption) + "\n<thead>" + row("th", columns, titles) + "</thead>\n<tbody>\n";
    for (const auto& texts : rows) body_ += row("td", columns, texts);
    body_ += "</tbody></table></div>\n";
}

void HtmlPage::textFile(std::string_view name, std::string_view text) {
    body_ +=
        "<details><summary>" + escapedMarkup(name) + "</summary>" + element("pre", text) + "</details>\n";
}

void HtmlPage::figure(const std::string& id, std::string_view svg, std::string_view caption) {
    body_ += "<figure><div class=\"drawn\">" + svgElement(svg, id) + "</div>" +
             element("figcaption", caption) + "</figure>\n";
}

std::string HtmlPage::html(std::string_view title) const {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" "
           "content=\"default-src 'none'; style-src 'unsafe-inline'\">\n" +
           element("title", title) + "\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n" +
           element("h1", title) + "\n" + body_ + "</body>\n</html>\n";
}

}  // namespace talus::tools
