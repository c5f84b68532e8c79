#pragma once
// The probability of failure of a batch as a map: per cell of the face, how often it lies on what fails, and
// how much volume is expected. Made of the rows on disk. A run's blocks are cut again from its number, so
// batches that were stopped, shared or merged have the map of one that was not.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "batch/face_cells.h"
#include "batch/statistics.h"
#include "batch/store.h"
#include "talus/analysis.h"

namespace talus::tools::batch {

struct FailureMap {
    Face face;
    std::vector<std::uint64_t> hits;      ///< per cell: runs in which it lies on what fails
    std::vector<double> volume_per_area;  ///< per cell: expected failing volume, the mean over all runs [m]
    std::uint64_t runs = 0;               ///< of which it is known whether they fail at the threshold
    std::uint64_t failed = 0;             ///< of these
    double threshold = 0;                 ///< in the answer's unit
    double confidence = 0.95;
    double volume = 0;         ///< expected failing volume [m^3]
    double hidden_volume = 0;  ///< of it, of failures that no cell lies on [m^3]

    double probability(std::size_t cell) const;
    Interval interval(std::size_t cell) const;  ///< Clopper and Pearson's
    double largestProbability() const;
    double largestVolumePerArea() const;  ///< [m]
};

/// What messages call a map and the size of its cells.
struct MapNames {
    const char *map = "--map", *cell_size = "--map-cell";
};

/// The face of a sweep, for its map. Throws BadInput where there is none: an analysis without a failure, no
/// threshold, several cases, no rock mass, a region that varies, too many cells.
Face faceOf(const formats::Sweep& sweep, const BatchInfo& info, std::optional<double> cell_size,
            const MapNames& names = {});

/// \param face  of the same sweep. The same for any number of threads. Nothing when it was stopped. Throws
/// BadInput for a row that is not of this sweep.
std::optional<FailureMap> failureMap(const formats::Sweep& sweep, const StoredBatch& batch, Face face,
                                     int threads, const std::atomic<bool>& stop,
                                     const std::function<void(const Progress&)>& progress = {});

}  // namespace talus::tools::batch
