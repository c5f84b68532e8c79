#include "verification/compute.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "cli/failures.h"
#include "talus/flow.h"
#include "talus/limit_analysis.h"
#include "talus/parallel.h"
#include "talus/searches.h"
#include "talus/simulation.h"
#include "talus/storm.h"

namespace talus::tools {

namespace {

constexpr const char* kFalls = "falls_at_start";
constexpr const char* kDecided = "decided";
constexpr const char* kDischarge = "discharge_m3_s";
constexpr const char* kLevel = "level_m";

void timeHistory(const Control& control, Computed& computed);
void flow(const Control& control, Computed& computed);
void filling(const Control& control, Computed& computed);

/// The analysis that gives a quantity.
struct Analysis {
    const LoadSearch* search = nullptr;
    const VariedQuantity* limit = nullptr;
    void (*other)(const Control&, Computed&) = nullptr;  ///< neither of these
    const char* other_key = "";

    std::string key() const { return search ? search->name : limit ? limit->key : other_key; }
};

std::string limitQuantity(const VariedQuantity& load) { return std::string("limit_") + load.key; }

Analysis analysisFor(const std::string& quantity) {
    if (quantity == kFalls) return {.search = loadSearch("critical-angle")};
    if (quantity == kDecided) return {.search = loadSearch("safety-factor")};
    for (const LoadSearch& search : loadSearches())
        if (quantity == search.answer_key) return {.search = &search};
    for (const VariedQuantity& load : variedQuantities())
        if (quantity == limitQuantity(load)) return {.limit = &load};
    if (quantity == kDischarge) return {.other = flow, .other_key = "flow"};
    if (quantity == kLevel) return {.other = filling, .other_key = "storm"};
    for (const char* known : {"speed_m_s", "way_m", "lowest_at_s", "velocity_kept", "pull_stiffness_n_m",
                              "most_force_n", "energy_change", "energy_gain"})
        if (quantity == known) return {.other = timeHistory, .other_key = "run"};
    throw BadInput(Error{"quantity", "there is no quantity \"" + quantity + "\""});
}

/// One computation, for all rows that need it.
struct Task {
    const VerificationRow* row = nullptr;
    Analysis analysis;
    double seconds = 0;
    std::shared_ptr<Computed> result{};
};

std::string keyOf(const VerificationRow& row, const Analysis& analysis) {
    return row.scenario + "|" + row.set + "|" + analysis.key();
}

Analysis ceilingOf(const VerificationRow& row) { return {.limit = analysisFor(row.quantity).search->load}; }

std::map<std::string, Task> tasksOf(const std::vector<VerificationRow>& rows) {
    std::map<std::string, Task> tasks;
    const auto want = [&](const VerificationRow& row, const Analysis& analysis) {
        Task& task = tasks[keyOf(row, analysis)];
        task.row = &row;
        task.analysis = analysis;
        task.seconds = std::max(task.seconds, row.seconds);
    };
    for (const VerificationRow& row : rows) {
        want(row, analysisFor(row.quantity));
        if (row.ceiling_is_high) want(row, ceilingOf(row));
    }
    return tasks;
}

// --- what is computed
// -----------------------------------------------------------------------------------------------------

template <class T>
bool given(const Result<T>& result, Computed& computed) {
    if (result.ok()) return true;
    computed.status = formats::format(formats::placed(computed.scenario, result.errors()).front());
    return false;
}

void search(const LoadSearch& search, const Control& control, Computed& computed) {
    Control alone = control;
    alone.interval = false;
    alone.upper_bound = Beside::never;
    const Result<SearchResult> result = search.find(computed.scenario.model, alone, {});
    if (!given(result, computed)) return;
    computed.status = toString(result->status);
    computed.motions = result->motions;
    const bool found = result->status == SearchStatus::found;
    computed.values[kDecided] = result->status == SearchStatus::undecided ? 0 : 1;
    if (found) computed.load = result->answer;
    if (found) computed.values[search.answer_key] = result->answer / search.load->scale;
    if (result->status == SearchStatus::unstable_at_start) computed.values[kFalls] = 1;
    if (found || result->status == SearchStatus::stable_to_stop) computed.values[kFalls] = 0;
}

void limit(const VariedQuantity& load, const Control& control, Computed& computed) {
    const Result<LimitResult> result = limitAnalysis(computed.scenario.model, load.varied, control);
    if (!given(result, computed)) return;
    computed.status = toString(result->status);
    if (result->status == SearchStatus::found)
        computed.values[limitQuantity(load)] = 0.5 * (result->lower + result->upper) / load.scale;
}

/// Energies of a history as it goes by [J].
class EnergyWatch {
 public:
    void see(const HistoryRecord& record) {
        const double total = record.kinetic_energy + record.elastic_energy + record.gravity_energy;
        if (!first_) first_ = last_ = total;
        change_ = std::max(change_, std::abs(total - *first_));
        gain_ = std::max(gain_, total - last_);
        kinetic_ = std::max(kinetic_, record.kinetic_energy);
        last_ = total;
    }
    double change() const { return change_ / kinetic_; }
    double gain() const { return gain_ / kinetic_; }

