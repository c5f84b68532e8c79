#pragma once
// The limit tilt of a model whose joints water weakens: the analysis is repeated until what is wet is that of
// the limit (build/wet_tilt.h).

#include <cmath>
#include <optional>
#include <string>

#include "build/wet_tilt.h"
#include "state/caller.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/parallel.h"

namespace talus::limit {

/// For WetTilt::goesOn; nothing where the analysis has not decided it.
inline std::optional<double> tiltOf(const LimitResult& result) {
    if (result.status == SearchStatus::stable_to_stop) return kInfinity;
    if (result.status == SearchStatus::unstable_at_start) return -kInfinity;
    return result.status == SearchStatus::found ? std::optional(result.lower) : std::nullopt;
}
inline std::optional<double> tiltOf(const Ceiling& ceiling) { return ceiling.value; }

/// Where what is wet changes abruptly: the limit lies there.
inline void putWithin(const WetTilt& wet, LimitResult& result) {
    result.status = SearchStatus::found;
    result.lower = wet.stands(), result.upper = wet.fails();
}
inline void putWithin(const WetTilt& wet, Ceiling& ceiling) { ceiling = {wet.fails(), ""}; }

/// \pre hasWetJoints(model). \param analyse  its result for a model whose joints water does not weaken
/// \param doubt  that of WetTilt
template <class T, class Analyse>
Result<T> atWetTilt(const Model& model, const Control& control, const Analyse& analyse, std::string& doubt) {
    Result<WetTilt> wet =
        inArena(control.threads, [&] { return WetTilt::begin(model, control.threads != 1, control); });
    if (isStopped(control)) return analyse(model);
    if (!wet) return wet.errors();
    for (;;) {
        Result<T> found = analyse(wet->model());
        const std::optional<double> tilt = found ? tiltOf(*found) : std::nullopt;
        if (tilt && wet->goesOn(*tilt)) continue;
        doubt = wet->doubt();
        if (found && !doubt.empty() && std::isfinite(wet->stands()) && std::isfinite(wet->fails()))
            putWithin(*wet, *found);
        return found;
    }
}

}  // namespace talus::limit
