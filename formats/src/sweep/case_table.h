#pragma once
// A table of cases out of a CSV file: the header names fields, each further line is a case.

#include <string>
#include <vector>

#include "talus/formats/sweep.h"

namespace talus::formats::sweep {

struct CaseTable {
    struct Cell {
        SweepValue value;
        int line = 0, column = 0;  ///< 1-based
    };
    std::vector<Cell> header;             ///< texts
    std::vector<std::vector<Cell>> rows;  ///< each as long as the header
};

/// Commas, semicolons or tabs, whichever the header has; quotes as in RFC 4180; empty lines and lines that
/// begin with '#' are skipped. Cells that read as an integer, a number, true or false are that, the rest is
/// text. Errors: rows of another length, cells without a value, quotes that do not end, no rows.
Result<CaseTable> parseCases(const std::string& text, const std::string& path);

}  // namespace talus::formats::sweep
