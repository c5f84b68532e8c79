#include "block_theory/warnings.h"

#include <algorithm>
#include <set>

#include "checks/strength_held.h"
#include "forces/bolt_law.h"

namespace talus::keyblocks {
namespace {

/// "a", "b" and 3 more
std::string listed(const std::set<std::string>& names) {
    constexpr std::size_t kShown = 5;
    std::string text;
    std::size_t shown = 0;
    for (const std::string& name : names) {
        if (shown == kShown) break;
        text += (shown++ > 0 ? ", \"" : "\"") + name + "\"";
    }
    return names.size() > kShown ? text + " and " + std::to_string(names.size() - kShown) + " more" : text;
}

/// Names of the joints between free blocks and others that are of some kind.
template <class Is>
std::set<std::string> jointsThat(const State& state, const Slope& slope, const Is& is) {
    const std::vector<Joint>& joints = state.geometry->model.joints;
    std::vector<char> used(joints.size(), 0);
    for (const Contact& contact : slope.contacts) used[static_cast<std::size_t>(contact.joint)] = 1;
    std::set<std::string> names;
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (used[j] && is(joints[j])) names.insert(joints[j].name);
    return names;
}

/// Bolts that would pull harder once blocks move than they do at the start.
std::set<std::string> slackBolts(const State& state) {
    const std::vector<Bolt>& bolts = state.geometry->model.bolts;
    std::set<std::string> names;
    for (const BoltSegment& segment : state.bolts.segments)
        if (segment.law.dowel_stiffness > 0 ||
            bolt::axialStrength(segment.law, 1.0) > segment.law.pretension * (1 + 1e-9))
            names.insert(bolts[static_cast<std::size_t>(segment.bolt)].name);
    return names;
}

std::size_t pointContacts(const Slope& slope) {
    return static_cast<std::size_t>(std::count_if(slope.contacts.begin(), slope.contacts.end(),
                                                  [](const Contact& c) { return !c.is_patch; })) /
           2;
}

}  // namespace

std::vector<std::string> warningsOf(const State& state, const Slope& slope, const GroupSearch& search) {
    std::vector<std::string> told = state.warnings;
    for (std::string& held : checks::strengthsHeld(state.geometry->model)) told.push_back(std::move(held));
    const auto tell = [&](const std::set<std::string>& names, const std::string& what) {
        if (!names.empty()) told.push_back(what + ": " + listed(names));
    };
    tell(jointsThat(state, slope, [](const Joint& joint) { return joint.tensile_strength > 0; }),
         "the tensile strength of joints is not counted");
    tell(jointsThat(state, slope, [](const Joint& joint) { return joint.dilation != 0; }),
         "the dilation of joints is not counted");
    tell(slackBolts(state),
         "bolts count with their pretension; the force that they develop as blocks move is not counted");
    if (const std::size_t points = pointContacts(slope); points > 0)
        told.push_back(
            std::to_string(points) +
            " contacts of a vertex or of two edges restrict motion and have friction but no cohesion");
    if (search.left_out > 0)
        told.push_back(std::to_string(search.left_out) +
                       " groups of blocks were not tested, to save time: a weaker one may be among them");
    if (search.curve_left_out > 0) {
        told.push_back(std::to_string(search.curve_left_out) +
                       " groups of blocks were left out of the curve of factor and volume, to save time");
    }
    return told;
}

}  // namespace talus::keyblocks
