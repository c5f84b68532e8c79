#pragma once
// History of a run as CSV: one row per record, written at once, so that a stopped or killed run keeps its
// records. Comment lines start with '#'; the last one says how the run ended, and a file without it is
// unfinished.

#include <string>
#include <string_view>
#include <vector>

#include "talus/formats/output_file.h"
#include "talus/result.h"
#include "talus/simulation.h"

namespace talus::formats {

enum class HistoryFile { absent, empty, unfinished, finished, foreign };

/// The file at this path. Devices and pipes count as absent, as they hold nothing to lose.
HistoryFile inspectHistory(const std::string& path);

class HistoryWriter {
 public:
    /// Leaves the file's content in place until the first record. `comments` are whole lines starting with
    /// '#'; `watch` are the blocks every record will report, in this order.
    HistoryWriter(OutputFile file, std::string comments, std::vector<std::string> watch);
    /// The same. Errors: those of OutputFile.
    static Result<HistoryWriter> open(const std::string& path, std::string comments,
                                      std::vector<std::string> watch);

    /// Errors: the file system's refusal, with path and reason. After the first one nothing more is written.
    std::vector<Error> write(const HistoryRecord& record);

    /// Adds the last line ("# end: finished") and brings all to the disk.
    std::vector<Error> finish(std::string_view how);

 private:
    std::string head(const HistoryRecord& first) const;
    std::string row(const HistoryRecord& record) const;
    std::vector<Error> append(std::string_view text);
    std::vector<Error> refusal(std::string why);

    OutputFile file_;
    bool started_ = false, failed_ = false;
    std::uint64_t written_ = 0;  ///< [bytes]
    std::string comments_;
    std::vector<std::string> watch_;
};

}  // namespace talus::formats
