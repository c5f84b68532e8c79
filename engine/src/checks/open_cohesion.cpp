#include "checks/open_cohesion.h"

#include "forces/contact_forces.h"
#include "measure/words.h"
#include "state/incidence.h"
#include "state/point_layout.h"

namespace talus::checks {
namespace {

bool countsWholePoints(const State& state, const contact::JointLaw& law) {
    if (!(law.cohesion > 0 || law.residual_cohesion > 0)) return false;
    return !isDistributed(state) || contact::dilates(law) || law.tensile_strength > 0;
}

}  // namespace

double openCohesion(const State& state, const std::vector<std::size_t>& blocks) {
    std::vector<char> counts(state.blocks.size(), blocks.empty() ? 1 : 0);
    for (const std::size_t b : blocks) counts[b] = 1;
    const Interfaces& f = state.interfaces;
    double all = 0, open = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const bool is_theirs = counts[static_cast<std::size_t>(f.block_a[i])] != 0 ||
                               counts[static_cast<std::size_t>(f.block_b[i])] != 0;
        if (!is_theirs || isIdle(f, i)) continue;
        all += f.area[i];
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
        if (countsWholePoints(state, law) && isPartlyOpen(state, i)) open += f.area[i];
    }
    return all > 0 ? open / all : 0.0;
}

std::optional<std::string> ofOpenCohesion(const State& state, const std::vector<std::size_t>& blocks) {
    const double share = openCohesion(state, blocks);
    if (!(share > kLeastOpenCohesion)) return std::nullopt;
    return "joints with cohesion are open in part (" + formatted("%.3g", 100 * share) +
           " % of the joint area of the blocks in question). Contact points there count their cohesion as a "
           "whole, which may be unsafe. contact.points = \"distributed\" counts the closed part of joints "
           "that neither dilate nor have tensile strength";
}

}  // namespace talus::checks
