// Snapshot files as numpy arrays.

#include <pybind11/stl.h>

#include <mutex>

#include "cli/failures.h"
#include "cli/text.h"
#include "python/arrays.h"
#include "python/module.h"
#include "recording/snapshot_view.h"
#include "replay/page.h"
#include "talus/formats/snapshot.h"

namespace talus::python {

namespace {

/// One value of each frame, as (frames,), and one vector of each block and frame, as (frames, blocks, 3).
struct Frames {
    std::vector<double> times, tilts, kinetic, elastic, gravity;
    std::vector<std::int64_t> steps;
    std::vector<std::string> hashes;
    std::vector<double> positions;
    std::vector<float> displacements, velocities, rotations;
};

void append(std::vector<float>& flat, const VectorList<float>& list) {
    for (std::size_t b = 0; b < list.x.size(); ++b)
        flat.insert(flat.end(), {list.x[b], list.y[b], list.z[b]});
}

void append(std::vector<double>& flat, const VectorList<double>& start, const VectorList<float>& moved) {
    for (std::size_t b = 0; b < start.x.size(); ++b)
        flat.insert(flat.end(), {start.x[b] + static_cast<double>(moved.x[b]),
                                 start.y[b] + static_cast<double>(moved.y[b]),
                                 start.z[b] + static_cast<double>(moved.z[b])});
}

class SnapshotFile {
 public:
    explicit SnapshotFile(const std::string& path) : path_(path), reader_(tools::openSnapshot(path)) {}

    const formats::SnapshotReader& reader() const { return reader_; }

    Frames frames() {
        const std::lock_guard alone(mutex_);
        Frames all;
        const std::size_t blocks = reader_.header().names.size(), count = reader_.frames().size();
        all.positions.reserve(3 * blocks * count);
        for (auto* list : {&all.displacements, &all.velocities, &all.rotations})
            list->reserve(3 * blocks * count);
        for (std::size_t k = 0; k < count; ++k) {
            const LightFrame frame = tools::valueOf(reader_.frame(k));
            all.times.push_back(frame.time);
            all.steps.push_back(frame.step);
            all.tilts.push_back(talus::degrees(frame.tilt));
            all.kinetic.push_back(frame.kinetic_energy);
            all.elastic.push_back(frame.elastic_energy);
            all.gravity.push_back(frame.gravity_energy);
            all.hashes.push_back(tools::hashText(frame.state_hash));
            append(all.positions, reader_.header().geometry.centroid, frame.displacement);
            append(all.displacements, frame.displacement);
            append(all.velocities, frame.velocity);
            append(all.rotations, frame.rotation);
        }
        return all;
    }

    /// The page of `talus replay`, with the whole run in it.
    std::string page() {
        const std::lock_guard alone(mutex_);
        return tools::replayPage(tools::snapshotBytes(reader_, path_, {}));
    }

    FullFrame fullAt(std::int64_t frame) {
        const std::lock_guard alone(mutex_);
        const auto count = static_cast<std::int64_t>(reader_.frames().size());
        if (frame < 0) frame += count;
        if (frame < 0 || frame >= count)
            throw py::index_error("there are " + std::to_string(count) + " frames");
        return tools::fullAt(reader_, static_cast<std::size_t>(frame), path_);
    }

 private:
    std::string path_;
    std::mutex mutex_;  // several threads of Python may read, and the reader keeps a chunk
    formats::SnapshotReader reader_;
};

py::dict frameArrays(SnapshotFile& file) {
    Frames frames;
    {
        const py::gil_scoped_release others_may;
        frames = file.frames();
    }
    const auto count = static_cast<py::ssize_t>(frames.times.size());
    const std::vector<py::ssize_t> shape{count, static_cast<py::ssize_t>(file.reader().header().names.size()),
                                         3};
    py::dict arrays;
    arrays["times"] = ownedArray(std::move(frames.times));
    arrays["steps"] = ownedArray(std::move(frames.steps));
    arrays["tilts_deg"] = ownedArray(std::move(frames.tilts));
    arrays["kinetic_energy_j"] = ownedArray(std::move(frames.kinetic));
    arrays["elastic_energy_j"] = ownedArray(std::move(frames.elastic));
    arrays["gravity_energy_j"] = ownedArray(std::move(frames.gravity));
    arrays["state_hashes"] = py::cast(frames.hashes);
    arrays["positions"] = ownedArray(std::move(frames.positions), shape);
    arrays["displacements"] = ownedArray(std::move(frames.displacements), shape);
    arrays["velocities"] = ownedArray(std::move(frames.velocities), shape);
    arrays["rotations"] = ownedArray(std::move(frames.rotations), shape);
    return arrays;
}

}  // namespace

void addSnapshots(py::module_& module) {
    py::class_<SnapshotFile>(module, "Snapshots")
        .def(py::init<const std::string&>(), py::arg("path"), py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("names", [](const SnapshotFile& f) { return f.reader().header().names; })
        .def_property_readonly("masses",
                               [](const SnapshotFile& f) {
                                   return ownedArray(std::vector<double>(f.reader().header().geometry.mass));
                               })
        .def_property_readonly("scenario_text",
                               [](const SnapshotFile& f) { return f.reader().header().scenario_text; })
        .def_property_readonly("scenario_path",
                               [](const SnapshotFile& f) { return f.reader().header().scenario_path; })
        .def_property_readonly("faults", [](const SnapshotFile& f) { return f.reader().faults(); })
        .def_property_readonly("ended",
                               [](const SnapshotFile& f) -> std::optional<std::string> {
                                   if (const auto end = f.reader().end()) return end->ended;
                                   return std::nullopt;
                               })
        .def("__len__", [](const SnapshotFile& f) { return f.reader().frames().size(); })
        .def("arrays", frameArrays)
        .def("page", &SnapshotFile::page, py::call_guard<py::gil_scoped_release>())
        .def("contacts", [](SnapshotFile& file, std::int64_t frame) {
            FullFrame full;
            {
                const py::gil_scoped_release others_may;
                full = file.fullAt(frame);
            }
            return contactArrays(full);
        });
}

}  // namespace talus::python
