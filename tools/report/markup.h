#pragma once
// Text inside XML and HTML.

#include <string>
#include <string_view>

namespace talus::tools {

/// Text made safe for XML and HTML, attributes included. Characters not allowed in XML (control characters,
/// U+FFFE, U+FFFF) are replaced by U+FFFD.
std::string escapedMarkup(std::string_view text);

}  // namespace talus::tools
