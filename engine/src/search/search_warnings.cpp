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

/// A contact point breaks under the mean stress of its area, and the stress at the edge is higher: in a
/// continuum the edge would break first, and all after it.
constexpr const char* kPointByPoint =
    "Tensile strength is lost one contact point after the other: the answer is on the unsafe side, and is "
    "lower with more contact points. ";

std::string percent(double share) { return formatted("%.0f", 100 * share); }

/// Limit equilibrium keeps cohesion to the end; eq 9 does not.
std::string ofLostCohesion(const LostStrength& lost) {
    return "the answer depends on cohesion that is lost where a joint first slips or opens (" +
           percent(lost.share) +
           " % of the area of such joints at failure). With residual_cohesion = cohesion, as in limit "
           "equilibrium, the answer may be higher. " +
           (lost.is_torn ? kPointByPoint : "") +
           "The upper bound of limit analysis assumes that cohesion is kept";
}

/// A brittle bond tears at its edge first.
std::string ofLostTension(const LostStrength& lost) {
    return "the answer depends on tensile strength that is lost at once where a joint first opens or slips "
           "(" +
           percent(lost.share) +
           " % of the area of such joints at failure). With softening_displacement, over which rock tears, "
           "the answer may be higher. " +
           kPointByPoint + "The upper bound of limit analysis assumes that tensile strength is kept";
}

/// Limit equilibrium counts the peak everywhere at once; a real joint slips progressively.
std::string ofLostFriction(const LostStrength& lost) {
    return "the answer depends on peak friction that is lost where a joint first slips or opens (" +
           percent(lost.share) +
           " % of the area of such joints at failure), one contact point after the other. The answer may be "
           "higher with residual_friction_deg = friction_deg, and lower with more contact points. The upper "
           "bound of limit analysis assumes peak friction";
}

/// At the start the elastic displacement is unknown; only the closure of joints under the load on them is.
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
    return "the joints close by " + formatted("%.2g", most) + " m under the load on them, " +
           formatted("%.3g", 100 * most / size) +
           " % of the block size: on such soft joints columns lean and overturn whatever their friction; is "
           "normal_stiffness in Pa/m?";
}

}  // namespace

double lostCohesion(const State& state) {
    return lostShare(state,
                     [](const contact::JointLaw& law) { return law.cohesion > law.residual_cohesion; });
}

std::optional<LostStrength> lostStrength(const State& failing) {
    const double torn = lostTension(failing);
    if (const double share = lostCohesion(failing); share > 0)
        return LostStrength{LostStrength::Kind::cohesion, share, torn > 0};
    if (torn > 0) return LostStrength{LostStrength::Kind::tension, torn, true};
    if (const double share = lostFriction(failing); share > 0)
        return LostStrength{LostStrength::Kind::friction, share, false};
    return std::nullopt;
}

const char* nameOf(LostStrength::Kind kind) {
    switch (kind) {
        case LostStrength::Kind::cohesion:
            return "cohesion";
        case LostStrength::Kind::tension:
            return "tensile strength";
        case LostStrength::Kind::friction:
            break;
    }
    return "peak friction";
}

std::string warningOf(const LostStrength& lost, const std::string& kept) {
    std::string text;
    switch (lost.kind) {
        case LostStrength::Kind::cohesion:
            text = ofLostCohesion(lost);
            break;
        case LostStrength::Kind::tension:
            text = ofLostTension(lost);
            break;
        case LostStrength::Kind::friction:
            text = ofLostFriction(lost);
            break;
    }
    if (!kept.empty()) text += std::string("; the answer with ") + nameOf(lost.kind) + " kept: " + kept;
    return text;
}

std::vector<std::string> searchWarnings(const State& built, const State& last, bool fails, bool at_start) {
    std::vector<std::string> warnings = built.warnings;
    if (fails && at_start)
        if (auto pressed = ofJointsPressedIn(last)) warnings.push_back(std::move(*pressed));
    return warnings;
}

}  // namespace talus::search
