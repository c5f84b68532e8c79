#include "batch/queue.h"

#include <algorithm>
#include <numeric>

namespace talus::tools::batch {

namespace {

constexpr std::uint64_t kMostRunsSorted = 4'000'000;  // eight bytes each

}  // namespace

Queue::Queue(const BatchWork& batch) : batch_(batch), runs_(batch.store.info().runs) {
    if (batch.case_costs.empty() || runs_ > kMostRunsSorted) return;
    order_.resize(runs_);
    std::iota(order_.begin(), order_.end(), std::uint64_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint64_t a, std::uint64_t b) {
        return batch.case_costs[a % batch.sweep.cases] > batch.case_costs[b % batch.sweep.cases];
    });
}

std::optional<std::uint64_t> Queue::next() {
    for (std::uint64_t place = next_++; place < runs_; place = next_++) {
        const std::uint64_t run = order_.empty() ? place : order_[place];
        if (isWanted(run) && batch_.store.claim(run, batch_.retry && !begun_again_)) return run;
    }
    return std::nullopt;
}

bool Queue::isWanted(std::uint64_t run) const {
    if (!batch_.shard.has(batch_.store.info(), run)) return false;
    const bool retry = batch_.retry && !begun_again_;
    return !batch_.store.isDone(run) || (retry && batch_.store.hasFailed(run));
}

std::uint64_t Queue::left() const {
    std::uint64_t count = 0;
    for (std::uint64_t run = 0; run < runs_; ++run) count += isWanted(run);
    return count;
}

void Queue::beginAgain() {
    begun_again_ = true;
    next_ = 0;
}

}  // namespace talus::tools::batch
