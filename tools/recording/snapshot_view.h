#pragma once
// Access to a snapshot file for commands: frames by number or time, blocks by name, contacts in the model
// frame.

#include <optional>
#include <string>
#include <vector>

#include "talus/formats/snapshot.h"

namespace talus::tools {

/// Opens a snapshot file; throws BadInput.
formats::SnapshotReader openSnapshot(const std::string& path);

/// Throws BadInput when a file holds no frames, or none that can be read.
void requireFrames(const formats::SnapshotReader& reader, const std::string& path);

/// "last", a frame's number from 0 ("12"), or a time ("0.05", "2s"): then the last frame not after it. Throws
/// BadInput.
std::size_t frameIndex(const formats::SnapshotReader& reader, const std::string& words,
                       const std::string& path);

/// Index of a block; throws BadInput with the nearest names.
std::size_t blockIndex(const formats::SnapshotHeader& header, const std::string& name,
                       const std::string& path);

/// The full state of a frame, or the last one before it. Throws BadInput when there is none.
FullFrame fullAt(formats::SnapshotReader& reader, std::size_t frame, const std::string& path);

/// Rotation of a block of a full state.
Mat3 turnOf(const FullFrame& full, std::size_t block);

/// Frame of an interface where it is now.
struct PlacedInterface {
    Vec3 origin, e1, e2, e3;  ///< model frame; e3 points from block a to block b

    Vec3 at(double xi, double eta) const { return origin + xi * e1 + eta * e2; }
};
PlacedInterface placed(const FullFrame& full, std::size_t interface);

const char* toString(PointState state);

Vec3 get(const VectorList<double>& list, std::size_t k);
Vec3 get(const VectorList<float>& list, std::size_t k);

}  // namespace talus::tools
