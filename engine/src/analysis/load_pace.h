#pragma once
// How long the next load step of many blocks is: in none of them goes far, so far below the failure steps are longer, close to it
// shorter.

#include <cstdint>

namespace talus::analysis {

class LoadPace {
 public:
    /// \param own  the step that the load axis allows [cells]. \return most of the next one [cells]
    std::int64_t next(std::int64_t own) const;

    /// From a step in which all have come to rest again. \param step  [cells]. \param leaving  how far blocks have parted in it, of what
    /// leaves their place
    void learn(std::int64_t step, double leaving);

    /// A step was left open: the next one is half as long, those after it at most twice as long as the one before, until that limits
    /// none. \param step  [cells], at least 2
    void cutBack(std::int64_t step);

 private:
    std::int64_t most_ = 0;      ///< [cells]; 0: nothing is known
    std::int64_t cut_back_ = 0;  ///< most of the next step learnt [cells]; 0: no limit
};

}  // namespace talus::analysis
