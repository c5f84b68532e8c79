#pragma once
// Frames to messages and back (snapshot.fbs).

#include "mcap/bytes.h"
#include "talus/formats/snapshot.h"

namespace talus::formats {

/// The message's bytes; empty when it would be beyond the 2 GB that FlatBuffers hold.
mcap::Bytes encode(SnapshotHeader header);
mcap::Bytes encode(LightFrame frame);
mcap::Bytes encode(FullFrame frame);

// Each takes a whole message; false when it is damaged or of a later format, `why` then says so. Whether its
// arrays fit each other is for fits().
bool decode(const mcap::Bytes& message, SnapshotHeader& header, std::string& why);
bool decode(const mcap::Bytes& message, LightFrame& frame);
bool decode(const mcap::Bytes& message, FullFrame& frame);

/// Whether a message's arrays and indices fit each other and the header.
bool fits(const SnapshotHeader& header);
bool fits(const LightFrame& frame, const SnapshotHeader& header);
bool fits(const FullFrame& frame, const SnapshotHeader& header);

}  // namespace talus::formats