 private:
    std::optional<double> first_;
    double last_ = 0, change_ = 0, gain_ = 0, kinetic_ = 0;
};

/// The swing of the first watched block, released with zero velocity: its impact is where its centroid is
/// lowest.
class SwingWatch {
 public:
    void see(const HistoryRecord& record) {
        if (record.watch.empty()) return;
        left_ = record.kinetic_energy + record.gravity_energy;
        if (seen_ && record.watch[0].position.z() >= lowest_) return;
        seen_ = true;
        lowest_ = record.watch[0].position.z();
        time_ = record.time;
        fall_ = -record.gravity_energy;
    }
    double time() const { return time_; }
    /// Coefficient of the velocity at impact, the root of the ratio of the energy at the end to that of the
    /// fall.
    double kept() const { return std::sqrt((left_ + fall_) / fall_); }

 private:
    bool seen_ = false;
    double lowest_ = 0, time_ = 0, fall_ = 0, left_ = 0;
};

/// Force of the first support over the displacement of the first watched block, during a pull.
class PullWatch {
 public:
    void see(const HistoryRecord& record) {
        if (record.watch.empty() || record.supports.empty() || record.supports[0].reports.empty()) return;
        way_.push_back(record.watch[0].displacement.norm());
        force_.push_back(record.supports[0].reports[0].force);
        most_ = std::max(most_, force_.back());
    }
    double most() const { return most_; }
    /// Between a fifth and two fifths of the greatest force.
    double stiffness() const {
        const auto reaches = [&](double share) {
            return static_cast<std::size_t>(
                std::find_if(force_.begin(), force_.end(),
                             [&](double force) { return force >= share * most_; }) -
                force_.begin());
        };
        const std::size_t low = reaches(0.2), high = reaches(0.4);
        return (force_[high] - force_[low]) / (way_[high] - way_[low]);
    }

