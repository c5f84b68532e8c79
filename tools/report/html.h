#pragma once
// A page without scripts: text, tables and figures as HTML in one file that needs nothing else, for the
// screen and for A4 paper. (page.h has the page of batches, which draws its data in the browser.)

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus::tools {

struct HtmlColumn {
    std::string title;
    bool words = false;  ///< set to the left; figures to the right
};

class HtmlPage {
 public:
    void section(const std::string& id, std::string_view title);  ///< a heading that begins one
    void heading(std::string_view title);                         ///< within a section
    /// \param look  a class of the style: "lead", "muted", "alert"
    void paragraph(std::string_view text, std::string_view look = "");
    /// Terms and their explanations; a row without a term continues the one before.
    void facts(const std::vector<std::pair<std::string, std::string>>& items);
    void list(const std::vector<std::string>& items);
    void table(std::string_view caption, const std::vector<HtmlColumn>& columns,
               const std::vector<std::vector<std::string>>& rows);
    /// A preformatted text, folded on the screen and left out on paper.
    void textFile(std::string_view name, std::string_view text);
    /// An SVG file as part of the page. \param id  of the element, once a page
    void figure(const std::string& id, std::string_view svg, std::string_view caption);

    std::string html(std::string_view title) const;

 private:
    std::string body_;
};

/// An SVG file as one of several elements of a page. Its style, which would otherwise apply to the page, and
/// the name of its clip path hold inside the element only.
std::string svgElement(std::string_view svg, const std::string& id);

}  // namespace talus::tools
