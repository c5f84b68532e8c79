#pragma once
// Long lists of block names in short: "c1-7 r1-5 s1-3" instead of 105 names.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus::tools {

/// A stack block's name, taken apart: "leftc12r3s1".
struct StackName {
    std::string prefix;
    int column = 0, row = 0, slice = 0;
};
std::optional<StackName> stackName(std::string name);  ///< nothing for other names

/// Groups stack names (c<column>r<row>s<slice>, with or without a prefix) that fill a whole box of columns,
/// rows and slices; other names stay as they are. At most `limit` items, then "and N more blocks".
std::string compactNames(const std::vector<std::string>& names, std::size_t limit = 12);

/// The names of a list that compactNames made without a limit. Names that hold ", " come back in pieces.
std::vector<std::string> expandedNames(std::string_view list);

}  // namespace talus::tools
