#pragma once
// Locks on ranges of a file, for processes that must not write at the same time. A lock belongs to an open
// file (F_OFD_SETLK), and the kernel drops it when the process ends in any way, so nothing stays locked.

#include <cstdint>
#include <string>
#include <string_view>

namespace talus::formats {

enum class LockMode : std::uint8_t { none, shared, exclusive };

/// Bytes of a file; they need not exist.
struct LockRange {
    std::uint64_t first = 0;
    std::uint64_t count = 1;  ///< 0: to the end, however large
};

/// Takes or releases a lock, with or without waiting. 0, or the errno of a refusal: lockIsHeld() or
/// noLocksHere() say what it means. \pre the file is open for writing (exclusive) or reading (shared)
int setLock(int file, LockMode mode, LockRange range, bool wait);

bool lockIsHeld(int error);   ///< by another process
bool noLocksHere(int error);  ///< the file system has none

/// Which other processes a lock excludes.
enum class LockReach : std::uint8_t {
    every_machine,
    this_machine,  ///< a network file system that was mounted with locks of its own for each machine
    none
};

/// By kind and options of a mount as proc(5) writes them in mountinfo: "nfs4", "rw,nolock,addr=...".
LockReach lockReach(std::string_view kind, std::string_view options);

/// The locks of a file's file system. Where the kernel has no information, they are assumed to work.
LockReach lockReach(int file);

/// A warning for the user, or "": "its file system has no locks, ...".
std::string lockWarning(LockReach reach);

}  // namespace talus::formats
