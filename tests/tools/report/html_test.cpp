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
