# cmake -D FILES=<a.toml;b.toml> -D WHAT=Paper -D OUTPUT=<header.h> [-D TABLE=<rows.csv>] -P embed_scenarios.cmake
# Writes the files as raw string literals kPaperScenarios, in the order of their names ("fissure-1" for fissure-1.toml), and a
# table as kPaperRows.
list(LENGTH FILES count)
set(entries "")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME_WLE)
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"_toml_(${text})_toml_\"sv},\n")
endforeach()

set(table "")
if(TABLE)
    file(READ ${TABLE} rows)
    set(table "\ninline constexpr std::string_view k${WHAT}Rows = R\"_csv_(${rows})_csv_\"sv;\n")
endif()

file(WRITE ${OUTPUT} "#pragma once
// Generated from scenarios of bench/.

#include <array>
#include <string_view>

namespace talus::tools {

using namespace std::string_view_literals;  // their lengths are known at once

struct ${WHAT}Scenario {
    std::string_view name;  ///< the file's name without .toml
    std::string_view text;
};

inline constexpr std::array<${WHAT}Scenario, ${count}> k${WHAT}Scenarios{{
${entries}}};
${table}
}  // namespace talus::tools
")
