#pragma once
// Runs handed out to the processes of an MPI job, for clusters whose nodes have no file system with locks in
// common. Built with -DTALUS_MPI=ON; else every process is the only one.
//
// Process 0 has the folder: it assigns runs one at a time on request, writes the returned rows, and computes
// in a second thread. The others need the sweep's files, and nothing of the folder.

#include <atomic>

#include "batch/schedule.h"

namespace talus::tools::batch {

class MpiJob {
 public:
    MpiJob();   ///< joins the job that mpirun (or srun) has started this process in, if it has
    ~MpiJob();  ///< leaves it; helpers still waiting are told that no work remains
    MpiJob(const MpiJob&) = delete;
    MpiJob& operator=(const MpiJob&) = delete;

    int rank() const { return rank_; }
    int size() const { return size_; }

    /// Process 0: as `work`, with the help of all others.
    BatchProgress serve(const BatchWork& batch) const;

    /// The others: computes what process 0 hands out, until there is no more.
    void help(const formats::Sweep& sweep, const BatchInfo& info, const std::atomic<bool>& stop) const;

 private:
    int rank_ = 0, size_ = 1;
    [[maybe_unused]] bool joined_ = false;
    [[maybe_unused]] mutable bool dismissed_ = false;  ///< the helpers know that there is no more
};

}  // namespace talus::tools::batch
