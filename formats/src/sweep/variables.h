#pragma once
// What varies: [[grid]], [table] and [[random]] of a sweep file.

#include <string>
#include <vector>

#include "scenario/unnamed.h"
#include "talus/formats/sweep.h"
#include "toml/table_reader.h"

namespace talus::formats::sweep {

/// A column of the sweep, and where each of its values stands, for messages.
struct Variable {
    SweepColumn column;
    std::string field;                ///< "grid[0]"
    toml::Place place;                ///< of its field in the sweep file
    std::string file;                 ///< where the values stand; empty: the sweep file
    std::vector<toml::Place> places;  ///< of each value
};

/// Reads all variables and the names of the table's cases. `known` is the scenario's: fields of other joints
/// and materials are reported, and `joint.*` stands for all joints. Table files are looked for beside the
/// sweep file at `path`.
struct Variables {
    std::vector<Variable> list;  ///< the table's columns, then grids, then random ones
    std::vector<std::string> case_names;
    std::vector<Error> errors;  ///< of the table's file
};
Variables readVariables(toml::Report& report, toml::TableReader& root, const std::string& path,
                        const scenario::KnownNames& known);

/// `name` beside the file at `path`, unless it is absolute.
std::string besideFile(const std::string& path, const std::string& name);

}  // namespace talus::formats::sweep
