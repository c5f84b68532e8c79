// The page without scripts: text is text, and figures do not mix their styles.

#include "report/html.h"

#include <doctest/doctest.h>

using namespace talus::tools;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kSvg =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
    "width=\"10\"><style>\n.page{fill:#fff}\n.a,.b{font:13px "
    "system-ui,sans-serif}\n</style><clipPath id=\"clip\"/><g clip-path=\"url(#clip)\"/></svg>\n";

}  // namespace

TEST_CASE("html: text never becomes markup") {
    HtmlPage page;
    page.section("one", "<b> & \"c\"");
    page.paragraph("<script>alert(1)</script>");
    page.facts({{"<i>", "</dl>"}, {"", "goes on"}});
    page.list({"<li>"});
    page.table("<caption>", {{"<th>", true}, {"figure"}}, {{"<td>", "1"}});
    page.textFile("<name>", "</pre>");
    const std::string html = page.html("<title>");
    CHECK(!has(html, "<script"));
    CHECK(!has(html, "<b>"));
    CHECK(!has(html, "<i>"));
    CHECK(has(html, "<title>&lt;title&gt;</title>"));
    CHECK(has(html, "<dt>&lt;i&gt;</dt><dd>&lt;/dl&gt;</dd>"));
    CHECK(has(html, "<dd class=\"more\">goes on</dd>"));
    CHECK(has(html, "<td class=\"words\">&lt;td&gt;</td><td>1</td>"));
    CHECK(has(html, "<pre>&lt;/pre&gt;</pre>"));
}

TEST_CASE("html: the style of a figure and its clip path hold inside it") {
    const std::string element = svgElement(kSvg, "figure-x");
    CHECK(element.starts_with("<svg id=\"figure-x\" xmlns"));
    CHECK(has(element,
              "\n#figure-x .page{fill:#fff}\n#figure-x .a,#figure-x .b{font:13px system-ui,sans-serif}"));
    CHECK(has(element, "id=\"figure-x-clip\""));
    CHECK(has(element, "url(#figure-x-clip)"));
    HtmlPage page;
    page.figure("one", kSvg, "first");
    page.figure("two", kSvg, "second");
    const std::string html = page.html("two figures");
    CHECK(!has(html, "<?xml"));
    CHECK(has(html, "#one .page"));
    CHECK(has(html, "#two .page"));
    CHECK(!has(html, "}\n.page{fill"));
}

TEST_CASE("html: a figure is printed so high that its smallest letters have 7 points") {
    const auto printed = [](const std::string& height, const std::string& style) {
        HtmlPage page;
        page.figure("one",
                    "<svg width=\"900.0\" height=\"" + height + "\"><style>\n" + style + "</style></svg>\n",
                    "");
        const std::string html = page.html("a figure");
        const std::size_t at = html.find("style=\"--high:") + 14;
        return html.substr(at, html.find('"', at) - at);
    };
    const std::string two = ".text{font:600 14px sans-serif}\n.small{font:12.5px sans-serif}\n";
    // 700 px at 7 pt = 2.469 mm for 12.5 px.
    CHECK(printed("700.0", two) == "139mm");
    CHECK(printed("300.0", two) == "110mm");
    CHECK(printed("5000.0", two) == "225mm");
    CHECK(printed("700.0", ".page{fill:#fff}\n") == "110mm");
}
