// Critical angle, factor of safety, critical acceleration: each a search up its load.

#include <algorithm>
#include <functional>
#include <string>

#include "analysis/history_range.h"
#include "analysis/load_axis.h"
#include "analysis/search_of_the_rest.h"
#include "analysis/search_warnings.h"
#include "talus/analysis.h"

namespace talus {
namespace {

using Find = Result<SearchResult> (*)(const Model&, const Control&, const QuasiStatic&);

/// Strength that is lost at the first slip or opening: how a warning of it begins, and as limit equilibrium has it, kept.
struct LostStrength {
    const char* warning;
    const char* name;
    void (*keep)(Joint& joint);
};
constexpr LostStrength kLostStrengths[] = {
    {analysis::kHangsOnCohesion, "cohesion",
     [](Joint& joint) { joint.residual_cohesion = std::max(joint.residual_cohesion, joint.cohesion); }},
    {analysis::kHangsOnTension, "tensile strength",
     [](Joint& joint) {
         if (joint.tensile_strength > 0)
             joint.softening_displacement = propertyOf(&Joint::softening_displacement).allowed.max;
     }},
    {analysis::kHangsOnFriction, "peak friction",
     [](Joint& joint) { joint.residual_friction = std::max(joint.residual_friction, joint.friction); }}};

/// To the warning of an answer that hangs on strength lost so adds the answer for strength that is kept, in small models.
void tellKeptStrength(Find find, const Model& model, const Control& control, const QuasiStatic& settings,
                      const std::function<std::string(double)>& say, SearchResult& result) {
    if (result.status != SearchStatus::found ||
        result.contact_points > control.most_points_of_range / analysis::kDearerThanRange)
        return;
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
        alone.most_points_of_range = 0;
        alone.most_work = analysis::mostWorkBeside(result);
        const Result<SearchResult> found = find(kept, alone, settings);
        if (!found) return;
        result.wall_seconds += found->wall_seconds;
        const std::string beginning = std::string("; the answer with ") + lost.name + " kept: ";
        if (found->status == SearchStatus::undecided && found->low > result.answer)
            *warning += beginning + "above " + say(found->low) + ", where that search stopped";
        if (found->status != SearchStatus::found) return;
        if (lost.warning == analysis::kHangsOnCohesion) result.kept_cohesion = found->answer;
        *warning += beginning + say(found->answer);
        return;
    }
}

}  // namespace

Result<SearchResult> criticalAngle(const Model& model, const Control& control, const QuasiStatic& settings) {
    const analysis::LoadAxis axis = analysis::tiltAxis(model);
    Result<SearchResult> result = analysis::searchOfTheRest(model, axis, control, settings);
    if (result) tellKeptStrength(criticalAngle, model, control, settings, axis.say, *result);
    return result;
}

Result<SearchResult> safetyFactor(const Model& model, const Control& control, const QuasiStatic& settings) {
    const analysis::LoadAxis axis = analysis::strengthAxis(model);
    Result<SearchResult> result = analysis::searchOfTheRest(model, axis, control, settings);
    if (result) analysis::addGroups(model, axis, control, settings, *result);
    const auto say = [](double factor) { return analysis::formatted("factor %.4f", factor); };
    if (result) tellKeptStrength(safetyFactor, model, control, settings, say, *result);
    return result;
}

Result<SearchResult> criticalAcceleration(const Model& model, const Control& control,
                                          const QuasiStatic& settings) {
    const analysis::LoadAxis axis = analysis::accelerationAxis(model);
    Result<SearchResult> result = analysis::searchOfTheRest(model, axis, control, settings);
    if (result) tellKeptStrength(criticalAcceleration, model, control, settings, axis.say, *result);
    return result;
}

}  // namespace talus
