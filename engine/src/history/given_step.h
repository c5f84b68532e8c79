#pragma once
// A time step that the user gives, where it is above the stability bound: whether it goes well.

#include <optional>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::history {

/// The fault of a step: what it leads to, and what is allowed. \param step, bound  [s]
Error stepTooLong(const std::string& what, double step, double bound);

/// Steps above the stability bound may be stable, for the bound is no tight one: rocks that meet by vertices
/// go well with ten times that, a stack of faces has 3e43 J at six times. Blocks that nobody works on gain no
/// energy, and a history in which they do is at its end; where something does work, nobody can tell, and more
/// than twice the bound is refused.
class GivenStep {
 public:
    /// When the bound is known, and whenever it has changed. \pre step > bound
    std::optional<Error> begin(const State& state, double step, double bound, bool parallel);

    /// Now and then on the way. \pre step > bound
    std::optional<Error> look(const State& state, double step, double bound, bool parallel);

 private:
    double least_energy_ = kInfinity, most_kinetic_ = 0;  ///< so far [J]
};

}  // namespace talus::history
