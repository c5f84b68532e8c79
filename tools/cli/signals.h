#pragma once
// SIGINT and SIGTERM.

#include <atomic>

namespace talus::tools {

/// Lets SIGINT and SIGTERM set the flag below instead of ending the process; a second one ends it at once.
void catchStopSignals();

/// True once the user asked to stop. Pass its address as Control::stop.
const std::atomic<bool>& stopRequested();

/// Ends a computation from within one of its callbacks (an output file can no longer be written).
void requestStop();

}  // namespace talus::tools
