#pragma once
// A time history that is recorded, and its result as JSON.

#include "cli/json_fwd.h"
#include "recording/motion_page.h"
#include "recording/run_output.h"

namespace talus::tools {

/// Runs, and finishes the recorder. Throws BadInput with the places of what is wrong, FileRefused.
/// \param watch  sees the run go by, when there is one
RunResult runRecorded(const formats::Scenario& scenario, const FullFrame* resume, RunRecorder& recorder,
                      const Control& control, MotionWatch* watch = nullptr);

/// The block of largest final displacement.
std::size_t farthestBlock(const RunResult& result);

Json runJson(const RunOptions& options, const formats::Scenario& scenario, const RunResult& result,
             const RunRecorder& recorder);

}  // namespace talus::tools
