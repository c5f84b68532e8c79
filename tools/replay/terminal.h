#pragma once
// A run in the terminal: its quantities over time as small curves of letters, and a table of frames.

#include <string>
#include <vector>

#include "report/table.h"

namespace talus::tools {

/// Curve of the values in `width` letters, from the least (lowest) to the largest; of several values in one
/// letter's place the largest counts. With `logarithmic` over at most eight powers of ten. Blocks of Unicode,
/// or plain ASCII.
std::string sparkline(const std::vector<double>& values, std::size_t width, bool logarithmic, bool unicode);

/// True when the environment speaks UTF-8 (LC_ALL, LC_CTYPE, LANG).
bool terminalSpeaksUnicode();

/// Curves and at most `rows` frames of the course of a run, the table of `talus inspect`.
std::string courseText(const Table& course, std::size_t rows, bool unicode);

}  // namespace talus::tools
