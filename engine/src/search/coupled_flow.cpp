// The flow whose apertures follow the joints, at the equilibrium where searches begin.

#include <algorithm>
#include <utility>

#include "checks/water_warnings.h"
#include "search/search_run.h"
#include "state/caller.h"
#include "state/threads.h"
#include "talus/flow.h"

namespace talus::search {
namespace {

/// Numbers of blocks in the model, for those of the model without the removed ones.
std::vector<std::int32_t> remaining(const std::vector<char>& gone) {
    std::vector<std::int32_t> numbers;
    for (std::size_t b = 0; b < gone.size(); ++b)
        if (gone[b] == 0) numbers.push_back(static_cast<std::int32_t>(b));
    return numbers;
}

}  // namespace

Result<SteadyFlow> Search::flowAtBeginning() {
    for (;;) {
        if (auto errors = build(); !errors.empty()) return errors;
        const Course course = isStopped(control_) ? Course{} : begin();
        if (removeFallen(course)) continue;
        if (const auto finer = withFinerFlow(course)) return finer->flowAtBeginning();
        return flowAt(course);
    }
}

std::unique_ptr<Search> Search::withFinerFlow(const Course& course) const {
    if (!coupled_ || !model_.flow->refines || isStopped(control_)) return nullptr;
    if (course.begun.result != PathResult::reached) return nullptr;
    const int more = checks::moreRefinements(*coupled_, lastEquilibrium(course));
    if (more == 0) return nullptr;
    Model model = model_;
    model.flow->refinements += more;
    report("loading", 0,
           "with a finer mesh of the flow, refinements = " + std::to_string(model.flow->refinements));
    auto finer =
        std::make_unique<Search>(varied_, std::make_shared<const Model>(std::move(model)), control_, rules_);
    finer->most_factors_ = most_factors_;
    finer->enough_ = enough_;
    finer->result_.steps = result_.steps;
    finer->result_.factors = result_.factors;
    finer->result_.time = result_.time;
    return finer;
}

std::optional<SearchResult> Search::onFinerMesh(const Course& course) {
    const auto finer = withFinerFlow(course);
    if (!finer) return std::nullopt;
    const int refinements = finer->model_.flow->refinements;
    Result<SearchResult> found = finer->run();
    std::string why;
    if (!found) {
        why = found.errors().front().field + ": " + found.errors().front().message;
    } else if (found->status == SearchStatus::interrupted) {
        why = "interrupted";
    } else if (found->status == SearchStatus::undecided) {
        why = "undecided";
    } else {
        return std::move(*found);
    }
    if (found) {
        result_.steps = found->steps;
        result_.factors = found->factors;
        result_.time = found->time;
    }
    result_.warnings.push_back(model_.flow->field + ".refinements: with " + std::to_string(refinements) +
                               ", which joints ask for, there is no answer (" + why + "); this one is with " +
                               std::to_string(model_.flow->refinements));
    return std::nullopt;
}

void Search::nameInFlow(SteadyFlow& flow) {
    nameFallen();
    for (const BlockGroup& group : result_.removed_groups)
        result_.warnings.push_back(
            (group.blocks.size() == 1 ? "1 block fails"
                                      : std::to_string(group.blocks.size()) + " blocks fail") +
            std::string(" on the way to the equilibrium (for example ") + group.blocks.front() +
            ") with less mass than analysis.least_mass_share: removed there; the joints around stay "
            "in the flow");
    flow.fallen_at_start = std::move(result_.fallen_at_start);
    for (std::string& warning : result_.warnings) flow.warnings.push_back(std::move(warning));
}

Result<SteadyFlow> Search::flowAt(const Course& course) {
    const std::string field = model_.flow->field + ".coupled";
    if (isStopped(control_)) return Error{field, "interrupted before the equilibrium was found"};
    if (course.begun.result != PathResult::reached)
        return Error{field, std::string("found no equilibrium while the ") + course.begun.stage +
                                " is applied, and coupled flow is that of an equilibrium; allowed: a slope "
                                "that is stable under its own loads, or coupled = false"};
    const State& state = course.path->state();
    Result<SteadyFlow> flow = coupled_->flowIn(state);
    if (!flow) return flow;
    const std::vector<std::int32_t> number = remaining(gone_);
    for (auto* blocks : {&flow->block_a, &flow->block_b})
        for (std::int32_t& block : *blocks) block = number[static_cast<std::size_t>(block)];
    flow->coupling = coupled_->coupling(state);
    nameInFlow(*flow);
    for (std::string& warning : checks::ofCoupling(*coupled_, state))
        flow->warnings.push_back(std::move(warning));
    return flow;
}

}  // namespace talus::search

namespace talus {

Result<SteadyFlow> coupledFlow(const Model& model, const Control& control) {
    return inArena(control.threads, [&]() -> Result<SteadyFlow> {
        const SearchRules rules;
        // The search for an acceleration begins under the model's own loads.
        return search::Search(Varied::horizontal, model, control, rules).flowAtBeginning();
    });
}

}  // namespace talus
