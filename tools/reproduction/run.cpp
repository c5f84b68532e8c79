#include "reproduction/run.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <ctime>
#include <mutex>
#include <numeric>

#include "reproduction/cases.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/parallel.h"

namespace talus::tools {
namespace {

/// CPU time of the calling thread; a case never leaves the thread it began in [s].
double threadCpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Counts and reports to the caller; the only data that the cases share.
class Ledger {
 public:
    Ledger(const std::vector<PaperRun>& runs, const std::function<void(const PaperProgress&)>& tell)
        : tell_(tell) {
        progress_.total = runs.size();
        for (const PaperRun& run : runs) cost_.push_back(expectedCost(run.what));
        total_cost_ = std::accumulate(cost_.begin(), cost_.end(), 0.0);
        fraction_.assign(runs.size(), 0.0);
    }

    void advanced(std::size_t index, double fraction) {
        const std::lock_guard lock(mutex_);
        report(index, fraction);
    }

    void completed(std::size_t index, const PaperRun& run) {
        const std::lock_guard lock(mutex_);
        ++progress_.done;
        progress_.last = &run;
        report(index, 1.0);
    }

 private:
    void report(std::size_t index, double fraction) {
        fraction_[index] = std::clamp(fraction, fraction_[index], 1.0);
        progress_.fraction = std::inner_product(cost_.begin(), cost_.end(), fraction_.begin(), 0.0) /
                             std::max(total_cost_, 1e-300);
        if (tell_) tell_(progress_);
    }

    std::mutex mutex_;
    PaperProgress progress_;
    std::vector<double> cost_, fraction_;
    double total_cost_ = 0;
    const std::function<void(const PaperProgress&)>& tell_;
};

void compute(PaperRun& run, const Search& search, const Control& control) {
    run.begun = true;
    const double begin = threadCpuSeconds();
    Control alone = control;  // theory stands beside these answers
    alone.interval = false;
    alone.upper_bound = Beside::never;
    Result<SearchResult> found = search(run.what.scenario.model, alone);
    run.cpu_seconds = threadCpuSeconds() - begin;
    if (found.ok()) {
        run.search = std::move(*found);
    } else {
        run.errors = formats::placed(run.what.scenario, found.errors());
    }
}

std::vector<std::size_t> costlyFirst(const std::vector<PaperRun>& runs) {
    std::vector<std::size_t> order(runs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&runs](std::size_t a, std::size_t b) {
        return expectedCost(runs[a].what) > expectedCost(runs[b].what);
    });
    return order;
}

}  // namespace

std::vector<PaperRun> runCases(std::vector<PaperCase> cases, const Search& search, int threads,
                               const std::atomic<bool>& stop,
                               const std::function<void(const PaperProgress&)>& progress) {
    std::vector<PaperRun> runs;
    for (PaperCase& what : cases) runs.push_back({std::move(what), false, {}, {}, 0});
    Ledger ledger(runs, progress);
    const std::vector<std::size_t> order = costlyFirst(runs);
    std::atomic<std::size_t> next{0};
    const auto work = [&](int) {
        for (std::size_t i = next++; i < order.size() && !stop; i = next++) {
            const std::size_t index = order[i];
            Control control;
            control.stop = &stop;
            control.keep_failing_state = runs[index].what.keep_failing;
            control.progress = [&ledger, index](const Progress& p) { ledger.advanced(index, p.fraction); };
            compute(runs[index], search, control);
            ledger.completed(index, runs[index]);
        }
    };
    // One worker per thread, each taking the next case when it is free: a partitioned range would not keep
    // the order.
    inArena(threads, [&] { tbb::parallel_for(0, threads, 1, work, tbb::simple_partitioner{}); });
    return runs;
}

std::string doneText(const PaperProgress& progress) {
    return std::to_string(progress.done) + " of " + std::to_string(progress.total) + " done";
}

}  // namespace talus::tools
