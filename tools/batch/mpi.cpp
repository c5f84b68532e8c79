#include "batch/mpi.h"

#ifdef TALUS_MPI

#define OMPI_SKIP_MPICXX 1  // the C++ bindings of old
#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

#include "batch/queue.h"
#include "cli/text.h"

namespace talus::tools::batch {

namespace {

// Every message of a helper asks for the next run; kRow brings the row of the last one along.
enum Tag : int { kAsk = 1, kRow = 2, kRun = 3 };
constexpr std::int64_t kNoMore = -1;

bool startedByMpi() {
    for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
        if (std::getenv(variable)) return true;
    return false;
}

/// "RUN FAILED line" of a computed row.
std::string packed(std::uint64_t run, const ComputedRow& row) {
    return std::to_string(run) + (row.failed ? " 1 " : " 0 ") + csvLine(row.cells);
}

struct Unpacked {
    std::uint64_t run = 0;
    bool failed = false;
    Row cells;
};

Unpacked unpacked(const std::string& text) {
    const auto first = text.find(' ');
    std::string line = text.substr(first + 3);
    line.pop_back();
    return {std::stoull(text.substr(0, first)), text[first + 1] == '1', csvFields(line)};
}

/// Process 0: the main thread talks, a second one computes.
class Server {
 public:
    Server(const BatchWork& batch, int helpers)
        : batch_(batch), queue_(batch), helpers_(helpers), begin_(std::chrono::steady_clock::now()) {
        progress_.todo = queue_.left();
    }

    BatchProgress serve() {
        std::thread computing([this] { compute(); });
        talk();
        computing.join();
        if (fault_) std::rethrow_exception(fault_);
        batch_.store.refresh();
        return progress_;
    }

 private:
    std::optional<std::uint64_t> next() { return batch_.stop ? std::nullopt : queue_.next(); }

    void compute() {
        guarded([this] {
            while (const auto run = next()) {
                const auto row = computeRun(batch_.sweep, batch_.store.info(), *run, batch_.stop);
                row ? keep(*run, row->cells, row->failed) : batch_.store.release(*run);
            }
        });
    }

    /// Until every helper has been told that there is no more.
    void talk() {
        for (int left = helpers_; left > 0;) {
            MPI_Status status;
            int has_come = 0;
            MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_come, &status);
            if (!has_come) {  // MPI would wait at full speed, on the core the second thread computes on
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                continue;
            }
            const std::string text = receive(status);
            if (status.MPI_TAG == kRow)
                guarded([&] {
                    const Unpacked row = unpacked(text);
                    keep(row.run, row.cells, row.failed);
                });
            std::optional<std::uint64_t> run;
            guarded([&] { run = next(); });
            const std::int64_t answer = run ? static_cast<std::int64_t>(*run) : kNoMore;
            MPI_Send(&answer, 1, MPI_INT64_T, status.MPI_SOURCE, kRun, MPI_COMM_WORLD);
            left -= !run;
        }
    }

    static std::string receive(const MPI_Status& status) {
        int length = 0;
        MPI_Get_count(&status, MPI_CHAR, &length);
        std::string text(static_cast<std::size_t>(length), '\0');
        MPI_Recv(text.data(), length, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
        return text;
    }

    void keep(std::uint64_t run, const Row& cells, bool failed) {
        batch_.store.append(run, cells);
        const std::lock_guard held(mutex_);
        ++progress_.done;
        progress_.failed += failed;
        progress_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (batch_.progress) batch_.progress(progress_);
    }

    /// The helpers have to be told of the end, so a fault is kept until then.
    template <class Body>
    void guarded(const Body& body) {
        try {
            body();
        } catch (...) {
            const std::lock_guard held(mutex_);
            if (!fault_) fault_ = std::current_exception();
            batch_.abandon();
        }
    }

    const BatchWork& batch_;
    Queue queue_;
    int helpers_;
    std::chrono::steady_clock::time_point begin_;
    std::mutex mutex_;
    BatchProgress progress_;
    std::exception_ptr fault_;
};

}  // namespace

MpiJob::MpiJob() {
    if (!startedByMpi()) return;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    joined_ = true;
}

MpiJob::~MpiJob() {
    if (!joined_) return;
    for (int left = rank_ == 0 && !dismissed_ ? size_ - 1 : 0; left > 0; --left) {
        MPI_Status status;
        MPI_Recv(nullptr, 0, MPI_CHAR, MPI_ANY_SOURCE, kAsk, MPI_COMM_WORLD, &status);
        MPI_Send(&kNoMore, 1, MPI_INT64_T, status.MPI_SOURCE, kRun, MPI_COMM_WORLD);
    }
    MPI_Finalize();
}

BatchProgress MpiJob::serve(const BatchWork& batch) const {
    Server server(batch, size_ - 1);
    dismissed_ = true;  // the server tells them, whatever goes wrong
    return server.serve();
}

void MpiJob::help(const formats::Sweep& sweep, const BatchInfo& info, const std::atomic<bool>& stop) const {
    std::string text;
    Tag tag = kAsk;
    for (;;) {
        std::int64_t run = kNoMore;
        MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, tag, MPI_COMM_WORLD);
        MPI_Recv(&run, 1, MPI_INT64_T, 0, kRun, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (run == kNoMore) return;
        const auto row = computeRun(sweep, info, static_cast<std::uint64_t>(run), stop);
        text = row ? packed(static_cast<std::uint64_t>(run), *row) : "";
        tag = row ? kRow : kAsk;
    }
}

}  // namespace talus::tools::batch

#else

namespace talus::tools::batch {

MpiJob::MpiJob() = default;
MpiJob::~MpiJob() = default;
BatchProgress MpiJob::serve(const BatchWork& batch) const { return work(batch); }
void MpiJob::help(const formats::Sweep&, const BatchInfo&, const std::atomic<bool>&) const {}

}  // namespace talus::tools::batch

#endif
