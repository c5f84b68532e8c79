#pragma once
// A file that is written while a computation goes on, by one process at a time: snapshots and histories.

#include <cstdint>
#include <string>
#include <vector>

#include "talus/formats/locks.h"
#include "talus/result.h"

namespace talus::formats {

/// An output file that is open for writing and locked. What was in it stays until somebody writes; a file
/// that was made here and got nothing is taken away again. Devices and pipes are neither locked nor taken
/// away.
class OutputFile {
 public:
    /// Errors (with the path as their field): the file system's refusal; another process is writing the file.
    static Result<OutputFile> open(const std::string& path);
    static Result<OutputFile> openExisting(const std::string& path);  ///< the same, but makes none

    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    ~OutputFile();

    int file() const { return file_; }
    const std::string& path() const { return path_; }
    LockReach lockReach() const { return reach_; }

    /// Brings to the disk what was written, so many bytes, and the folder's entry. 0, or an errno; ENOENT
    /// when the file at its path is not the one that was written any more: somebody has removed, replaced or
    /// truncated it, or removed its folder.
    int sync(std::uint64_t written) const;

 private:
    OutputFile(int file, std::string path) : file_(file), path_(std::move(path)) {}
    static Result<OutputFile> open(const std::string& path, bool may_create);
    bool isAtItsPath() const;

    int file_ = -1;
    bool created_ = false;  ///< here, and nobody else has it
    LockReach reach_ = LockReach::every_machine;
    std::string path_;
};

/// Whether a file is as long as what was written to it, so that nobody else has truncated it. True of devices
/// and pipes. Ask before each write, of a file that is appended to: else a write leaves a hole, and the
/// length is right again.
bool isAsLong(int file, std::uint64_t written);

/// From now on each write goes to the file's end, wherever that is. (Not from the start: systems refuse to
/// copy into such a file.)
void appendFromNowOn(int file);

/// Brings the entries of the folder this path is in to the disk, as far as the file system lets it.
void syncFolderOf(const std::string& path);

/// What an errno of OutputFile::sync or of writing means: "cannot be written: No space left on device".
std::string writeRefusal(int error);

}  // namespace talus::formats
