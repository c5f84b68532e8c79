#pragma once
// A file that is written during a computation, by one process at a time: snapshots and histories.

#include <cstdint>
#include <string>
#include <vector>

#include "talus/formats/locks.h"
#include "talus/result.h"

namespace talus::formats {

/// An output file that is open for writing and locked. Its content stays until the first write; a new file
/// that got nothing is removed again. Devices and pipes are neither locked nor removed.
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

    /// Flushes the written bytes, and the folder's entry, to the disk. 0, or an errno; ENOENT when the file
    /// at its path is no longer the one written: removed, replaced, truncated, or its folder removed.
    int sync(std::uint64_t written) const;

 private:
    OutputFile(int file, std::string path) : file_(file), path_(std::move(path)) {}
    static Result<OutputFile> open(const std::string& path, bool may_create);
    bool isAtItsPath() const;

    int file_ = -1;
    bool created_ = false;  ///< created here, and not open elsewhere
    LockReach reach_ = LockReach::every_machine;
    std::string path_;
};

/// Whether a file has the length written so far, so that no other process has truncated it. True for devices
/// and pipes. Check before each append: otherwise the write leaves a hole, and the length is right again.
bool isAsLong(int file, std::uint64_t written);

/// From now on each write goes to the file's end, wherever that is. (Not from the start: systems refuse to
/// copy into such a file.)
void appendFromNowOn(int file);

/// Flushes the entries of this path's folder to the disk, as far as the file system allows.
void syncFolderOf(const std::string& path);

/// Text for an errno of OutputFile::sync or of writing: "cannot be written: No space left on device".
std::string writeRefusal(int error);

}  // namespace talus::formats
