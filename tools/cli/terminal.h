#pragma once
// Width of a terminal, and text that fits it.

#include <cstddef>
#include <string>

namespace talus::tools {

/// Columns of the terminal behind a stream, or the variable COLUMNS; `otherwise` where neither is known.
std::size_t columnsOf(int stream, std::size_t otherwise);

/// Breaks paragraphs to lines of at most `width` (longer words stay whole). A line break before plain text
/// counts as a space; lines that begin with spaces (examples) stay separate lines with their continuation
/// indented.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

/// Lines longer than `width` broken at spaces (longer words stay whole). Continuations begin at the line's
/// content: after a label and its gap of two spaces or more, else slightly indented.
std::string fitted(const std::string& text, std::size_t width);

}  // namespace talus::tools
