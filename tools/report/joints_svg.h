#pragma once
// Pictures of a rock mass' joints: their poles, and the sizes of discs and blocks.

#include <string>
#include <string_view>
#include <vector>

#include "talus/formats/fractures.h"
#include "talus/model.h"

namespace talus::tools {

/// Poles of all planes on the lower hemisphere, equal-area (Schmidt), north upwards, each set in a colour of
/// its own. The legend has their number, the dip and dip direction of their mean, and Fisher's constant of
/// their scatter.
std::string stereonetSvg(const std::vector<formats::RockJoint>& joints, std::string_view title);

/// Share of discs (by set) and of blocks smaller than a size, over the size on a logarithmic axis.
std::string sizesSvg(const std::vector<formats::RockJoint>& joints, const Model& model,
                     std::string_view title);

}  // namespace talus::tools