 private:
    std::vector<double> way_{}, force_{};
    double most_ = 0;
};

void timeHistory(const Control& control, Computed& computed) {
    EnergyWatch energies;
    SwingWatch swing;
    PullWatch pull;
    const Result<RunResult> result = run(computed.scenario.model, control, [&](const HistoryRecord& record) {
        energies.see(record);
        swing.see(record);
        pull.see(record);
    });
    if (!given(result, computed)) return;
    computed.status = result->interrupted ? "interrupted" : "finished";
    if (result->interrupted) return;
    if (pull.most() > 0) {
        computed.values["pull_stiffness_n_m"] = pull.stiffness();
        computed.values["most_force_n"] = pull.most();
    }
    computed.values["energy_change"] = energies.change();
    computed.values["energy_gain"] = energies.gain();
    if (result->watch.empty()) return;
    computed.values["speed_m_s"] = result->watch.front().velocity.norm();
    computed.values["way_m"] = result->watch.front().displacement.norm();
    computed.values["lowest_at_s"] = swing.time();
    computed.values["velocity_kept"] = swing.kept();
}

void flow(const Control&, Computed& computed) {
    const Result<SteadyFlow> result = steadyFlow(computed.scenario.model);
    if (!given(result, computed)) return;
    computed.status = "finished";
    computed.values[kDischarge] = result->inflow_sum;
}

/// The first water whose level changes, at the end of its tables.
void filling(const Control& control, Computed& computed) {
    const Result<StormResult> result = storm(computed.scenario.model, {}, control);
    if (!given(result, computed)) return;
    computed.status = result->interrupted ? "interrupted" : "finished";
    if (!result->interrupted) computed.values[kLevel] = result->points.back().levels.front();
}

std::shared_ptr<Computed> compute(const Task& task, const Control& control) {
    auto computed = std::make_shared<Computed>();
    const auto begin = std::chrono::steady_clock::now();
    auto scenario = formats::parseScenario(scenarioText(*task.row), "bench/" + task.row->scenario + ".toml");
    if (!scenario) {
        computed->status = formats::format(scenario.errors().front());
        return computed;
    }
    computed->scenario = std::move(*scenario);
    if (task.analysis.search)
        search(*task.analysis.search, control, *computed);
    else if (task.analysis.limit)
        limit(*task.analysis.limit, control, *computed);
    else
        task.analysis.other(control, *computed);
    computed->wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return computed;
}

void computeAll(std::vector<Task*>& order, int threads, const std::atomic<bool>& stop,
                const std::function<void(const Progress&)>& progress) {
    std::atomic<std::size_t> next{0};
    std::mutex telling;
    std::size_t done = 0;
    double seconds = 0, all_seconds = 0;
    for (const Task* task : order) all_seconds += task->seconds;
    const auto work = [&](int) {
        for (std::size_t k = next++; k < order.size() && !stop; k = next++) {
            auto computed = compute(*order[k], {.stop = &stop});
            if (stop) return;
            order[k]->result = std::move(computed);
            const std::lock_guard alone(telling);
            seconds += order[k]->seconds;
            if (progress)
                progress({std::to_string(++done) + " of " + std::to_string(order.size()) + " done",
                          seconds / all_seconds, order[k]->row->name});
        }
    };
    inArena(threads, [&] { tbb::parallel_for(0, threads, 1, work, tbb::simple_partitioner{}); });
}

std::optional<double> valueOf(const Computed& computed, const std::string& quantity) {
    const auto found = computed.values.find(quantity);
    if (found == computed.values.end()) return std::nullopt;
    return found->second;
}

}  // namespace

std::vector<VerifiedRow> verify(const std::vector<VerificationRow>& rows, int threads,
                                const std::atomic<bool>& stop,
                                const std::function<void(const Progress&)>& progress) {
    std::map<std::string, Task> tasks = tasksOf(rows);
    std::vector<Task*> order;
    for (auto& [key, task] : tasks) order.push_back(&task);
    std::stable_sort(order.begin(), order.end(),
                     [](const Task* a, const Task* b) { return a->seconds > b->seconds; });
    computeAll(order, threads, stop, progress);
    std::vector<VerifiedRow> verified;
    for (const VerificationRow& row : rows) {
        const auto result = tasks.at(keyOf(row, analysisFor(row.quantity))).result;
        if (!result) continue;  // stopped
        VerifiedRow one{row, valueOf(*result, row.quantity), row.high, result};
        if (row.ceiling_is_high) {
            const auto ceiling = tasks.at(keyOf(row, ceilingOf(row))).result;
            if (!ceiling) continue;
            one.high = valueOf(*ceiling, limitQuantity(*ceilingOf(row).limit));
        }
        verified.push_back(std::move(one));
    }
    return verified;
}

}  // namespace talus::tools
