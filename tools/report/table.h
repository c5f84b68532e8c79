#pragma once
// A table of results as text (aligned columns), JSON and CSV.

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

/// The output format of a result.
enum class Format { text, csv, json };

}  // namespace talus::tools
