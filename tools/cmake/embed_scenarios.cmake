# cmake -D FILES=<a.toml;b.toml> -D OUTPUT=<header.h> -P embed_scenarios.cmake
# Writes the files as raw string literals, in the order of their names ("fissure-1" for fissure-1.toml).
list(LENGTH FILES count)
set(entries "")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME_WLE)
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"_toml_(${text})_toml_\"},\n")
endforeach()

file(WRITE ${OUTPUT} "#pragma once
// Generated from bench/paper/*.toml.

#include <array>
#include <string_view>

namespace talus::tools {

struct PaperScenario {
    std::string_view name;  ///< the file's name without .toml
    std::string_view text;
};

inline constexpr std::array<PaperScenario, ${count}> kPaperScenarios{{
${entries}}};

}  // namespace talus::tools
")
