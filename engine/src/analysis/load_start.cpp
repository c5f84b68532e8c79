#include "analysis/load_start.h"

#include <array>
#include <span>
#include <utility>

namespace talus::analysis {
namespace {

constexpr double kStartPeriods = 20.0;  // nothing is known of the slowest period yet but a guess

/// Ends with the first part that does not come to rest, however patiently it is watched.
Verdict bringOnInParts(Probing& p, const std::string& stage, std::span<const double> parts,
                       const Ramp& load) {
    Verdict verdict = Verdict::stable;
    double from = 0;
    for (const double to : parts) {
        if (verdict != Verdict::stable || interrupted(p)) break;
        const State before = p.last_stable;
        verdict = probe(p, stage, p.axis.start,
                        [&](State& state, double share) { load(state, from + share * (to - from)); });
        if (verdict == Verdict::failing && settles(p, p.last_moving, p.axis.start, kStartPeriods)) {
            learnPeriod(p.work, before, p.last_stable);
            verdict = Verdict::stable;
        }
        from = to;
    }
    return verdict;
}

/// Weight in parts on level ground, then the tilt in parts: from each the slowest period is learnt. Laid on at once,
/// close below the angle at which a column topples, weight sets off a rocking so slow that it looks like failure.
Verdict loadGravityInParts(Probing& p) {
    constexpr std::array<double, 5> kParts{0.125, 0.25, 0.5, 0.75, 1.0};
    const double tilt = p.last_stable.load.tilt;
    p.last_stable.load.tilt = 0;
    const Verdict level = bringOnInParts(
        p, "gravity in parts", kParts, [](State& state, double share) { state.load.gravity_share = share; });
    if (level != Verdict::stable || tilt == 0) return level;
    return bringOnInParts(p, "tilting", kParts,
                          [tilt](State& state, double share) { state.load.tilt = share * tilt; });
}

Verdict loadGravity(Probing& p, const std::function<bool()>& is_seen_to_fail) {
    const State unloaded = p.last_stable;
    Verdict verdict = probe(p, "gravity", p.axis.start,
                            [](State& state, double share) { state.load.gravity_share = share; });
    if (verdict == Verdict::failing && !interrupted(p) && is_seen_to_fail()) return verdict;
    if (verdict == Verdict::failing && settles(p, p.last_moving, p.axis.start, kStartPeriods)) {
        learnPeriod(p.work, unloaded, p.last_stable);
        verdict = Verdict::stable;
    }
    if (verdict == Verdict::stable || interrupted(p)) return verdict;
    p.last_stable = unloaded;
    return loadGravityInParts(p);
}

Verdict loadWater(Probing& p) {
    const Verdict verdict =
        probe(p, "water", p.axis.start, [](State& state, double share) { state.load.water_share = share; });
    const bool rests = verdict == Verdict::failing && settles(p, p.last_moving, p.axis.start, kStartPeriods);
    return rests ? Verdict::stable : verdict;
}

}  // namespace

Verdict loadGravityAndWater(Probing& p, const std::function<bool()>& is_seen_to_fail) {
    p.axis.apply(p.last_stable, p.axis.start);
    p.start_tilt = p.last_stable.load.tilt;
    p.last_stable.load.gravity_share = p.last_stable.load.water_share = 0;
    Verdict verdict = loadGravity(p, is_seen_to_fail);
    if (verdict == Verdict::stable && p.last_stable.geometry->model.hasWater()) verdict = loadWater(p);
    p.has_stood = verdict == Verdict::stable;
    p.settlement = p.deflection;
    return verdict;
}

bool restsAfterAll(Probing& p) {
    State moved = p.last_moving;
    p.axis.apply(moved, p.axis.start);
    if (moved.load.gravity_share < 1 || moved.load.tilt != p.start_tilt) return false;
    takeBack(moved, p.work);
    const State before = std::exchange(p.last_stable, moved);  // what it has fallen is none of its deflection
    if (!settles(p, moved, p.axis.start, kStartPeriods)) {
        p.last_stable = before;
        return false;
    }
    const bool dry = !p.last_stable.geometry->model.hasWater() || p.last_stable.load.water_share == 1;
    return dry || loadWater(p) == Verdict::stable;
}

}  // namespace talus::analysis
