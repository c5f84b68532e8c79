#pragma once
// The self-contained page of a run: the page built into the program, with the snapshot file inside.

#include <string>
#include <string_view>

#include "cli/json_fwd.h"
#include "talus/formats/snapshot.h"

namespace talus::tools {

/// The page without a run, as this folder makes it.
extern const std::string_view kReplayPage;

/// Which frames go into the page.
struct FrameChoice {
    double from = 0, to = kInfinity;  ///< [s]
    int every = 1;                    ///< every so many frames, and the first and the last
    bool contacts = true;             ///< full states, too

    bool all() const { return from <= 0 && to == kInfinity && every == 1 && contacts; }
};

/// Bytes of a finished snapshot file with the chosen frames: the file itself when it has just these frames,
/// else a new one. A file that is cut or still being written is completed as far as it goes. Throws BadInput
/// and FileRefused.
std::string snapshotBytes(formats::SnapshotReader& reader, const std::string& path,
                          const FrameChoice& choice);

/// Bytes of a finished file of one frame.
std::string snapshotBytes(const formats::SnapshotHeader& header, const LightFrame& frame);

/// The page with these bytes inside, as base64 in pieces of a size that browsers accept.
/// \param map  of failure, to be drawn on the blocks (src/data/map.js reads it); nullptr: none
std::string replayPage(std::string_view snapshot, const Json* map = nullptr);

/// The page of a whole snapshot file. Throws BadInput and FileRefused.
void writeReplay(const std::string& file, const std::string& page);

/// Throws BadInput when the path holds anything but a replay page and `force` is not given.
void refuseToReplace(const std::string& page, const std::string& snapshot, bool force);

}  // namespace talus::tools
