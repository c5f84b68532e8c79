#include "talus/storm.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "build/build.h"
#include "checks/closed_volumes.h"
#include "checks/plausible.h"
#include "checks/water_levels.h"
#include "checks/water_warnings.h"
#include "forces/closed_water.h"
#include "measure/words.h"
#include "search/filling.h"
#include "state/caller.h"

namespace talus {
namespace {

// Halvings of the range of levels, or strengths, before a straight line is accepted: nine searches if there
// are as many levels. A kink between two neighbours of them is missed.
constexpr int kHalvings = 2;
// Of the tolerance of factors, by which the search between two others may lie off their straight line. Lines
// to it are drawn from both. A parabola through the three is off these lines by a quarter of that at most.
constexpr double kOffLine = 4;

/// Joints whose strengths change alike.
struct ChangingJoints {
    std::string names;
    std::vector<std::size_t> joints{};  ///< of the model
};

std::vector<ChangingJoints> changingJoints(const std::vector<Joint>& joints) {
    std::vector<ChangingJoints> all;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (!changesStrength(joints[j])) continue;
        const auto& table = joints[j].strength_over_time;
        const auto alike = std::find_if(all.begin(), all.end(), [&](const ChangingJoints& each) {
            return joints[each.joints.front()].strength_over_time == table;
        });
        if (alike == all.end()) {
            all.push_back({joints[j].name, {j}});
            continue;
        }
        // One derived from another ("default@18.5deg") has no name in the scenario.
        if (joints[j].name.find('@') == std::string::npos) alike->names += ", " + joints[j].name;
        alike->joints.push_back(j);
    }
    return all;
}

/// Levels and strengths that occur, and the factor of safety with them.
struct Stand {
    /// levels of the waters that change, then factors of the strengths that change
    std::vector<double> values;
    bool known = false;
    StormPoint found{};
    std::vector<std::string> moving_blocks{}, warnings{};
};

/// The factor of safety for comparisons: infinite where it stands at any factor tried, 0 where no strength
/// holds it, NaN where it is undecided.
double valueOf(const StormPoint& point) {
    switch (point.status) {
        case SearchStatus::found:
            return point.factor;
        case SearchStatus::stable_to_stop:
            return kInfinity;
        case SearchStatus::unstable_at_start:
            return 0;
        case SearchStatus::undecided:
        case SearchStatus::interrupted:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

class StormSearch {
 public:
    StormSearch(const Model& model, const Control& control) : model_(model), control_(control) {
        for (std::size_t water = 0; water < model.waters.size(); ++water)
            if (search::changes(model.waters[water])) changing_.push_back(water);
        joints_ = changingJoints(model.joints);
    }

    std::vector<Error> fill(const std::vector<double>& times) {
        Result<State> state = buildState(keptByCaller(model_), control_.threads != 1, control_);
        if (isStopped(control_)) return {};
        if (!state) return state.errors();
        if (auto errors = checks::implausible(*state); !errors.empty()) return errors;
        tellOfTables(*state);
        tell(checks::leaksWithoutPressure(model_));
        const auto levels = search::levelsOver(*state, times, control_);
        result_.at_end = closedWaterReports(*state);
        std::map<std::vector<double>, std::size_t> distinct;  // ascending by the first level, then the second
        for (std::size_t k = 0; k < levels.size(); ++k) {
            StormPoint& point = result_.points.emplace_back();
            point.time = times[k];
            for (const std::size_t water : changing_) point.levels.push_back(levels[k][water]);
            for (const ChangingJoints& joints : joints_)
                point.strengths.push_back(strengthFactor(model_.joints[joints.joints.front()], point.time));
            distinct.emplace(valuesAt(point), 0);
        }
        for (auto& [of, index] : distinct) {
            index = stands_.size();
            stands_.push_back({of});
        }
        for (const StormPoint& point : result_.points) stand_at_.push_back(distinct.at(valuesAt(point)));
        return {};
    }

    std::vector<Error> search() {
        if (stands_.empty()) return {};  // interrupted
        for (const std::size_t water : changing_) result_.waters.push_back(model_.waters[water].field);
        for (const ChangingJoints& joints : joints_) result_.joints.push_back(joints.names);
        if (const auto one = theOnlyOneThatVaries())
            refine(0, stands_.size() - 1, *one, kHalvings);
        else
            for (std::size_t k = 0; k < stands_.size(); ++k) find(k);
        while (const auto next = worthASearch()) find(*next);
        return errors_;
    }

    StormResult result() {
        for (std::size_t k = 0; k < result_.points.size(); ++k) take(k);
        result_.least = least();
        if (result_.least) {
            Stand& stand = stands_[stand_at_[*result_.least]];
            result_.moving_blocks = std::move(stand.moving_blocks);
            for (std::string& warning : stand.warnings)
                if (!isOfTable(warning)) tell(std::move(warning));
        }
        if (const auto first = firstFailing()) result_.failure_time = crossingBefore(*first);
        result_.interrupted = isStopped(control_);
        return std::move(result_);
    }

 private:
    void tell(std::string warning) {
        auto& told = result_.warnings;
        if (std::find(told.begin(), told.end(), warning) == told.end()) told.push_back(std::move(warning));
    }
    void tell(const std::vector<Error>& doubts) {
        for (const Error& doubt : doubts) tell(doubt.field + ": " + doubt.message);
    }

    /// Of levels that are tables over time: the search at the least factor holds one of them. What it fills a
    /// closed volume to, it tells itself.
    void tellOfTables(const State& state) {
        for (const auto& doubts : {checks::levelsAboveJoints(state, true), checks::dryWaters(state)})
            for (const Error& doubt : doubts)
                if (const std::string warning = doubt.field + ": " + doubt.message; isOfTable(warning))
                    tell(warning);
    }

    /// Whether a warning is one of a level over time: of where it stands, or by a key of its own.
    bool isOfTable(const std::string& warning) const {
        return std::any_of(changing_.begin(), changing_.end(), [&](std::size_t w) {
            const Water& water = model_.waters[w];
            return !water.closed &&
                   (warning.starts_with(water.field + ".") || checks::isOfLevelAboveJoint(warning, water));
        });
    }

    bool goesOn() const { return errors_.empty() && !isStopped(control_); }

    static std::vector<double> valuesAt(const StormPoint& point) {
        std::vector<double> values = point.levels;
        values.insert(values.end(), point.strengths.begin(), point.strengths.end());
        return values;
    }

    /// Index among the values of stands; nothing where several take different values.
    std::optional<std::size_t> theOnlyOneThatVaries() const {
        std::optional<std::size_t> only;
        for (std::size_t v = 0; v < changing_.size() + joints_.size(); ++v) {
            const bool varies = std::any_of(stands_.begin(), stands_.end(), [&](const Stand& stand) {
                return stand.values[v] != stands_.front().values[v];
            });
            if (varies && only) return std::nullopt;
            if (varies) only = v;
        }
        return only;
    }

    Model held(const Stand& stand) const {
        Model model = model_;
        for (std::size_t w = 0; w < changing_.size(); ++w) {
            Water& water = model.waters[changing_[w]];
            water.level = {{0, stand.values[w]}};
            water.closed = false;
        }
        for (std::size_t k = 0; k < joints_.size(); ++k)
            for (const std::size_t joint : joints_[k].joints)
                model.joints[joint].strength_over_time = {{0, stand.values[changing_.size() + k]}};
        return model;
    }

    Control controlOfSearch(const Stand& stand) const {
        Control control = control_;
        control.keep_failing_state = false;
        control.groups = 1;
        control.interval = false;
        control.upper_bound = Beside::never;
        if (!control_.progress) return control;
        const auto known =
            std::count_if(stands_.begin(), stands_.end(), [](const Stand& each) { return each.known; });
        const double done = static_cast<double>(known) / static_cast<double>(stands_.size());
        const char* what = changing_.empty() ? "least strength times %.4g: " : "level %.4g m: ";
        const auto least = std::min_element(stand.values.begin(), stand.values.end());
        const std::string at = formatted(what, changing_.empty() ? *least : stand.values.front());
        control.progress = [this, done, at](const Progress& progress) {
            control_.progress({"storm", done, at + progress.detail});
        };
        return control;
    }

    /// One search. An answer that was interpolated gives way to it.
    void find(std::size_t k) {
        Stand& stand = stands_[k];
        if (!goesOn() || (stand.known && !stand.found.interpolated)) return;
        Result<SearchResult> found = safetyFactor(held(stand), controlOfSearch(stand));
        if (!found) {
            errors_ = found.errors();
            return;
        }
        if (found->status == SearchStatus::interrupted) return;
        ++result_.searches;
        stand.known = true;
        stand.found.status = found->status;
        stand.found.factor = found->answer;
        stand.found.low = found->low;
        stand.found.high = found->high;
        stand.found.mode = found->mode;
        stand.found.interpolated = false;
        stand.moving_blocks = std::move(found->moving_blocks);
        stand.warnings = std::move(found->warnings);
    }

    /// Searches at both ends and, where the factor between them is no straight line over the value that
    /// varies, between.
    void refine(std::size_t low, std::size_t high, std::size_t varying, int halvings) {
        find(low);
        find(high);
        if (high - low < 2 || !goesOn()) return;
        const std::size_t middle = nearestToMiddle(low, high, varying);
        find(middle);
        if (halvings <= 0 && isStraight(low, middle, high, varying)) {
            interpolate(low, middle, varying);
            interpolate(middle, high, varying);
            return;
        }
        refine(low, middle, varying, halvings - 1);
        refine(middle, high, varying, halvings - 1);
    }

    std::size_t nearestToMiddle(std::size_t low, std::size_t high, std::size_t varying) const {
        const auto value = [&](std::size_t k) { return stands_[k].values[varying]; };
        const double middle = 0.5 * (value(low) + value(high));
        std::size_t nearest = low + 1;
        for (std::size_t k = low + 2; k < high; ++k)
            if (std::abs(value(k) - middle) < std::abs(value(nearest) - middle)) nearest = k;
        return nearest;
    }

    double shareOf(std::size_t k, std::size_t low, std::size_t high, std::size_t varying) const {
        const double from = stands_[low].values[varying], to = stands_[high].values[varying];
        return (stands_[k].values[varying] - from) / (to - from);
    }

    bool isStraight(std::size_t low, std::size_t middle, std::size_t high, std::size_t varying) const {
        for (const std::size_t k : {low, middle, high})
            if (!stands_[k].known || stands_[k].found.status != SearchStatus::found) return false;
        const StormPoint &a = stands_[low].found, &m = stands_[middle].found, &b = stands_[high].found;
        const double line = std::lerp(a.factor, b.factor, shareOf(middle, low, high, varying));
        return std::abs(m.factor - line) <= kOffLine * model_.analysis.factor_tolerance;
    }

    void interpolate(std::size_t low, std::size_t high, std::size_t varying) {
        const StormPoint &a = stands_[low].found, &b = stands_[high].found;
        for (std::size_t k = low + 1; k < high; ++k) {
            const double share = shareOf(k, low, high, varying);
            stands_[k].known = true;
            StormPoint& found = stands_[k].found;
            found.status = SearchStatus::found;
            found.factor = std::lerp(a.factor, b.factor, share);
            // The line may lie off the factor by more than the brackets of its ends are wide.
            found.low = found.high = std::numeric_limits<double>::quiet_NaN();
            found.mode = (share < 0.5 ? a : b).mode;
            found.interpolated = true;
        }
    }

    double valueAt(std::size_t time) const { return valueOf(stands_[stand_at_[time]].found); }

    std::optional<std::size_t> least() const {
        std::optional<std::size_t> least;
        for (std::size_t k = 0; k < result_.points.size(); ++k)
            if (!std::isnan(valueAt(k)) && (!least || valueAt(k) < valueAt(*least))) least = k;
        return least;
    }

    std::optional<std::size_t> firstFailing() const {
        for (std::size_t k = 0; k < result_.points.size(); ++k)
            if (valueAt(k) < 1) return k;
        return std::nullopt;
    }

    /// What was interpolated, but decides: the least factor, and both sides of a fall below 1.
    std::optional<std::size_t> worthASearch() const {
        if (!goesOn()) return std::nullopt;
        std::vector<std::size_t> times;
        if (const auto k = least()) times.push_back(*k);
        if (const auto k = firstFailing()) {
            if (*k > 0) times.push_back(*k - 1);
            times.push_back(*k);
        }
        for (const std::size_t k : times)
            if (stands_[stand_at_[k]].found.interpolated) return stand_at_[k];
        return std::nullopt;
    }

    double crossingBefore(std::size_t k) const {
        const double time = result_.points[k].time;
        if (k == 0 || !std::isfinite(valueAt(k - 1)) || !(valueAt(k) > 0)) return time;
        const double before = valueAt(k - 1), share = (before - 1) / (before - valueAt(k));
        return std::lerp(result_.points[k - 1].time, time, share);
    }

    void take(std::size_t k) {
        const Stand& stand = stands_[stand_at_[k]];
        if (!stand.known) return;
        StormPoint& point = result_.points[k];
        StormPoint found = stand.found;
        found.time = point.time;
        found.levels = std::move(point.levels);
        found.strengths = std::move(point.strengths);
        point = std::move(found);
    }

    const Model& model_;
    const Control& control_;
    std::vector<std::size_t> changing_;  ///< waters of the model
    std::vector<ChangingJoints> joints_;
    std::vector<Stand> stands_;          ///< ascending by their values
    std::vector<std::size_t> stand_at_;  ///< per point
    StormResult result_;
    std::vector<Error> errors_;
};

void takeTimes(const std::vector<LevelPoint>& table, std::vector<double>& times) {
    for (const LevelPoint& point : table) times.push_back(point.time);
}

/// Of all tables that change within a storm, ascending [s]. A level or a strength is linear between them, so
/// that its least and its greatest value stand at one of them.
std::vector<double> tableTimes(const Model& model) {
    std::vector<double> times;
    for (const Water& water : model.waters) {
        if (water.level.size() > 1) takeTimes(water.level, times);
        if (!water.closed) continue;
        takeTimes(water.rain, times);
        takeTimes(water.inflow, times);
    }
    for (const Joint& joint : model.joints)
        if (changesStrength(joint)) takeTimes(joint.strength_over_time, times);
    std::sort(times.begin(), times.end());
    return times;
}

/// Multiples of the step, the times of the tables between them, and the end.
std::vector<double> timesOf(const Model& model, double duration, double step) {
    constexpr double kSameTime = 1e-9;  // of the step: k times 0.1 s rounds beside 0.3 s
    std::vector<double> all = tableTimes(model), times;
    for (double k = 0; k * step < duration; ++k) all.push_back(k * step);
    std::sort(all.begin(), all.end());
    for (const double time : all) {
        const bool is_new = times.empty() || time - times.back() > kSameTime * step;
        if (time >= 0 && duration - time > kSameTime * step && is_new) times.push_back(time);
    }
    times.push_back(duration);
    return times;
}

Error notPositive(const char* field, double found) {
    return {field, "found " + formatted("%g", found) + " s, allowed: more than 0 s, finite"};
}

bool isPositive(double value) { return value > 0 && std::isfinite(value); }

// The multiples of the step, up to kMostStormPoints of them and the end, and as many times of tables.
constexpr std::size_t kMostTimes = 2 * kMostStormPoints + 1;

Error tooMany(std::size_t times) {
    return {"duration", "found " + std::to_string(times) + " times, with those of the tables, allowed: " +
                            std::to_string(kMostTimes) + "; shorten the tables or the duration"};
}

/// How long the storm lasts [s].
Result<double> durationOf(const Model& model, const StormSettings& settings) {
    if (!isPositive(settings.step)) return notPositive("step", settings.step);
    if (settings.duration && !isPositive(*settings.duration))
        return notPositive("duration", *settings.duration);
    const auto duration = settings.duration ? settings.duration : stormDuration(model);
    if (!duration)
        return Error{"duration",
                     "found no table over time that says when the storm ends, allowed: a duration"};
    const double shortest = *duration / static_cast<double>(kMostStormPoints);
    if (settings.step < shortest)
        return Error{"step", "found " + formatted("%g", settings.step) + " s over " +
                                 formatted("%g", *duration) + " s, allowed: at least " +
                                 formatted("%g", shortest) + " s"};
    return *duration;
}

}  // namespace

std::optional<double> stormDuration(const Model& model) {
    double end = 0;
    const auto take = [&end](const std::vector<LevelPoint>& table) {
        if (table.size() > 1) end = std::max(end, table.back().time);
    };
    for (const Water& water : model.waters) {
        take(water.level);
        if (!water.closed) continue;
        take(water.rain);
        take(water.inflow);
    }
    for (const Joint& joint : model.joints)
        if (changesStrength(joint)) take(joint.strength_over_time);
    return end > 0 ? std::optional(end) : std::nullopt;
}

Result<StormResult> storm(const Model& model, const StormSettings& settings, const Control& control) {
    const auto begin = std::chrono::steady_clock::now();
    if (std::none_of(model.waters.begin(), model.waters.end(), search::changes) &&
        std::none_of(model.joints.begin(), model.joints.end(), changesStrength))
        return Error{
            "water",
            "found no water whose level changes, nor a joint whose strength changes, allowed: volume "
            "= \"closed\" with rain, inflow or a leak, levels over time, or strength_over_time"};
    const auto duration = durationOf(model, settings);
    if (!duration) return duration.errors();
    StormSearch search(model, control);
    const std::vector<double> times = timesOf(model, *duration, settings.step);
    if (times.size() > kMostTimes) return tooMany(times.size());
    if (auto errors = search.fill(times); !errors.empty()) return errors;
    if (auto errors = search.search(); !errors.empty()) return errors;
    StormResult result = search.result();
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

}  // namespace talus
