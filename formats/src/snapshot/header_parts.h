#pragma once
// Waters, joints and a kept failure in the header's message. `fromMessage` is false for a damaged message.

#include <memory>
#include <vector>

#include "snapshot/fields.h"

namespace talus::formats {

std::unique_ptr<fb::WaterT> toMessage(const Water& water);
bool fromMessage(const fb::WaterT& m, Water& water);

bool allCoulomb(const std::vector<Joint>& joints);
fb::JointsT toMessage(const std::vector<Joint>& joints);
bool fromMessage(const fb::JointsT& m, std::vector<Joint>& joints);

fb::FailureT toMessage(const SnapshotFailure& failure);
bool fromMessage(const fb::FailureT& m, SnapshotFailure& failure);

}  // namespace talus::formats
