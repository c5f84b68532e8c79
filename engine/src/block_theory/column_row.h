#pragma once
// Which slopes are a row of columns that lean on each other (toppling_columns.h).

#include <cstddef>
#include <optional>
#include <vector>

#include "block_theory/toppling_columns.h"
#include "state/arrays.h"

namespace talus::keyblocks {

/// Columns in the plane of the section, and their blocks.
struct ColumnRow {
    std::vector<LeaningColumn> columns{};  ///< from the toe up
    std::vector<std::size_t> blocks{};     ///< of the model, likewise
};

/// Of a state as `buildState` gives it, under its whole load. Forces of the state are brought up to date.
/// Nothing unless the free blocks are one row of columns, two at least. Each stands on one plane of fixed
/// rock. It touches no other rock but its neighbours in the row, and fixed rock uphill of it. All contacts
/// span the same width, and all joints have friction alone.
std::optional<ColumnRow> columnRow(State& state);

}  // namespace talus::keyblocks
