#pragma once
// A table of results, for people (aligned columns), for programs (JSON), for spreadsheets (CSV).

#include <string>
#include <vector>

#include "cli/json.h"

namespace talus::tools {

struct Table {
    std::vector<std::string> columns;     ///< with the unit behind the name: "force_n"
    std::vector<std::vector<Json>> rows;  ///< numbers, texts or null; one value a column

    std::string text() const;  ///< columns as wide as they need, numbers with six digits
    std::string csv() const;   ///< numbers read back to the same bits
    Json json() const;         ///< a list of objects
};

/// How a result is to be printed.
enum class Format { text, csv, json };

}  // namespace talus::tools
