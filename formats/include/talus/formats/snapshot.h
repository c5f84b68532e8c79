#pragma once
// Snapshot files: a run's header, frames and full states in an MCAP container (formats/snapshot.fbs says what
// is in a message). A separate thread writes it during the run. It is read frame by frame, also while it is
// being written, and up to the place where it was cut.
//
// Limits: a full state of at most 2 GB (some 500,000 blocks with nine contact points an interface), which is
// what one FlatBuffers message holds. The reader's memory stays below four times the largest chunk it
// accepts.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "talus/analysis.h"
#include "talus/build_info.h"
#include "talus/flow.h"
#include "talus/formats/output_file.h"
#include "talus/formats/scenario.h"
#include "talus/frame.h"
#include "talus/result.h"
#include "talus/simulation.h"

namespace talus::formats {

inline constexpr int kSnapshotFormat = 2;  ///< the latest that is read
inline constexpr int kFirstFormat = 1;
inline constexpr int kFormatWithLaws =
    2;  ///< joints of other laws than Coulomb's, which readers of version 1 would miss

/// A search's results for the failing run that it keeps.
struct SnapshotFailure {
    std::string analysis;  ///< "critical-angle", ...; of a mechanism "limit-analysis --for tilt", ...
    double load = 0;       ///< tilt [rad] or factor of safety of this run
    FailureMode mode = FailureMode::none;
    std::vector<FailureMode> roles;  ///< per block: its motion as found by the search
    /// per block: the factor of safety at which it fails, 0 where unknown; empty without any
    std::vector<double> factors{};
    double answer = 0, stands = 0, fails = 0;  ///< of the search, as its load; meaningless without a path
    std::vector<PathPoint> path{};             ///< the search's curve of load against displacement
};

/// Pressure of steady flow in the joints, computed before the run. It goes with block a.
struct SnapshotFlow {
    VectorList<double> node;             ///< as the blocks lie at the start, model frame [m]
    std::vector<double> pressure;        ///< per node: negative above the free surface [Pa]
    std::vector<std::int32_t> triangle;  ///< three nodes each; pressure acts where it is positive
    std::vector<std::int32_t> joint, block_a, block_b;  ///< per triangle
};

SnapshotFlow flowOf(const SteadyFlow& flow, const Model& model);

/// Header of a file, before the first frame.
struct SnapshotHeader {
    int format = kFirstFormat;
    std::string scenario_path, scenario_text;
    std::string units;
    BuildInfo build;
    std::string command_line;
    double gravity = 0;         ///< magnitude [m/s^2]
    double duration = 0;        ///< run.duration_s [s]
    double frame_interval = 0;  ///< [s]
    int frames_per_full = 0;
    std::vector<std::string> names;  ///< per block
    std::vector<Motion> motions;     ///< per block
    RunGeometry geometry;
    std::vector<Joint> joints;
    std::vector<Water> waters;
    std::vector<PhreaticSurface::Point> phreatic;  ///< the line of a phreatic surface, if there is one
    TriangleSurface phreatic_mesh;                 ///< or its triangles
    std::optional<SnapshotFlow> flow;              ///< of a model with [flow]
    /// of a run kept by a search, which begins in a state of that search
    std::optional<SnapshotFailure> failure;
};

/// The header of a run of this scenario by this build.
SnapshotHeader headerOf(const Scenario& scenario, RunGeometry geometry, std::string command_line,
                        int frames_per_full);

/// How a run ended.
struct SnapshotEnd {
    std::string ended;  ///< "finished", "interrupted" or "failed"
    std::int64_t steps = 0;
    double simulated_seconds = 0;
    std::uint64_t state_hash = 0;
    double wall_seconds = 0;
    std::vector<std::string> warnings;
};

enum class SnapshotFile { absent, empty, unfinished, finished, foreign };

/// What stands at this path. Devices and pipes count as absent, there is nothing in them to lose.
SnapshotFile inspectSnapshot(const std::string& path);

/// Writes a run's frames from a thread of its own. The queue between them is bounded: when the disk is slower
/// than the run, the run waits; secondsWaited() is that time. A chunk is written once it holds a full state
/// or 1 MiB, or after a second: the most that a killed run loses.
class SnapshotWriter {
 public:
    /// Writes a new run. The file's old content stays until the header is written.
    static SnapshotWriter begin(OutputFile file);
    /// The same. Errors: those of OutputFile.
    static Result<SnapshotWriter> open(const std::string& path);

    /// Continues after a full state of an unfinished or finished file: later content is cut off with the
    /// first frame. Errors: a file that holds no such state.
    static Result<SnapshotWriter> continueFile(OutputFile file, std::size_t full);

    SnapshotWriter(SnapshotWriter&&) noexcept;
    SnapshotWriter& operator=(SnapshotWriter&&) = delete;
    ~SnapshotWriter();  ///< an opened file that got no header is as it was before

    void write(SnapshotHeader header);
    void write(LightFrame frame);
    void write(FullFrame frame);

    /// Writes what is queued, how the run ended, and the index, and brings all of it to the disk. Errors: the
    /// first refusal of the file system; the file is not at its path any more.
    std::vector<Error> finish(const SnapshotEnd& end);

    bool failed() const;  ///< the file system has refused: nothing more is written
    double secondsWaited() const;
    std::uint64_t bytesWritten() const;

 private:
    struct Work;
    explicit SnapshotWriter(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

/// Where a frame stands in a file.
struct FrameEntry {
    double time = 0;                    ///< [s], rounded to ns
    std::optional<std::size_t> full{};  ///< the full state of the same instant, if there is one
};

/// Reads a snapshot file. Every message is checked before it is used; damaged ones are errors, never crashes.
class SnapshotReader {
 public:
    static constexpr std::uint64_t kMostChunkBytes = std::uint64_t{3} << 30;

    /// Errors: no MCAP file, no snapshots in it, a header that is missing, damaged or of a later format.
    static Result<SnapshotReader> open(const std::string& path,
                                       std::uint64_t most_chunk_bytes = kMostChunkBytes);
    /// The same for bytes in memory, which must outlive the reader.
    static Result<SnapshotReader> parse(const std::uint8_t* data, std::size_t size, const std::string& path,
                                        std::uint64_t most_chunk_bytes = kMostChunkBytes);

    SnapshotReader(SnapshotReader&&) noexcept;
    SnapshotReader& operator=(SnapshotReader&&) = delete;
    ~SnapshotReader();

    const SnapshotHeader& header() const;
    const std::vector<FrameEntry>& frames() const;
    std::size_t fulls() const;
    std::optional<SnapshotEnd> end() const;  ///< nothing when the run has not ended
    std::uint64_t fileSize() const;
    const std::vector<std::string>& faults() const;  ///< what is missing or damaged, in words

    Result<LightFrame> frame(std::size_t index);
    Result<FullFrame> full(std::size_t index);
    std::optional<std::size_t> frameOf(std::size_t full) const;  ///< of the same instant

    /// Verifies every checksum of the container and reads every message; faults as text, empty when all is
    /// sound.
    std::vector<std::string> verify();

 private:
    struct File;
    explicit SnapshotReader(std::unique_ptr<File> file);
    std::unique_ptr<File> file_;
};

/// Where two frames differ first, in the schema's order: "blocks.velocity.x[12]" and both values.
struct Difference {
    std::string field, a, b;
};
std::optional<Difference> firstDifference(const LightFrame& a, const LightFrame& b);
std::optional<Difference> firstDifference(const FullFrame& a, const FullFrame& b);

}  // namespace talus::formats
