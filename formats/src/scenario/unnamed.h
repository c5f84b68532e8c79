#pragma once
// Materials and joints that a file gives and nothing in it has: a name misspelt in one of two places.

#include "scenario/reading.h"

namespace talus::formats::scenario {

/// Warns of each [material.NAME] and [joint.NAME] whose name no other value of the file is: blocks and joints that were to have it
/// have another's strength or density. [joint.default] needs no name, nor does the only material.
/// \param root  of the file
void warnOfUnnamed(Report& report, const Node& root);

}  // namespace talus::formats::scenario
