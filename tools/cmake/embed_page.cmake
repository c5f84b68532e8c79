# cmake -D INPUT=<page.html> -D OUTPUT=<page.cpp> -P embed_page.cmake
# Writes the page as one raw string literal (a file of its own, so that its 0.7 MB are compiled once).
file(READ ${INPUT} text)
file(WRITE ${OUTPUT} "// Generated from ${INPUT}.
#include \"replay/page.h\"

namespace talus::tools {
namespace {
const char kText[] = R\"_page_(${text})_page_\";
}  // namespace
const std::string_view kReplayPage{kText, sizeof(kText) - 1};
}  // namespace talus::tools
")
