#pragma once
// A search that is made again when its failure is not borne out, without the blocks that fall whatever the strength, and
// for each further group.

#include <string>
#include <vector>

#include "analysis/load_axis.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// \param without names of blocks that are not to take part
Result<SearchResult> searchOfTheRest(const Model& model, const LoadAxis& axis, const Control& control,
                                     const QuasiStatic& settings,
                                     const std::vector<std::string>& without = {});

/// The groups that go one after the other: the search is made again without those that have gone. What then falls at
/// the start whatever the strength, or is let go before the next group, goes with the group before it; a group that fails at a lower factor than the one
/// before goes at that one's.
void addGroups(const Model& model, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
               SearchResult& result);

}  // namespace talus::analysis
