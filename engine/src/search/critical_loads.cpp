// Critical angle, factor of safety, critical acceleration.

#include <algorithm>
#include <functional>
#include <string>

#include "measure/words.h"
#include "search/search.h"
#include "search/search_warnings.h"
#include "talus/searches.h"

namespace talus {
namespace {

/// Strength that is lost at the first slip or opening: the beginning of its warning, and the same joints with
/// that strength kept, as in limit equilibrium.
struct LostStrength {
    const char* warning;
    const char* name;
    void (*keep)(Joint& joint);
};
constexpr LostStrength kLostStrengths[] = {
    {search::kDependsOnCohesion, "cohesion",
     [](Joint& joint) { joint.residual_cohesion = std::max(joint.residual_cohesion, joint.cohesion); }},
    {search::kDependsOnTension, "tensile strength",
     [](Joint& joint) {
         if (joint.tensile_strength > 0)
             joint.softening_displacement = propertyOf(&Joint::softening_displacement).allowed.max;
     }},
    {search::kDependsOnFriction, "peak friction",
     [](Joint& joint) { joint.residual_friction = std::max(joint.residual_friction, joint.friction); }}};

/// Adds the answer for kept strength to the warning of an answer that depends on lost strength.
void addKeptStrength(Varied varied, const Model& model, const Control& control, const SearchRules& rules,
                     SearchResult& result) {
    if (result.status != SearchStatus::found || !control.interval) return;
    for (const LostStrength& lost : kLostStrengths) {
        const auto warning =
            std::find_if(result.warnings.begin(), result.warnings.end(),
                         [&](const std::string& text) { return text.starts_with(lost.warning); });
        if (warning == result.warnings.end()) continue;
        Model kept = model;
        for (Joint& joint : kept.joints) lost.keep(joint);
        Control alone = control;
        alone.keep_failing_state = false;
        alone.groups = 1;
        alone.interval = false;
        const Result<SearchResult> found = search::searchFor(varied, kept, alone, rules);
        if (!found) return;
        result.wall_seconds += found->wall_seconds;
        result.time.beside += found->wall_seconds;
        if (found->status != SearchStatus::found) return;
        if (lost.warning == search::kDependsOnCohesion) result.kept_cohesion = found->answer;
        const VariedQuantity& quantity = quantityOf(varied);
        *warning += std::string("; the answer with ") + lost.name +
                    " kept: " + formatted("%.4f", found->answer / quantity.scale) + " " + quantity.unit;
        return;
    }
}

Result<SearchResult> find(Varied varied, const Model& model, const Control& control,
                          const SearchRules& rules) {
    Result<SearchResult> result = search::searchFor(varied, model, control, rules);
    if (result) addKeptStrength(varied, model, control, rules, *result);
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
