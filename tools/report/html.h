#pragma once
// Pieces of HTML. Arguments named `plain` are escaped, those named `content` are HTML already.

#include <optional>
#include <string>

namespace talus::tools::html {

std::string tagged(const std::string& tag, const std::string& content, const std::string& attributes = "");
std::string classed(const std::string& name);  ///< class="name"
std::string paragraph(const std::string& plain, const std::string& name = "");
std::string heading(const std::string& id, const std::string& plain);
std::string definition(const std::string& term, const std::string& plain);

/// Scrolls sideways on narrow screens.
std::string wide(const std::string& content);

/// Escaped text in which the water's density "\u03c1w" has its subscript.
std::string words(const std::string& plain);

std::string table(const std::string& caption, const std::string& head_rows, const std::string& rows);
std::string row(const std::string& cells);
std::string head(const std::string& plain, const std::string& name = "", int span = 1);
std::string cell(const std::string& plain, const std::string& name = "");
std::string numberCell(std::optional<double> value, int decimals, const std::string& name = "");
std::string signedCell(std::optional<double> value, int decimals, const std::string& name = "");

}  // namespace talus::tools::html
