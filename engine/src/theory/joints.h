#pragma once
// Which joint acts between two faces, and whether a formula without memory may speak of it.

#include <map>
#include <optional>
#include <utility>

#include "talus/model.h"

namespace talus::theory {

/// Looks up the joint of an interface: the pair's own if it has one, else the one with less friction of the two
/// faces' joints, the one declared first on ties.
class JointTable {
 public:
    explicit JointTable(const Model& model);
    const Joint& between(const WetFace& a, const WetFace& b) const;

 private:
    const Model& model_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> of_pair_;
};

/// The face of a block whose outward normal is `direction` (to rounding).
std::optional<WetFace> faceTowards(const Model& model, std::int32_t block, const Vec3& direction);

/// Strength is the same before and after failure: no peak to lose, no tension, no dilation. With a peak, failure is
/// progressive and limit equilibrium only an upper bound.
bool isPlainCoulomb(const Joint& joint);

/// Nothing holds the joint together when it is pulled or sheared without normal force.
bool partsFreely(const Joint& joint);

}  // namespace talus::theory
