#pragma once
// The list of laws whose strength is a curve over the normal stress. A law is a header with its formula, and
// a line here (its name and properties: talus/joint_values.h, talus/joint.h). Coulomb's, a line with memory,
// is in law.h itself.

#include <array>
#include <vector>

#include "law/barton_bandis.h"
#include "law/envelope.h"
#include "law/power_law.h"

namespace talus::contact {

struct StrengthFormula {
    StrengthLaw law;
    double (*strength)(const Joint& joint, double normal_stress);  ///< of the intact joint [Pa]
    std::vector<double> (*kinks)(
        const Joint& joint);  ///< normal stresses where its slope jumps, ascending [Pa]
    bool is_straight;         ///< from kink to kink
};

template <class Law>
constexpr StrengthFormula formulaOf(StrengthLaw law) {
    return {law, Law::strength, Law::kinks, Law::kStraight};
}

inline constexpr std::array kStrengthFormulas{formulaOf<BartonBandis>(StrengthLaw::barton_bandis),
                                              formulaOf<Envelope>(StrengthLaw::envelope),
                                              formulaOf<PowerLaw>(StrengthLaw::power)};

/// Null for Coulomb's law.
constexpr const StrengthFormula* strengthFormula(StrengthLaw law) {
    for (const StrengthFormula& formula : kStrengthFormulas)
        if (formula.law == law) return &formula;
    return nullptr;
}

}  // namespace talus::contact
