// Critical angle, factor of safety, critical acceleration: each a search up its load.

#include <algorithm>
#include <functional>
#include <string>

#include "analysis/load_axis.h"
#include "analysis/search_of_the_rest.h"
#include "analysis/search_warnings.h"
#include "talus/analysis.h"

namespace talus {
namespace {

using Find = Result<SearchResult> (*)(const Model&, const Control&, const QuasiStatic&);

// A search with cohesion kept takes as long as the first, or ten times as long: it is made up to a fifteenth of the contact points up
// to which other loading histories are looked at.
constexpr std::size_t kDearerThanRange = 15;

// As limit equilibrium has it: what slips or tears keeps its strength.
void keepCohesion(Joint& joint) {
    joint.residual_cohesion = std::max(joint.residual_cohesion, joint.cohesion);
}
void keepTension(Joint& joint) {
    if (joint.tensile_strength > 0)
        joint.softening_displacement = propertyOf(&Joint::softening_displacement).allowed.max;
}

/// To the warning of an answer that hangs on cohesion or tensile strength lost at the first slip or opening adds the answer for
/// strength that is kept, in small models.
void tellKeptStrength(Find find, const Model& model, const Control& control, const QuasiStatic& settings,
                      const std::function<std::string(double)>& say, SearchResult& result) {
    const auto warning =
        std::find_if(result.warnings.begin(), result.warnings.end(), [](const std::string& text) {
            return text.starts_with(analysis::kHangsOnCohesion) ||
                   text.starts_with(analysis::kHangsOnTension);
        });
    if (warning == result.warnings.end() || result.status != SearchStatus::found ||
        result.contact_points > control.most_points_of_range / kDearerThanRange)
        return;
    const bool is_cohesion = warning->starts_with(analysis::kHangsOnCohesion);
    Model kept = model;
    for (Joint& joint : kept.joints) is_cohesion ? keepCohesion(joint) : keepTension(joint);
    Control alone = control;
    alone.keep_failing_state = false;
    alone.groups = 1;
    alone.most_points_of_range = 0;
    const Result<SearchResult> found = find(kept, alone, settings);
    if (!found) return;
    result.wall_seconds += found->wall_seconds;
    if (found->status != SearchStatus::found) return;
    if (is_cohesion) result.kept_cohesion = found->answer;
    *warning += std::string("; the answer with ") + (is_cohesion ? "cohesion" : "tensile strength") +
                " kept: " + say(found->answer);
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
