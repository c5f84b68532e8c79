#pragma once
// Values outside of TOML files: cells of a table, words of a command line.

#include <string_view>

#include "toml/document.h"

namespace talus::formats::toml {

/// An integer, a number, true or false; else the text itself.
Scalar scalarOf(std::string_view text);

}  // namespace talus::formats::toml
