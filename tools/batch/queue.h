#pragma once
// The order of runs.

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "batch/work.h"

namespace talus::tools::batch {

/// Deals out runs that are left to do: in the order of their numbers, or the costly ones first. Safe to call
/// from several threads, but for beginAgain.
class Queue {
 public:
    explicit Queue(const BatchWork& batch);

    /// The next run that is this process's to compute, claimed; nothing at the end of a pass.
    std::optional<std::uint64_t> next();

    std::uint64_t left() const;  ///< runs still open, also those claimed by other processes

    /// Another pass; what has failed by now stays failed.
    void beginAgain();

 private:
    bool isWanted(std::uint64_t run) const;

    const BatchWork& batch_;
    std::uint64_t runs_;
    std::vector<std::uint64_t> order_;
    std::atomic<std::uint64_t> next_{0};
    bool begun_again_ = false;
};

}  // namespace talus::tools::batch
