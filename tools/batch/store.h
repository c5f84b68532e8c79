#pragma once
// The folder of a batch: results that survive kill -9, a full disk and other processes at work in the same
// folder.
//
//   batch.json                  what the batch is (BatchInfo); written once
//   results.csv                 a header, then one line per run, appended whole
//   results.csv-metadata.json   types and units of its columns
//   summary.json, report.json, report.html   their summary and report (batch/report.h)
//   .lock                       ranges of it are locked (talus/formats/locks.h): byte 0 while the folder or
//                               its results are being changed, byte 1 + n while run n is being computed
//
// A row is appended by one write and only counts with its line feed; a partial row left by a killed process
// or a full disk is cut off before the next is appended.

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "batch/rows.h"

namespace talus::tools::batch {

inline constexpr const char *kSummaryName = "summary.json", *kReportName = "report.json",
                            *kPageName = "report.html";

/// Part I of N of a batch; 1 of 1 is all of it.
struct Shard {
    std::uint64_t index = 1, count = 1;
    bool whole() const { return count == 1; }
    /// By case and sample, so that every part gets its share of cheap and costly cases. The same for ever.
    bool has(const BatchInfo& info, std::uint64_t run) const {
        return (run % info.cases + run / info.cases) % count == index - 1;
    }
};

/// "results.csv", or "results.2-of-8.csv" of a shard.
std::string resultsName(const Shard& shard);

class Store {
 public:
    /// Opens a folder, making what is missing. Throws BadInput when another sweep's results or links are in
    /// it, FileRefused.
    Store(std::string folder, BatchInfo info, Shard shard);
    ~Store();
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;

    const BatchInfo& info() const { return info_; }
    const std::string& folder() const { return folder_; }
    std::string resultsPath() const;

    bool isDone(std::uint64_t run) const;     ///< its row was there when results were last looked at
    bool hasFailed(std::uint64_t run) const;  ///< likewise, and the (last) row is that of a failure

    std::uint64_t doneCount() const;    ///< runs with a row
    std::uint64_t failedCount() const;  ///< of them, those that failed

    /// Takes a run for this process: false when it is done already or another process is at it. `again` takes
    /// a run that failed, too.
    bool claim(std::uint64_t run, bool again);
    void release(std::uint64_t run);

    /// Appends the row of a claimed run and releases it. Throws FileRefused; the file then is as it was.
    void append(std::uint64_t run, const Row& row);

    void refresh();  ///< looks at rows other processes have appended

    /// Brings the rows to the disk. 0, or an errno. Throws FileRefused when the folder or its results are
    /// gone.
    int sync();

 private:
    void prepare();
    void openResults();
    void cutTornRow();
    void readNewRows();
    void noteRow(std::string_view line);
    bool lock(std::uint64_t byte, bool wait);
    void unlock(std::uint64_t byte);
    void requireFolder() const;

    class FolderLock;

    std::string folder_;
    BatchInfo info_;
    Shard shard_;
    int lock_file_ = -1, results_ = -1;
    std::uint64_t read_up_to_ = 0;     ///< bytes of results.csv that are known
    std::vector<std::uint8_t> state_;  ///< per run: 0 open, 1 done, 2 failed
    std::uint64_t done_ = 0, failed_ = 0;
    mutable std::mutex mutex_;
};

/// While it lives, no batch opens this folder. Throws FileRefused when one is at work in it.
class AloneIn {
 public:
    explicit AloneIn(const std::string& folder);
    ~AloneIn();
    AloneIn(const AloneIn&) = delete;
    AloneIn& operator=(const AloneIn&) = delete;

 private:
    int file_;
};

/// Throws BadInput when the folder holds what is not this batch's, or a link in place of one of its files.
void refuseToReplaceOther(const std::string& folder, const BatchInfo& info);

/// Content of a folder, without opening it for writing: the batch, and all rows of all results, the last row
/// of each run. Throws BadInput, FileRefused.
struct StoredBatch {
    BatchInfo info;
    /// by run: its row, as text, since a million may come
    std::unordered_map<std::uint64_t, std::string> lines;
    std::uint64_t beyond = 0;  ///< rows of a larger batch in the same folder, which are not among them

    Row row(std::uint64_t run) const { return csvFields(lines.at(run)); }
};
StoredBatch readStored(const std::string& folder);
/// The rows of one shard alone: those of others may be half written.
StoredBatch readStored(const std::string& folder, const Shard& shard);

/// The runs of a sweep alone: the folder may hold those of an earlier one with more samples. \pre it has the
/// identity of `info`
StoredBatch onlyRunsOf(const BatchInfo& info, StoredBatch stored);

/// Adds a run's row (without its line feed); a result replaces a failure, else the later one counts.
void keepBetter(StoredBatch& stored, std::uint64_t run, std::string line);

}  // namespace talus::tools::batch
