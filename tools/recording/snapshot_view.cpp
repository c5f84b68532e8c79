#include "recording/snapshot_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "cli/failures.h"

namespace talus::tools {

formats::SnapshotReader openSnapshot(const std::string& path) {
    return valueOf(formats::SnapshotReader::open(path));
}

void requireFrames(const formats::SnapshotReader& reader, const std::string& path) {
    if (!reader.frames().empty()) return;
    const std::string lost = reader.faults().empty() ? "" : " that can be read: " + reader.faults().front();
    throw BadInput(Error{"", "holds no frames" + lost, path});
}

std::size_t frameIndex(const formats::SnapshotReader& reader, const std::string& words,
                       const std::string& path) {
    requireFrames(reader, path);
    const auto& frames = reader.frames();
    const auto bad = [&](const std::string& why) {
        return BadInput(Error{"--frame",
                              "\"" + words + "\" " + why + "; allowed: last, 0 to " +
                                  std::to_string(frames.size() - 1) + ", or a time like 0.05 or 2s",
                              path});
    };
    if (words == "last") return frames.size() - 1;
    const bool seconds = words.ends_with("s");
    const char* end = words.data() + words.size() - (seconds ? 1 : 0);
    double value = 0;
    const auto read = std::from_chars(words.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end || !(value >= 0)) throw bad("is not a frame");
    if (!seconds && words.find_first_of(".eE") == std::string::npos) {
        if (value >= static_cast<double>(frames.size())) throw bad("is beyond the last frame");
        return static_cast<std::size_t>(value);
    }
    const auto after =
        std::upper_bound(frames.begin(), frames.end(), value + 1e-9,
                         [](double time, const formats::FrameEntry& entry) { return time < entry.time; });
    if (after == frames.begin()) throw bad("is before the first frame");
    return static_cast<std::size_t>(after - frames.begin()) - 1;
}

std::size_t blockIndex(const formats::SnapshotHeader& header, const std::string& name,
                       const std::string& path) {
    const auto found = std::find(header.names.begin(), header.names.end(), name);
    if (found != header.names.end()) return static_cast<std::size_t>(found - header.names.begin());
    std::string some;
    for (std::size_t b = 0; b < std::min<std::size_t>(4, header.names.size()); ++b)
        some += (b > 0 ? ", " : "") + header.names[b];
    throw BadInput(Error{"--block",
                         "there is no block \"" + name + "\"; allowed: one of " +
                             std::to_string(header.names.size()) + " names (" + some + ", ...)",
                         path});
}

FullFrame fullAt(formats::SnapshotReader& reader, std::size_t frame, const std::string& path) {
    for (std::size_t k = frame + 1; k-- > 0;)
        if (reader.frames()[k].full) return valueOf(reader.full(*reader.frames()[k].full));
    throw BadInput(
        Error{"--frame", "there is no full state up to this frame, so its contacts are not known", path});
}

Vec3 get(const VectorList<double>& list, std::size_t k) { return {list.x[k], list.y[k], list.z[k]}; }

Vec3 get(const VectorList<float>& list, std::size_t k) {
    return Eigen::Vector3f(list.x[k], list.y[k], list.z[k]).cast<double>();
}

Mat3 turnOf(const FullFrame& full, std::size_t b) {
    const QuaternionList& q = full.blocks.orientation;
    return Eigen::Quaterniond(q.w[b], q.x[b], q.y[b], q.z[b]).toRotationMatrix();
}

PlacedInterface placed(const FullFrame& full, std::size_t i) {
    const FrameInterfaces& f = full.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[i]);
    const Mat3 turn = turnOf(full, a);
    PlacedInterface p;
    p.origin = Vec3(full.origin_x, full.origin_y, full.origin_z) + get(full.blocks.position, a) +
               turn * get(f.origin_a, i);
    p.e1 = turn * get(f.e1_a, i);
    p.e2 = turn * get(f.e2_a, i);
    p.e3 = p.e1.cross(p.e2);
    return p;
}

const char* toString(PointState state) {
    switch (state) {
        case PointState::open:
            return "open";
        case PointState::sticking:
            return "sticking";
        case PointState::slipping:
            return "slipping";
    }
    return "unknown";
}

}  // namespace talus::tools
