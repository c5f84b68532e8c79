// Critical angle, factor of safety, critical acceleration.

#include <algorithm>
#include <string>

#include "measure/words.h"
#include "search/search.h"
#include "search/search_warnings.h"
#include "talus/searches.h"

namespace talus {
namespace {

/// The same joint with that strength kept, as in limit equilibrium.
void keep(LostStrength::Kind kind, Joint& joint) {
    switch (kind) {
        case LostStrength::Kind::cohesion:
            joint.residual_cohesion = std::max(joint.residual_cohesion, joint.cohesion);
            break;
        case LostStrength::Kind::tension:
            if (joint.tensile_strength > 0)
                joint.softening_displacement = propertyOf(&Joint::softening_displacement).allowed.max;
            break;
        case LostStrength::Kind::friction:
            joint.residual_friction = std::max(joint.residual_friction, joint.friction);
            break;
    }
}

/// The answer with that strength kept, in text; "" where there is none. The time it took is added.
std::string keptAnswer(Varied varied, Model model, const Control& control, const SearchRules& rules,
                       SearchResult& result) {
    for (Joint& joint : model.joints) keep(result.lost_strength->kind, joint);
    Control alone = control;
    alone.keep_failing_state = false;
    alone.groups = 1;
    alone.interval = false;
    const Result<SearchResult> found = search::searchFor(varied, model, alone, rules);
    if (!found) return "";
    result.wall_seconds += found->wall_seconds;
    result.time.beside += found->wall_seconds;
    if (found->status != SearchStatus::found) return "";
    if (result.lost_strength->kind == LostStrength::Kind::cohesion) result.kept_cohesion = found->answer;
    const VariedQuantity& quantity = quantityOf(varied);
    return formatted("%.4f", found->answer / quantity.scale) + " " + quantity.unit;
}

void addLostStrength(Varied varied, const Model& model, const Control& control, const SearchRules& rules,
                     SearchResult& result) {
    if (!result.lost_strength) return;
    const bool is_sought = result.status == SearchStatus::found && control.interval;
    const std::string kept = is_sought ? keptAnswer(varied, model, control, rules, result) : "";
    result.warnings.push_back(search::warningOf(*result.lost_strength, kept));
}

Result<SearchResult> find(Varied varied, const Model& model, const Control& control,
                          const SearchRules& rules) {
    Result<SearchResult> result = search::searchFor(varied, model, control, rules);
    if (result) addLostStrength(varied, model, control, rules, *result);
    return result;
}

}  // namespace

Result<SearchResult> criticalAngle(const Model& model, const Control& control, const SearchRules& rules) {
    return find(Varied::tilt, model, control, rules);
}

Result<SearchResult> safetyFactor(const Model& model, const Control& control, const SearchRules& rules) {
    return find(Varied::factor, model, control, rules);
}

Result<SearchResult> criticalAcceleration(const Model& model, const Control& control,
                                          const SearchRules& rules) {
    return find(Varied::horizontal, model, control, rules);
}

}  // namespace talus
