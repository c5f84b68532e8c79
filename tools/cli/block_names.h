#pragma once
// Long lists of block names for people: "c1-7 r1-5 s1-3" instead of 105 names.

#include <string>
#include <vector>

namespace talus::tools {

/// Groups stack names (c<column>r<row>s<slice>, with or without a prefix) that fill a whole box of columns, rows and
/// slices; other names stay as they are. At most `limit` items, then "and N more blocks".
std::string compactNames(const std::vector<std::string>& names, std::size_t limit = 12);

}  // namespace talus::tools
