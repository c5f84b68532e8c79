#pragma once
// How wide a terminal is, and text that fits it.

#include <cstddef>
#include <string>

namespace talus::tools {

/// Columns of the terminal behind a stream, or what the variable COLUMNS says; `otherwise` where neither
/// does.
std::size_t columnsOf(int stream, std::size_t otherwise);

/// Breaks paragraphs to lines of at most `width` (longer words stay whole). A line break before plain text is
/// as good as a space; lines that begin with spaces, examples, stay lines of their own and go on further in.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

/// Lines longer than `width` broken at spaces (longer words stay whole). What goes on begins where its line's
/// content does: behind a label and its gap of two spaces or more, else a little further in than the line.
std::string fitted(const std::string& text, std::size_t width);

}  // namespace talus::tools
