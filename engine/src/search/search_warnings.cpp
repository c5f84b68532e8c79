#include "search/search_warnings.h"

#include <algorithm>
#include <optional>

#include "forces/contact_forces.h"
#include "measure/words.h"
#include "state/incidence.h"

namespace talus::search {

namespace {

/// Share of the area of joints that `may_lose` strength for good that has lost it, 0..1.
double lostShare(const State& state, bool (*may_lose)(const contact::JointLaw&)) {
    double all = 0, lost = 0;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        if (!may_lose(law) || isIdle(state.interfaces, i)) continue;
        for (const ContactPoint& point : contactPoints(state, i)) {
            all += point.area;
            lost += (1 - point.memory.bond) * point.area;
        }
    }
    return all > 0 ? lost / all : 0.0;
}

double lostTension(const State& state) {
    return lostShare(state, [](const contact::JointLaw& law) {
        return law.tensile_strength > 0 && !contact::softens(law);
    });
}

double lostFriction(const State& state) {
    return lostShare(state, [](const contact::JointLaw& law) {
        return !law.curved && !contact::softens(law) && law.tan_friction > law.residual_tan_friction;
    });
}

/// Limit equilibrium keeps cohesion to the end; eq 9 does not.
std::optional<std::string> ofLostCohesion(double lost) {
    if (lost == 0) return std::nullopt;
    return kHangsOnCohesion + std::string(" where a joint first slips or opens (") +
           formatted("%.0f", 100 * lost) +
           " % of its area in the failure): with residual_cohesion = cohesion, as limit equilibrium has it, "
           "it may be "
           "higher; the ceiling of limit analysis counts it as kept";
}

/// What tears at once does so at its edge first.
std::optional<std::string> ofLostTension(double lost) {
    if (lost == 0) return std::nullopt;
    return kHangsOnTension + std::string(" at once where a joint first opens or slips (") +
           formatted("%.0f", 100 * lost) +
           " % of its area in the failure): with softening_displacement, over which rock tears, it may be "
           "higher; the ceiling of limit analysis counts it as kept";
}

/// Limit equilibrium counts the peak everywhere at once; a joint slips at one point after the other.
std::optional<std::string> ofLostFriction(double lost) {
    if (lost == 0) return std::nullopt;
    return kHangsOnFriction + std::string(" where a joint first slips or opens (") +
           formatted("%.0f", 100 * lost) +
           " % of its area in the failure), one contact point after the other: with residual_friction_deg = "
           "friction_deg it may be higher, with more contact points lower; the ceiling of limit analysis "
           "counts "
           "the peak";
}

/// At the start nothing is known of what blocks move at rest, but how far what lies on them presses their
/// joints.
std::optional<std::string> ofJointsPressedIn(const State& state) {
    constexpr double kPressed = 5e-3;  // of the smaller block's size
    double most = 0, size = 1;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        if (isIdle(state.interfaces, i)) continue;
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        const double smaller =
            std::min(state.geometry->size[static_cast<std::size_t>(state.interfaces.block_a[i])],
                     state.geometry->size[static_cast<std::size_t>(state.interfaces.block_b[i])]);
        for (const ContactPoint& point : contactPoints(state, i)) {
            const double pressed = point.force.normal / (law.normal_stiffness * point.area);
            if (pressed * size > most * smaller) most = pressed, size = smaller;
        }
    }
    if (most <= kPressed * size) return std::nullopt;
    return "the joints give by " + formatted("%.2g", most) + " m under what lies on them, " +
           formatted("%.2g", 100 * most / size) +
           " % of a block: on joints so soft columns lean and overturn by themselves, whatever their "
           "friction; is "
           "normal_stiffness in Pa/m?";
}

}  // namespace

double lostCohesion(const State& state) {
    return lostShare(state,
                     [](const contact::JointLaw& law) { return law.cohesion > law.residual_cohesion; });
}

std::vector<std::string> searchWarnings(const State& built, const State& last, bool fails, bool at_start) {
    std::vector<std::string> warnings = built.warnings;
    if (!fails) return warnings;
    if (at_start)
        if (auto pressed = ofJointsPressedIn(last)) warnings.push_back(std::move(*pressed));
    if (auto lost = ofLostCohesion(lostCohesion(last))) {
        warnings.push_back(std::move(*lost));
    } else if (auto torn = ofLostTension(lostTension(last))) {
        warnings.push_back(std::move(*torn));
    } else if (auto slipped = ofLostFriction(lostFriction(last))) {
        warnings.push_back(std::move(*slipped));
    }
    return warnings;
}

}  // namespace talus::search
