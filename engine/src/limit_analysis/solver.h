#pragma once
// Answers about one assembly, from linear programmes whose pyramids are refined until they are equivalent to
// cones.

#include <cstdint>
#include <vector>

#include "limit_analysis/programme.h"
#include "talus/control.h"

namespace talus::limit {

/// Whether forces balance the loads.
struct Balance {
    Outcome outcome = Outcome::failed;
    bool balanced = false;
    double imbalance = 0;  ///< what they lack, over the mean weight
    double growth = 0;     ///< of that per logarithm of the strengths' divisor
};

/// The greatest multiplier of a growing load.
struct Growth {
    Outcome outcome = Outcome::failed;
    double multiplier = 0;
};

/// What it took.
struct Effort {
    std::size_t rows = 0, columns = 0;  ///< of the largest programme
    int programmes = 0;
    std::int64_t iterations = 0;
};

class Solver {
 public:
    Solver(const Assembly& assembly, std::vector<contact::JointLaw> laws, const Control& control);

    void setLaws(std::vector<contact::JointLaw> laws) { laws_ = std::move(laws); }

    Balance check(const Loads& loads, Side side);
    /// Outside: until the multiplier is below `enough`, or refinement changes nothing.
    Growth grow(const Loads& fixed, const Loads& growing, double least, double most, Side side,
                double enough = 0);

    /// Of the last answer that found one.
    const std::vector<BodyMotion>& mechanism() const { return mechanism_; }
    const Effort& effort() const { return effort_; }

 private:
    Programme make(Side side, const Loads& fixed, const Loads& growing) const;
    Balance checkInside(const Loads& loads);
    Balance read(const Programme& programme, Outcome outcome);
    Growth growOnce(const Loads& fixed, const Loads& growing, double least, double most, Side side);
    void account(const Programme& programme, Side side);

    const Assembly& assembly_;
    std::vector<contact::JointLaw> laws_;
    const Control& control_;
    Pyramids pyramids_;
    bool refined_ = false;  ///< since the basis was kept
    Side basis_side_ = Side::inside;
    std::vector<unsigned char> basis_;
    std::vector<BodyMotion> mechanism_;
    Effort effort_;
};

}  // namespace talus::limit
