// The map of failure of a finished batch, as numpy arrays.

#include <pybind11/stl.h>

#include "batch/failure_map.h"
#include "batch/map_files.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "python/arrays.h"
#include "python/computing.h"
#include "python/module.h"
#include "report/csv.h"

namespace talus::python {

namespace {

using namespace tools;

/// Throws BadInput for a folder of another sweep, or of one that has runs left to compute.
batch::StoredBatch finishedBatch(const formats::Sweep& sweep, const std::string& folder) {
    batch::StoredBatch stored = batch::readStored(folder);
    const batch::BatchInfo info = batch::describe(sweep);
    if (stored.info.identity != info.identity)
        throw BadInput(
            Error{"folder",
                  "holds the batch of another sweep (" + stored.info.sweep + "), allowed: of " + sweep.path,
                  folder});
    stored = batch::onlyRunsOf(info, std::move(stored));
    if (stored.lines.size() < info.runs)
        throw BadInput(Error{"folder",
                             "holds " + std::to_string(stored.lines.size()) + " of " +
                                 std::to_string(info.runs) +
                                 " runs, allowed: a finished batch; talus.batch continues it",
                             folder});
    return stored;
}

std::optional<batch::FailureMap> mapOf(const std::string& sweep_path, const std::string& folder,
                                       std::optional<double> cell_size, const Manner& manner) {
    if (cell_size && !(*cell_size > 0 && *cell_size < kInfinity))
        throw BadInput(
            Error{"cell_size", "found " + csvNumber(*cell_size) + " m, allowed: a positive number, or None"});
    std::optional<batch::FailureMap> map;
    compute(manner, [&](Computing& computing) {
        const formats::Sweep sweep = tools::valueOf(formats::readSweep(sweep_path));
        const batch::StoredBatch stored = finishedBatch(sweep, folder);
        batch::Face face = batch::faceOf(sweep, stored.info, cell_size, {"sweep", "cell_size"});
        const auto report = [&](const Progress& progress) { computing.report(progress); };
        map = batch::failureMap(sweep, stored, std::move(face), manner.threads, computing.stop(), report);
    });
    return map;
}

/// One vector of each cell.
py::array_t<double> vectorsOf(const batch::Face& face, Vec3 batch::FaceCell::*vector) {
    VectorList<double> list;
    for (const batch::FaceCell& cell : face.cells) list.push_back(cell.*vector);
    return vectorArray(list);
}

void addPolygons(const batch::Face& face, py::dict& arrays) {
    VectorList<double> corners;
    std::vector<std::int64_t> begin{0}, cells;
    for (std::size_t c = 0; c < face.cells.size(); ++c)
        for (const auto& piece : face.cells[c].pieces) {
            for (const Vec3& corner : piece) corners.push_back(corner);
            begin.push_back(static_cast<std::int64_t>(corners.x.size()));
            cells.push_back(static_cast<std::int64_t>(c));
        }
    arrays["corners"] = vectorArray(corners);
    arrays["polygon_begin"] = ownedArray(std::move(begin));
    arrays["polygon_cell"] = ownedArray(std::move(cells));
}

py::dict arraysOf(batch::FailureMap map) {
    std::vector<double> area, probability, low, high;
    for (std::size_t c = 0; c < map.face.cells.size(); ++c) {
        const batch::Interval interval = map.interval(c);
        area.push_back(map.face.cells[c].area);
        probability.push_back(map.probability(c));
        low.push_back(interval.low);
        high.push_back(interval.high);
    }
    py::dict arrays;
    arrays["centres"] = vectorsOf(map.face, &batch::FaceCell::centre);
    arrays["normals"] = vectorsOf(map.face, &batch::FaceCell::normal);
    arrays["areas"] = ownedArray(std::move(area));
    arrays["hits"] = ownedArray(std::vector<std::int64_t>(map.hits.begin(), map.hits.end()));
    arrays["probability"] = ownedArray(std::move(probability));
    arrays["probability_low"] = ownedArray(std::move(low));
    arrays["probability_high"] = ownedArray(std::move(high));
    arrays["volume_per_area"] = ownedArray(std::move(map.volume_per_area));
    addPolygons(map.face, arrays);
    return arrays;
}

}  // namespace

void addFailureMap(py::module_& module) {
    module.def(
        "failure_map",
        [](const std::string& sweep, const std::string& folder, std::optional<double> cell_size,
           const py::object& threads, const py::object& progress) {
            auto map = mapOf(sweep, folder, cell_size, {threadsOf(threads), progress});
            const std::string facts = jsonText(batch::toJson(*map, {}));
            return py::make_tuple(arraysOf(*std::move(map)), facts);
        },
        py::arg("sweep"), py::arg("folder"), py::kw_only(), py::arg("cell_size"), py::arg("threads"),
        py::arg("progress"));
}

}  // namespace talus::python
