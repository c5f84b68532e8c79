# cmake -D INPUT=<page.html> -D CONSTANT=<name> -D OUTPUT=<page.cpp> -P embed_page.cmake
# Writes the page as one raw string literal (a file of its own, so that it is compiled once).
file(READ ${INPUT} text)
file(WRITE ${OUTPUT} "// Generated from ${INPUT}.
#include <string_view>

namespace talus::tools {
extern const std::string_view ${CONSTANT};
namespace {
const char kText[] = R\"_page_(${text})_page_\";
}  // namespace
const std::string_view ${CONSTANT}{kText, sizeof(kText) - 1};
}  // namespace talus::tools
")
