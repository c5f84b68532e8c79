#include "search/wet_tilt_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "build/wet_joints.h"
#include "build/wet_tilt.h"
#include "frame/frame.h"
#include "measure/words.h"
#include "search/search_run.h"
#include "state/caller.h"
#include "talus/angles.h"
#include "talus/searches.h"

namespace talus::search {
namespace {

// Of the progress: the first searches are short, because they find the answer alone.
constexpr double kLastSearch = 0.5;

/// Where the slope fails, for WetTilt::goesOn; nothing where the search has not decided it.
std::optional<double> tiltOf(const SearchResult& result) {
    switch (result.status) {
        case SearchStatus::found:
            return result.answer;
        case SearchStatus::stable_to_stop:
            return kInfinity;
        case SearchStatus::unstable_at_start:
            return -kInfinity;
        case SearchStatus::undecided:
        case SearchStatus::interrupted:
            break;
    }
    return std::nullopt;
}

/// Progress of a part of the whole.
Control within(const Control& control, double from, double to) {
    Control part = control;
    if (control.progress)
        part.progress = [&control, from, to](const Progress& now) {
            control.progress({now.stage, std::lerp(from, to, now.fraction), now.detail});
        };
    return part;
}

/// For the answer alone. \param round  from 0
Control answerAlone(const Control& control, int round) {
    const double from = kLastSearch * (1 - std::exp2(-round)), to = kLastSearch * (1 - std::exp2(-round - 1));
    Control alone = within(control, from, to);
    alone.keep_failing_state = alone.interval = false;
    alone.groups = 1;
    alone.upper_bound = Beside::never;
    return alone;
}

/// Effort of the searches before the last.
struct Effort {
    std::int64_t steps = 0, factors = 0;
    double seconds = 0;

    void take(const SearchResult& result) {
        steps += result.steps;
        factors += result.factors;
        seconds += result.time.loading + result.time.path + result.time.beside;
    }
    void addTo(SearchResult& result) const {
        result.steps += steps;
        result.factors += factors;
        result.time.path += seconds;
    }
};

/// Gives the failing state the joints of a history of it, which are as wet as at the failing tilt: some cells
/// beyond the answer, where the wet areas hardly differ.
std::vector<Error> makePlayable(const Model& model, const Control& control, FailingState& failing) {
    auto at_failure = std::make_shared<Model>(model);
    putUnderLoad(*at_failure, Varied::tilt, failing.load);
    std::shared_ptr<const Model> kept = std::move(at_failure);
    Result<State> built = buildWithWetJoints(kept, control.threads != 1);
    if (!built) return built.errors();
    FrameInterfaces& f = failing.state.interfaces;
    const auto number = [](std::int32_t index) { return static_cast<std::size_t>(index); };
    for (std::size_t i = 0; i < f.size(); ++i)
        f.joint[i] = built->geometry->joints.between(number(f.block_a[i]), number(f.face_a[i]),
                                                     number(f.block_b[i]), number(f.face_b[i]));
    failing.state.laws = fullFrameOf(*built).laws;
    if (auto errors = takeFrame(failing.state, *built); !errors.empty()) return errors;
    failing.state = fullFrameOf(*built);
    return {};
}

/// Where what is wet changes abruptly the slope fails at that tilt, though not with the areas of either side.
void answerWithin(const WetTilt& wet, SearchResult& result) {
    result.warnings.push_back(wet.doubt());
    if (!std::isfinite(wet.stands()) || !std::isfinite(wet.fails())) return;
    const double other = result.status == SearchStatus::found ? result.answer : wet.fails();
    result.status = SearchStatus::found;
    result.low = wet.stands(), result.high = wet.fails();
    result.answer = 0.5 * (wet.stands() + wet.fails());
    auto interval = result.answer_interval.value_or(std::pair(other, other));
    result.answer_interval =
        std::pair(std::min(interval.first, result.answer), std::max(interval.second, result.answer));
    result.limit_equilibrium.reset();
    result.failing.reset();
}

}  // namespace

Result<SearchResult> findTiltOfWetJoints(const Model& model, const Control& control,
                                         const SearchRules& rules) {
    Result<WetTilt> wet = WetTilt::begin(model, control.threads != 1, control);
    if (isStopped(control)) return Search(Varied::tilt, model, control, rules).run();
    if (!wet) return wet.errors();
    Effort before;
    for (int round = 0;; ++round) {
        const Control alone = answerAlone(control, round);
        Result<SearchResult> answer = Search(Varied::tilt, wet->model(), alone, rules).run();
        if (!answer) return answer;
        const std::optional<double> tilt = tiltOf(*answer);
        if (!tilt && isStopped(control)) return answer;
        if (!tilt) {
            before.addTo(*answer);
            answer->warnings.push_back("the joints are as wet as at " +
                                       formatted("%.4g", degrees(wet->tilt())) + " deg of tilt");
            return answer;
        }
        before.take(*answer);
        if (!wet->goesOn(*tilt)) break;
    }
    Result<SearchResult> result =
        Search(Varied::tilt, wet->model(), within(control, kLastSearch, 1), rules).run();
    if (!result) return result;
    before.addTo(*result);
    if (!wet->doubt().empty()) answerWithin(*wet, *result);
    if (!result->failing) return result;
    FailingState failing = *result->failing;
    auto errors = makePlayable(model, control, failing);
    if (errors.empty()) {
        result->failing = std::make_shared<const FailingState>(std::move(failing));
        return result;
    }
    result->failing.reset();
    result->warnings.push_back(
        "the failure is not played, because the model is refused at the failing tilt: " +
        errors.front().field + ": " + errors.front().message);
    return result;
}

}  // namespace talus::search
