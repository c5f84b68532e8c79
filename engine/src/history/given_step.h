#pragma once
// Checks of a time step that the user gives above the stability bound.

#include <optional>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::history {

/// The fault of a step, with its consequence and the allowed value. \param step, bound [s]
Error stepTooLong(const std::string& what, double step, double bound);

/// Steps above the stability bound may be stable, for the bound is not tight. Rocks that meet by vertices are
/// stable at ten times the bound; a stack of faces reaches 3e43 J at six times. Blocks on which nothing works
/// gain no energy, and a history in which they do is stopped. Where something does work no such check exists,
/// and more than twice the bound is refused.
class GivenStep {
 public:
    /// When the bound is known, and whenever it has changed. \pre step > bound
    std::optional<Error> begin(const State& state, double step, double bound, bool parallel);

    /// At intervals during the run. \pre step > bound
    std::optional<Error> look(const State& state, double step, double bound, bool parallel);

 private:
    double least_energy_ = kInfinity, most_kinetic_ = 0;  ///< so far [J]
};

}  // namespace talus::history
