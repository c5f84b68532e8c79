#pragma once
// What is wet at a tilt that is sought.
//
// Water stands level while the slope is tilted, so the tilt decides which areas it wets, and with them the
// strength. Let C(t) be the critical tilt of the joints that are wet at t. At the tilt t the slope fails if
// C(t) <= t, so the tilt that is sought solves C(t) = t. It is found by repetition, t -> C(t), from the tilt
// where the search starts. Where that leaves the range between stable and failing tilts, the range is halved.
// From below that finds the least solution as long as nothing gets wetter on the way: the slope is then no
// weaker at any tilt between, and stable there. Where more is wet at a tilt between, that tilt comes next.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

class WetTilt {
 public:
    /// \pre hasWetJoints(model). Errors: as of buildWithWetJoints
    static Result<WetTilt> begin(const Model& model, bool parallel, const Control& control);

    /// With the joints that are wet at tilt(). Water weakens none of them any more.
    const Model& model() const { return *wet_; }
    double tilt() const { return built_.load.tilt; }  ///< [rad]

    /// \param found  where model() fails [rad]; infinite if it is stable up to the last tilt, and minus
    /// infinity if it fails at the first
    /// \return whether other areas are wet there. Then model() is the next one to search
    bool goesOn(double found);

    /// A warning where no tilt solves the equation: the slope is stable at stands() and fails at fails(),
    /// close together; "" otherwise.
    const std::string& doubt() const { return doubt_; }
    double stands() const { return stands_; }  ///< [rad]
    double fails() const { return fails_; }

 private:
    WetTilt(std::shared_ptr<const Model> given, State built);
    void tiltTo(double tilt);
    void doubtAt(double answer, double change);
    /// Between tilt() and an answer, where most is wetter than at both; nothing if nothing is.
    std::optional<double> wetterBefore(double answer);

    std::shared_ptr<const Model> given_;  ///< its joints are dry
    State built_;
    std::vector<double> shares_{};  ///< of its interfaces, at its tilt
    std::shared_ptr<const Model> wet_{};
    double stands_, fails_;  ///< the largest tilt known to be stable, the least known to fail [rad]
    int rounds_ = 0;
    std::string doubt_{};
};

}  // namespace talus
