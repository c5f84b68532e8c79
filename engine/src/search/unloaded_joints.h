#pragma once
// Joints that carry no normal force when an assembly is first in equilibrium. As blocks turn slightly between
// their neighbours, friction may lock on them and stabilise what statics alone would not. How much of it acts
// depends on the loading path. Without friction there, the answer is the lowest that statics allows.

#include <cstdint>
#include <set>
#include <utility>

#include "search/load_axis.h"

namespace talus::search {

class UnloadedJoints {
 public:
    UnloadedJoints() = default;
    /// Those with friction alone.
    /// \param carries_nothing  normal force over the lighter block's weight below which they count
    UnloadedJoints(const State& state, double carries_nothing);

    bool empty() const { return pairs_.empty(); }
    std::size_t size() const { return pairs_.size(); }

    /// The largest shear that one of them carries, over the lighter block's weight.
    double shearCarried(const State& state) const;

    /// Gives them joints without friction, behind those of the model. Writes: laws, joints of interfaces
    void release(State& state) const;

    /// The same strengths with those joints behind them.
    LoadAxis with(const LoadAxis& strength) const;

 private:
    std::set<std::pair<std::int32_t, std::int32_t>> pairs_{};  ///< of blocks
};

}  // namespace talus::search
