#include "batch/schedule.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>

#include "batch/queue.h"
#include "talus/parallel.h"

namespace talus::tools::batch {

namespace {

constexpr std::uint64_t kMostCasesLookedAt = 1000;

class Crew {
 public:
    explicit Crew(const BatchWork& batch)
        : batch_(batch), queue_(batch), begin_(std::chrono::steady_clock::now()) {
        progress_.todo = queue_.left();
    }

    BatchProgress work() {
        // The arena has one slot for each run that may be under way; each run computes in its own thread
        // only. A plain queue, because a partitioned range would not keep the order, and a run is long beside
        // taking it.
        std::uint64_t before = 0;
        do {
            before = progress_.done;
            inArena(batch_.threads, [&] {
                tbb::parallel_for(
                    0, batch_.threads, 1, [&](int) { workOff(); }, tbb::simple_partitioner{});
            });
            if (fault_) std::rethrow_exception(fault_);
            batch_.store.refresh();
            queue_.beginAgain();
        } while (!batch_.stop && progress_.done > before && queue_.left() > 0);
        return progress_;
    }

 private:
    void workOff() {
        while (!batch_.stop) {
            const auto run = queue_.next();
            if (!run) return;
            try {
                const auto row = computeRun(batch_.sweep, batch_.store.info(), *run, batch_.stop);
                row ? batch_.store.append(*run, row->cells) : batch_.store.release(*run);
                if (row) count(row->failed);
            } catch (...) {
                giveUp(std::current_exception());
                return;
            }
        }
    }

    void count(bool failed) {
        const std::lock_guard held(mutex_);
        ++progress_.done;
        progress_.failed += failed;
        progress_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (batch_.progress) batch_.progress(progress_);
    }

    void giveUp(std::exception_ptr fault) {
        const std::lock_guard held(mutex_);
        if (!fault_) fault_ = std::move(fault);
        batch_.abandon();
    }

    const BatchWork& batch_;
    Queue queue_;
    std::chrono::steady_clock::time_point begin_;
    std::mutex mutex_;
    BatchProgress progress_;
    std::exception_ptr fault_;
};

bool changesSizes(const formats::SweepColumn& column) {
    return std::any_of(column.targets.begin(), column.targets.end(), [](const std::string& target) {
        return target.starts_with("stack[") || target.starts_with("block[") || target == "contact.points";
    });
}

}  // namespace

BatchProgress work(const BatchWork& batch) { return Crew(batch).work(); }

std::vector<double> caseCosts(const formats::Sweep& sweep) {
    if (sweep.cases < 2 || sweep.cases > kMostCasesLookedAt ||
        std::none_of(sweep.columns.begin(), sweep.columns.end(), changesSizes))
        return {};
    std::vector<double> costs;
    for (std::uint64_t run = 0; run < sweep.cases; ++run) {
        const auto sampled = formats::scenarioOf(sweep, formats::runOf(sweep, run));
        const double blocks = sampled ? static_cast<double>(sampled->scenario.model.blocks.size()) : 0;
        costs.push_back(std::pow(blocks, 4.0 / 3));
    }
    return costs;
}

}  // namespace talus::tools::batch
